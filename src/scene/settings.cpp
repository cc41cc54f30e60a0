#include "scene/settings.h"

#include <algorithm>
#include <limits>
#include <set>

#include "error.h"
#include "scene/text.h"

namespace thermocontact::scene {

namespace {

using nlohmann::json;

/// Names below the table `kind`, boundary or region.
std::vector<std::string> written_names(const Document& document, const std::string& kind) {
    std::set<std::string> names;
    for (const Entry& entry : document.entries) {
        const auto parts = split(entry.key);
        if (parts.size() > 1 && parts[0] == kind) {
            names.insert(parts[1]);
        }
    }
    return {names.begin(), names.end()};
}

/// The names that `key` stands for in this scene: itself, or one of each boundary or region.
std::vector<std::string> instances(const Key& key, const Settings& settings) {
    if (!is_named(split(key.name))) {
        return {key.name};
    }
    std::vector<std::string> names;
    for (const auto& name : key.name.starts_with("region.") ? settings.regions : settings.boundaries) {
        names.push_back(instance_of(key.name, name));
    }
    return names;
}

/// The boundary or region that a key belongs to; "" if it belongs to none.
std::string owner_of(const std::string& name) {
    const auto parts = split(name);
    return is_named(parts) ? parts[1] : "";
}

/// The default of `key`; a number stands for as many as there are axes where an array is wanted.
json default_of(const Key& key, int dimension) {
    json value = json::parse(key.fallback);
    if (key.type == Type::numbers && value.is_number()) {
        value = json(std::vector<double>(static_cast<std::size_t>(dimension), value.get<double>()));
    }
    return value;
}

void check_needs(const Settings& settings, const Entry& entry, const Key& key) {
    for (const std::string& pattern : key.needs) {
        const std::string needed = instance_of(pattern, owner_of(entry.key));
        if (!settings.written(needed)) {
            fail(entry.where, entry.key + ": needs " + needed + ", which the scene lacks");
        }
    }
}

void check_exclusions(const Settings& settings, const Entry& entry, const Key& key) {
    std::vector<std::string> rivals = key.excludes;
    if (!key.instead.empty()) {
        rivals.push_back(key.instead);
    }
    const auto* begin = settings.document->entries.data();
    for (const std::string& pattern : rivals) {
        const Entry* rival = settings.document->find(instance_of(pattern, owner_of(entry.key)));
        if (rival != nullptr) {
            const bool first = &entry - begin < rival - begin;
            const Entry& earlier = first ? entry : *rival;
            const Entry& later = first ? *rival : entry;
            fail(later.where, later.key + ": cannot stand beside " + earlier.key + " (" +
                                  earlier.where.brief() + "); give one of the two");
        }
    }
}

std::string assignment(const Key& key) {
    return key.leaf() + " = " + key.example;
}

[[noreturn]] void fail_missing(const Settings& settings, const std::string& name, const Key& key) {
    const auto parts = split(name);
    const std::string table = join(parts, parts.size() - 1);
    const Entry* written = settings.document->find(table);
    std::string advice = "missing; add " + assignment(key);
    if (!key.instead.empty()) {
        advice += ", or " + assignment(*settings.schema->find(key.instead));
    }
    fail(written != nullptr ? written->where : Location{.source = settings.document->file},
         name + ": " + advice + " to [" + table + "]");
}

/// Puts the default of a key that is not written into force, where it has one and its table is there.
void complete(Settings& settings, const std::string& name, const Key& key) {
    const auto parts = split(name);
    const std::string table = join(parts, parts.size() - 1);
    const Entry* written = settings.document->find(table);
    const bool replaced = !key.instead.empty() && settings.written(instance_of(key.instead, owner_of(name)));
    if ((written == nullptr && !is_always_present(table)) || replaced) {
        return;
    }
    if (key.required) {
        fail_missing(settings, name, key);
    }
    if (!key.fallback.empty()) {
        const Location where =
            written != nullptr ? written->where : Location{.source = settings.document->file};
        settings.by_name[name] = {&key, where, default_of(key, settings.body.dimension)};
    }
}

}  // namespace

const Setting* Settings::find(const std::string& name) const {
    const auto found = by_name.find(name);
    return found == by_name.end() ? nullptr : &found->second;
}

const OwnLaw* Settings::law(const std::string& kind) const {
    const auto found =
        std::ranges::find_if(laws, [&](const OwnLaw& law) { return law.description.kind == kind; });
    return found == laws.end() ? nullptr : &*found;
}

std::vector<std::string> Settings::boundaries_with(const std::string& pattern) const {
    std::vector<std::string> names;
    for (const std::string& boundary : boundaries) {
        if (written(instance_of(pattern, boundary))) {
            names.push_back(boundary);
        }
    }
    return names;
}

nlohmann::ordered_json Settings::resolved() const {
    auto tables = nlohmann::ordered_json::object();
    for (const std::string& name : in_schema_order) {
        const json& value = by_name.at(name).value;
        if (value.is_number_float() && value.get<double>() > std::numeric_limits<double>::max()) {
            continue;  // an infinite limit is none, and JSON knows no infinity
        }
        nlohmann::ordered_json* place = &tables;
        for (const std::string& part : split(name)) {
            place = &(*place)[part];
        }
        *place = nlohmann::ordered_json(value);
    }
    return tables;
}

void fail_at(const Settings& settings, const std::string& name, const std::string& message) {
    const Entry* entry = settings.document->find(name);
    fail(entry != nullptr ? entry->where : Location{.source = settings.document->file},
         name + ": " + message);
}

Settings check_document(const Document& document) {
    Settings settings;
    settings.document = &document;
    settings.laws = laws_of(document);
    settings.schema = schema_of(settings.laws, document);
    settings.body = body_of(document);
    settings.boundaries = written_names(document, "boundary");
    settings.regions = written_names(document, "region");
    for (const Entry& entry : document.entries) {
        check_known(entry, *settings.schema, settings.body);
        if (const Key* key = settings.schema->find(pattern_of(entry.key))) {
            settings.by_name[entry.key] = {key, entry.where,
                                           check_value(*key, entry, settings.body.dimension)};
        }
    }
    for (const Entry& entry : document.entries) {
        if (const Key* key = settings.schema->find(pattern_of(entry.key))) {
            check_needs(settings, entry, *key);
            check_exclusions(settings, entry, *key);
        }
    }
    for (const Key& key : settings.schema->keys()) {
        for (const std::string& name : instances(key, settings)) {
            if (!settings.has(name)) {
                complete(settings, name, key);
            }
            if (settings.has(name)) {
                settings.in_schema_order.push_back(name);
            }
        }
    }
    return settings;
}

}  // namespace thermocontact::scene
