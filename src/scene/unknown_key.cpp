// Unknown keys and boundaries, with the name that was probably meant.

#include <algorithm>

#include "scene/settings.h"
#include "scene/text.h"

namespace thermocontact::scene {

namespace {

bool is_declared(const std::string& pattern) {
    return find_key(pattern) != nullptr || is_table(pattern);
}

/// Every declared table and key, outer ones first.
std::vector<std::string> declared_names() {
    std::vector<std::string> names;
    for (const Key& key : schema()) {
        const auto parts = split(key.name);
        for (std::size_t n = 1; n <= parts.size(); ++n) {
            const std::string name = join(parts, n);
            if (std::find(names.begin(), names.end(), name) == names.end()) {
                names.push_back(name);
            }
        }
    }
    return names;
}

std::vector<std::string> members(const std::string& table) {
    std::vector<std::string> leaves;
    for (const std::string& name : declared_names()) {
        const auto parts = split(name);
        if (join(parts, parts.size() - 1) == table) {
            leaves.push_back(parts.back());
        }
    }
    return leaves;
}

std::vector<std::string> namesakes(const std::string& leaf, const std::string& boundary) {
    std::vector<std::string> names;
    for (const std::string& name : declared_names()) {
        const auto parts = split(name);
        if (parts.size() > 1 && parts.back() == leaf) {
            names.push_back(instance_of(name, boundary));
        }
    }
    return names;
}

/// A near name anywhere in the schema, dotted.
std::string near_elsewhere(const std::string& leaf, const std::string& boundary) {
    std::vector<std::string> leaves;
    for (const std::string& name : declared_names()) {
        leaves.push_back(split(name).back());
    }
    const std::string found = nearest(leaf, leaves);
    return found.empty()                        ? found
           : namesakes(found, boundary).empty() ? found
                                                : namesakes(found, boundary).front();
}

std::string suggestion(const std::string& table, const std::string& leaf, const std::string& boundary) {
    if (const auto names = namesakes(leaf, boundary); !names.empty()) {
        return "; did you mean " + one_of(names) + "?";
    }
    if (const std::string text = did_you_mean(leaf, members(table)); !text.empty()) {
        return text;
    }
    if (const std::string name = near_elsewhere(leaf, boundary); !name.empty()) {
        return "; did you mean \"" + name + "\"?";
    }
    return "; expected " + one_of(members(table));
}

void check_boundary(const Entry& entry, const std::string& name) {
    const std::string shape = "rectangle";  // the only shape that mesh.shape admits
    const auto names = boundary_names(shape);
    if (std::find(names.begin(), names.end(), name) == names.end()) {
        fail(entry.where, "boundary." + name + ": unknown boundary of the " + shape + "; expected " +
                              one_of(names) + did_you_mean(name, names));
    }
}

}  // namespace

void check_known(const Entry& entry) {
    const auto parts = split(entry.key);
    const bool of_boundary = parts.size() > 1 && parts[0] == "boundary";
    if (of_boundary) {
        check_boundary(entry, parts[1]);
    }
    const auto patterns = split(pattern_of(entry.key));
    for (std::size_t n = 1; n <= parts.size(); ++n) {
        if (!is_declared(join(patterns, n))) {
            fail(entry.where,
                 join(parts, n) + ": unknown key" +
                     suggestion(join(patterns, n - 1), parts[n - 1], of_boundary ? parts[1] : "NAME"));
        }
    }
    if (is_table(pattern_of(entry.key)) && !entry.is_table) {
        fail(entry.where, entry.key + ": expected a table, found " + show(entry.value));
    }
}

}  // namespace thermocontact::scene
