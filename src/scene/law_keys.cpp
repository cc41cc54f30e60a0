#include "scene/law_keys.h"

#include <algorithm>
#include <map>

#include "error.h"
#include "scene/text.h"

namespace thermocontact::scene {
namespace {

using laws::Description;

struct Place {
    std::string table;               ///< of the law's parameters
    std::vector<std::string> needs;  ///< of each of them
};

/// In the order of the reference.
const std::vector<std::pair<std::string, Place>>& places() {
    static const std::vector<std::pair<std::string, Place>> all = {
        {"compliance", {"boundary.NAME.contact.compliance", {"material"}}},
        {"friction", {"boundary.NAME.contact.friction", {"boundary.NAME.contact.compliance"}}},
        {"conductance", {"boundary.NAME.contact.conductance", {"heat"}}}};
    return all;
}

const Place& place_of(const std::string& kind) {
    return std::ranges::find(places(), kind, &std::pair<std::string, Place>::first)->second;
}

std::string json_text(double value) {
    return nlohmann::json(value).dump();
}

std::vector<Key> keys_of(const Description& law) {
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
                        .needs = place.needs,
                        .example = json_text(parameter.example),
                        .description = parameter.meaning});
    }
    return keys;
}

/// The parameters of each law stand before the other keys of its table, or after those of the table around.
void insert(std::vector<Key>& keys, const Description& law) {
    const std::string table = table_of_law(law.kind), around = table.substr(0, table.rfind('.'));
    std::vector<Key> added = keys_of(law);
    for (const Key& key : added) {
        if (std::ranges::find(keys, key.name, &Key::name) != keys.end()) {
            throw SceneError("the parameter " + key.leaf() + " has the name of a key that [" + table +
                             "] has anyway");
        }
    }
    auto at = std::ranges::find(keys, table, &Key::table);
    if (at == keys.end()) {
        at = std::find_if(keys.rbegin(), keys.rend(), [&](const Key& key) {
                 return key.table() == around;
             }).base();
    }
    keys.insert(at, std::make_move_iterator(added.begin()), std::make_move_iterator(added.end()));
}

Schema schema_of(const std::map<std::string, Description>& laws) {
    std::vector<Key> keys = keys_beside_laws();
    std::vector<std::string> tables;
    for (const auto& [kind, place] : places()) {
        insert(keys, laws.at(kind));
        tables.push_back(place.table);
    }
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
    static const Schema all = schema_of(built_in());
    return all;
}

std::shared_ptr<const Schema> schema_with(const std::vector<Description>& own) {
    std::map<std::string, Description> laws = built_in();
    for (const Description& law : own) {
        laws[law.kind] = law;
    }
    return std::make_shared<const Schema>(schema_of(laws));
}

std::string table_of_law(const std::string& kind) {
    return place_of(kind).table;
}

std::vector<std::string> law_kinds() {
    std::vector<std::string> kinds;
    std::ranges::transform(places(), std::back_inserter(kinds),
                           [](const auto& entry) { return entry.first; });
    return kinds;
}

}  // namespace thermocontact::scene
