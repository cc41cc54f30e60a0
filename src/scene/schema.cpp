#include "scene/schema.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "scene/text.h"

namespace thermocontact::scene {

namespace {

constexpr std::string_view placeholder = "NAME";

std::string with_unit(const std::string& text, const Key& key) {
    return key.unit.empty() ? text : text + " (" + key.unit + ")";
}

std::string variables(int dimension) {
    return dimension == 3 ? "x, y, z, t" : "x, y, t";
}

std::string matrix(int n) {
    return std::to_string(n) + " x " + std::to_string(n) + " matrix";
}

std::string ranged(const std::string& what, const Key& key) {
    const std::string range = key.range.text();
    return range.empty() ? what : what + " " + range;
}

}  // namespace

bool Range::contains(double value) const {
    if (!std::isfinite(value) && !(infinite && value > 0)) {
        return false;
    }
    return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
}

std::string Range::text() const {
    if (std::isinf(low) && std::isinf(high)) {
        return {};
    }
    if (std::isinf(high)) {
        return (low_open ? "> " : ">= ") + number_text(low);
    }
    return std::string("in ") + (low_open ? "(" : "[") + number_text(low) + ", " + number_text(high) +
           (high_open ? ")" : "]");
}

std::string Key::table() const {
    const auto parts = split(name);
    return join(parts, parts.size() - 1);
}

std::string Key::leaf() const {
    return split(name).back();
}

Schema::Schema(std::vector<Key> keys, const std::vector<std::string>& tables) : keys_(std::move(keys)) {
    for (std::size_t i = 0; i < keys_.size(); ++i) {
        index_.emplace(keys_[i].name, i);
        const auto parts = split(keys_[i].name);
        for (std::size_t n = 1; n < parts.size(); ++n) {
            tables_.insert(join(parts, n));
        }
    }
    tables_.insert(tables.begin(), tables.end());
}

const Key* Schema::find(const std::string& pattern) const {
    const auto found = index_.find(pattern);
    return found == index_.end() ? nullptr : &keys_[found->second];
}

std::vector<std::string> Schema::names() const {
    std::vector<std::string> names;
    const auto add = [&](const std::string& name) {
        if (std::find(names.begin(), names.end(), name) == names.end()) {
            names.push_back(name);
        }
    };
    for (const Key& key : keys_) {
        const auto parts = split(key.name);
        for (std::size_t n = 1; n <= parts.size(); ++n) {
            add(join(parts, n));
        }
    }
    std::for_each(tables_.begin(), tables_.end(), add);
    return names;
}

bool is_always_present(const std::string& table) {
    static const std::set<std::string> names = {"", "mesh", "space", "time", "solver", "output"};
    return names.contains(table);
}

bool is_named(const std::vector<std::string>& parts) {
    return parts.size() > 1 && (parts[0] == "boundary" || parts[0] == "region");
}

std::string pattern_of(const std::string& name) {
    auto parts = split(name);
    if (is_named(parts)) {
        parts[1] = placeholder;
    }
    return join(parts, parts.size());
}

std::string instance_of(const std::string& pattern, const std::string& name) {
    auto parts = split(pattern);
    std::replace(parts.begin(), parts.end(), std::string(placeholder), name);
    return join(parts, parts.size());
}

std::string type_name(Type type) {
    switch (type) {
        case Type::text:
            return "string";
        case Type::choice:
            return "choice";
        case Type::choices:
            return "list of choices";
        case Type::integer:
            return "integer";
        case Type::integer_or_choice:
            return "integer or choice";
        case Type::number:
            return "number";
        case Type::numbers:
            return "d numbers";
        case Type::integers:
            return "d integers";
        case Type::expression:
            return "expression";
        case Type::expressions:
            return "d expressions";
        case Type::free_expressions:
            return "d expressions or free";
        case Type::symmetric_tensor:
            return "symmetric tensor";
        case Type::semidefinite_tensor:
            return "positive semidefinite tensor";
        case Type::voigt_tensor:
            return "positive semidefinite Voigt matrix";
    }
    return {};
}

std::string expectation(const Key& key, int dimension) {
    const std::string array = "an array of " + std::to_string(dimension) + " ";
    switch (key.type) {
        case Type::text:
            return "a string";
        case Type::choice:
            return one_of(key.choices);
        case Type::choices:
            return "a list of names, each once, among " + one_of(key.choices);
        case Type::integer:
            return with_unit(ranged("an integer", key), key);
        case Type::integer_or_choice:
            return ranged("an integer", key) + " or " + one_of(key.choices);
        case Type::number:
            return with_unit(ranged("a number", key), key);
        case Type::numbers:
            return with_unit(array + "numbers", key);
        case Type::integers:
            return with_unit(array + ranged("integers", key), key);
        case Type::expression:
            return with_unit("a number or an expression in " + variables(dimension), key);
        case Type::expressions:
            return with_unit(array + "numbers or expressions in " + variables(dimension), key);
        case Type::free_expressions:
            return with_unit(array + "numbers, expressions in " + variables(dimension) + " or \"free\"", key);
        case Type::symmetric_tensor:
            return with_unit("a number or a symmetric " + matrix(dimension), key);
        case Type::semidefinite_tensor:
            return with_unit("a number > 0 or a symmetric positive semidefinite " + matrix(dimension), key);
        case Type::voigt_tensor:
            return with_unit("a symmetric positive semidefinite " + matrix(voigt_size(dimension)), key);
    }
    return {};
}

}  // namespace thermocontact::scene
