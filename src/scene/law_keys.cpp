#include "scene/law_keys.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "error.h"
#include "scene/text.h"

namespace thermocontact::scene {
namespace {

using laws::Description;

/// Where the parameters of a law stand among the keys.
struct Place {
    std::string table;               ///< of the parameters; of a law that is a key otherwise, that key
    std::vector<std::string> needs;  ///< of each of them
    std::string instead = {};        ///< key that says the built-in law otherwise
    bool is_key = false;             ///< without a file, the key `table` is the law
};

/// In the order of the reference.
const std::vector<std::pair<std::string, Place>>& places() {
    static const std::vector<std::pair<std::string, Place>> all = {
        {"elasticity",
         {.table = "material.elasticity", .needs = {}, .instead = "material.elasticity.tensor"}},
        {"viscosity", {.table = "material.viscosity", .needs = {}, .instead = "material.viscosity.tensor"}},
        {"source", {.table = "heat.source", .needs = {}, .is_key = true}},
        {"body_force", {.table = "load.body_force", .needs = {"material"}, .is_key = true}},
        {"compliance", {.table = "boundary.NAME.contact.compliance", .needs = {"material"}}},
        {"friction",
         {.table = "boundary.NAME.contact.friction", .needs = {"boundary.NAME.contact.compliance"}}},
        {"conductance", {.table = "boundary.NAME.contact.conductance", .needs = {"heat"}}}};
    return all;
}

const Place& place_of(const std::string& kind) {
    return std::ranges::find(places(), kind, &std::pair<std::string, Place>::first)->second;
}

/// As people write it: 2.1e11.
std::string json_text(double value) {
    std::string text = nlohmann::json(value).dump();
    if (std::abs(value) >= 1e6 && std::isfinite(value)) {
        text.resize(32);
        text.resize(static_cast<std::size_t>(
            std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific).ptr -
            text.data()));
        std::erase(text, '+');
    }
    return text;
}

/// `instead` of the built-in law only.
std::vector<Key> keys_of(const Description& law, const std::string& instead) {
    const Place& place = place_of(law.kind);
    std::vector<Key> keys;
    for (const laws::Parameter& parameter : law.parameters) {
        keys.push_back({.name = place.table + "." + parameter.key,
                        .type = Type::number,
                        .unit = parameter.unit,
                        .range = {parameter.low, parameter.high, parameter.low_open, parameter.high_open,
                                  parameter.infinite},
                        .fallback = parameter.fallback ? json_text(*parameter.fallback) : "",
                        .required = parameter.required,
                        .instead = instead,
                        .needs = place.needs,
                        .example = json_text(parameter.example),
                        .description = parameter.meaning});
    }
    return keys;
}

/// Takes out what says the built-in law in another way than by parameters. Returns where that was.
std::size_t remove_rivals(std::vector<Key>& keys, const Place& place) {
    std::size_t first = keys.size();
    for (const std::string& rival : {place.instead, place.is_key ? place.table : std::string()}) {
        const auto at = std::ranges::find(keys, rival, &Key::name);
        if (at != keys.end()) {
            first = static_cast<std::size_t>(at - keys.begin());
            keys.erase(at);
        }
    }
    for (Key& key : keys) {
        key.instead = key.instead == place.instead ? "" : key.instead;
    }
    return first;
}

/// The parameters of each law stand before the other keys of its table, or after those of the table around,
/// or where the key was that they replace.
void insert(std::vector<Key>& keys, const Description& law, bool is_own) {
    const Place& place = place_of(law.kind);
    if (place.is_key && !is_own) {
        return;
    }
    const std::string &table = place.table, around = table.substr(0, table.rfind('.'));
    const std::size_t gap = is_own ? remove_rivals(keys, place) : keys.size();
    std::vector<Key> added = keys_of(law, is_own ? "" : place.instead);
    for (const Key& key : added) {
        if (std::ranges::find(keys, key.name, &Key::name) != keys.end()) {
            throw SceneError("the parameter " + key.leaf() + " has the name of a key that [" + table +
                             "] has anyway");
        }
    }
    auto at = std::ranges::find(keys, table, &Key::table);
    if (at == keys.end() && gap < keys.size()) {
        at = keys.begin() + static_cast<std::ptrdiff_t>(gap);
    } else if (at == keys.end()) {
        at = std::find_if(keys.rbegin(), keys.rend(), [&](const Key& key) {
                 return key.table() == around;
             }).base();
    }
    keys.insert(at, std::make_move_iterator(added.begin()), std::make_move_iterator(added.end()));
}

/// The key that says for one region of the mesh what `key` says for the body. Parameters of a law of the
/// scene's own are taken one by one from the region or from the body, those of a built-in law together.
Key of_region(Key key, bool is_own) {
    const bool in_subtable = std::ranges::count(key.name, '.') > 1;
    key.needs = {in_subtable ? key.table() : key.name};
    key.fallback.clear();
    key.required = key.required && !is_own;
    if (key.leaf() == "plane") {
        key.example = R"("stress")";  // that of the whole body
    }
    key.description = "In one region of the mesh: " + key.description;
    for (std::string* name : {&key.name, &key.instead}) {
        *name = name->empty() ? "" : "region.NAME." + *name;
    }
    return key;
}

/// The material and heat of a region: each key again, over the default of the same name, which says what is
/// modelled. They stand after the keys of the body.
void insert_regions(std::vector<Key>& keys, const std::vector<std::string>& own_tables) {
    std::vector<Key> added;
    for (const Key& key : keys) {
        if (key.name.starts_with("material.") || key.name.starts_with("heat.")) {
            added.push_back(of_region(key, std::ranges::count(own_tables, key.table()) > 0));
        }
    }
    const auto first = std::ranges::find(keys, "forms", &Key::table);
    keys.insert(first, std::make_move_iterator(added.begin()), std::make_move_iterator(added.end()));
}

Schema schema_of(const std::map<std::string, Description>& laws, const std::vector<std::string>& own) {
    std::vector<Key> keys = keys_beside_laws();
    std::vector<std::string> tables, own_tables;
    for (const auto& [kind, place] : places()) {
        const bool is_own = std::ranges::count(own, kind) > 0;
        insert(keys, laws.at(kind), is_own);
        if (is_own || !place.is_key) {
            tables.push_back(place.table);
        }
        if (is_own) {
            own_tables.push_back(place.table);
            tables.push_back(place.table.substr(0, place.table.rfind('.')));  // a law may have no parameters
            if (place.table.starts_with("material.") || place.table.starts_with("heat.")) {
                tables.push_back("region.NAME." + place.table);
            }
        }
    }
    insert_regions(keys, own_tables);
    return {std::move(keys), tables};
}

std::map<std::string, Description> built_in() {
    std::map<std::string, Description> laws;
    for (const laws::BuiltIn& law : laws::built_in_laws()) {
        laws.emplace(law.description.kind, law.description);
    }
    return laws;
}

}  // namespace

const Schema& schema() {
    static const Schema all = schema_of(built_in(), {});
    return all;
}

std::shared_ptr<const Schema> schema_with(const std::vector<Description>& own) {
    std::map<std::string, Description> laws = built_in();
    std::vector<std::string> kinds;
    for (const Description& law : own) {
        laws[law.kind] = law;
        kinds.push_back(law.kind);
    }
    return std::make_shared<const Schema>(schema_of(laws, kinds));
}

std::string table_of_law(const std::string& kind) {
    return place_of(kind).table;
}

bool is_key_otherwise(const std::string& kind) {
    return place_of(kind).is_key;
}

std::vector<std::string> law_kinds() {
    std::vector<std::string> kinds;
    std::ranges::transform(places(), std::back_inserter(kinds),
                           [](const auto& entry) { return entry.first; });
    return kinds;
}

}  // namespace thermocontact::scene
