// Unknown keys and boundaries, with the name that was probably meant.

#include <algorithm>

#include "scene/settings.h"
#include "scene/text.h"

namespace thermocontact::scene {

namespace {

/// The boundary or region that an entry belongs to; those of neither may have meant a boundary.
struct Owner {
    std::string kind = "boundary";
    std::string name = "NAME";
};

bool is_declared(const Schema& schema, const std::string& pattern) {
    return schema.find(pattern) != nullptr || schema.is_table(pattern);
}

std::vector<std::string> members(const Schema& schema, const std::string& table) {
    std::vector<std::string> leaves;
    for (const std::string& name : schema.names()) {
        const auto parts = split(name);
        if (join(parts, parts.size() - 1) == table) {
            leaves.push_back(parts.back());
        }
    }
    return leaves;
}

/// Keys with that last part; those of a named boundary or region only for an entry of the same kind.
std::vector<std::string> namesakes(const Schema& schema, const std::string& leaf, const Owner& owner) {
    std::vector<std::string> names;
    for (const std::string& name : schema.names()) {
        const auto parts = split(name);
        const bool elsewhere = is_named(parts) && parts[0] != owner.kind;
        if (parts.size() > 1 && parts.back() == leaf && !elsewhere) {
            names.push_back(instance_of(name, owner.name));
        }
    }
    return names;
}

/// A near name anywhere in the schema, dotted.
std::string near_elsewhere(const Schema& schema, const std::string& leaf, const Owner& owner) {
    std::vector<std::string> leaves;
    for (const std::string& name : schema.names()) {
        leaves.push_back(split(name).back());
    }
    const std::string found = nearest(leaf, leaves);
    return found.empty()                             ? found
           : namesakes(schema, found, owner).empty() ? found
                                                     : namesakes(schema, found, owner).front();
}

std::string suggestion(const Schema& schema, const std::string& table, const std::string& leaf,
                       const Owner& owner) {
    if (const auto names = namesakes(schema, leaf, owner); !names.empty()) {
        return "; did you mean " + one_of(names) + "?";
    }
    if (std::string text = did_you_mean(leaf, members(schema, table)); !text.empty()) {
        return text;
    }
    if (const std::string name = near_elsewhere(schema, leaf, owner); !name.empty()) {
        return "; did you mean \"" + name + "\"?";
    }
    return "; expected " + one_of(members(schema, table));
}

/// `kind`: "boundary" or "region".
void check_name(const Entry& entry, const std::string& kind, const std::string& name, const Body& body) {
    const auto& names = kind == "boundary" ? body.boundaries : body.regions;
    if (std::find(names.begin(), names.end(), name) == names.end()) {
        const std::string known =
            names.empty() ? "; it has none" : "; expected " + one_of(names) + did_you_mean(name, names);
        fail(entry.where, kind + "." + name + ": unknown " + kind + " of the " + body.what + known);
    }
}

}  // namespace

void check_known(const Entry& entry, const Schema& schema, const Body& body) {
    const auto parts = split(entry.key);
    if (is_named(parts)) {
        check_name(entry, parts[0], parts[1], body);
    }
    const Owner owner = is_named(parts) ? Owner{parts[0], parts[1]} : Owner{};
    const auto patterns = split(pattern_of(entry.key));
    for (std::size_t n = 1; n <= parts.size(); ++n) {
        if (!is_declared(schema, join(patterns, n))) {
            fail(entry.where, join(parts, n) + ": unknown key" +
                                  suggestion(schema, join(patterns, n - 1), parts[n - 1], owner));
        }
    }
    if (schema.is_table(pattern_of(entry.key)) && !entry.is_table) {
        fail(entry.where, entry.key + ": expected a table, found " + show(entry.value));
    }
}

}  // namespace thermocontact::scene
