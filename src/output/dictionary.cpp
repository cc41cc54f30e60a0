#include "output/dictionary.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "output/dictionary_tables.h"

namespace thermocontact::output {
namespace {

std::vector<std::string> parts_of(const std::string& name) {
    std::vector<std::string> parts(1);
    for (const char c : name) {
        if (c == '.') {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    return parts;
}

/// Whether the parts of `pattern` are those of the name, NAME and BALANCE being anything.
bool matches(const std::string& pattern, const std::vector<std::string>& name) {
    const std::vector<std::string> parts = parts_of(pattern);
    return std::ranges::equal(parts, name, [](const std::string& expected, const std::string& found) {
        return expected == "NAME" || expected == "BALANCE" || expected == found;
    });
}

bool is_declared(Place place, const std::vector<std::string>& name) {
    return std::ranges::any_of(quantities(place),
                               [&](const Quantity& quantity) { return matches(quantity.name, name); });
}

/// `name`: where `value` stands.
void collect(const nlohmann::json& value, std::vector<std::string>& name, std::vector<std::string>& result) {
    if (is_declared(Place::summary_opened, name)) {
        return;
    }
    if (!value.is_object() || value.empty()) {
        if (!is_declared(Place::summary, name) && !(value.is_object() && value.empty())) {
            std::string text;
            for (const std::string& part : name) {
                text += (text.empty() ? "" : ".") + part;
            }
            result.push_back(text);
        }
        return;
    }
    for (const auto& [key, entry] : value.items()) {
        name.push_back(key);
        collect(entry, name, result);
        name.pop_back();
    }
}

}  // namespace

const std::vector<Quantity>& quantities(Place place) {
    static const std::vector<Quantity> history = history_columns(), steps = steps_columns(),
                                       body = body_fields(), contact = contact_fields(),
                                       summary = summary_entries(), opened = summary_opened_entries();
    switch (place) {
        case Place::history:
            return history;
        case Place::steps:
            return steps;
        case Place::body:
            return body;
        case Place::contact:
            return contact;
        case Place::summary:
            return summary;
        case Place::summary_opened:
            break;
    }
    return opened;
}

const Quantity& declared(Place place, const std::string& name) {
    const std::vector<Quantity>& all = quantities(place);
    const auto found = std::ranges::find(all, name, &Quantity::name);
    if (found == all.end()) {
        throw std::logic_error("\"" + name +
                               "\" is written to results, but not declared in output/dictionary_tables.cpp");
    }
    return *found;
}

std::vector<std::string> undeclared(const std::string& json) {
    std::vector<std::string> result, name;
    collect(nlohmann::json::parse(json), name, result);
    return result;
}

}  // namespace thermocontact::output
