// One value against its declaration: type, length, range, and the algebra of tensors.

#include <algorithm>
#include <array>
#include <cstdio>

#include "error.h"
#include "scene/expression.h"
#include "scene/settings.h"
#include "scene/tensors.h"
#include "scene/text.h"

namespace thermocontact::scene {

namespace {

using nlohmann::json;

/// Checks parts of one value; each function returns the normalised part.
class Checker {
  public:
    Checker(const Key& key, const Entry& entry, int dimension)
        : key_(key), entry_(entry), dimension_(dimension) {}

    json text(const json& value) const {
        expect(value.is_string());
        return value;
    }

    json choice(const json& value) const {
        expect(value.is_string());
        const auto name = value.get<std::string>();
        if (std::find(key_.choices.begin(), key_.choices.end(), name) == key_.choices.end()) {
            fail_value(key_, entry_, dimension_, did_you_mean(name, key_.choices));
        }
        return value;
    }

    json choices(const json& value) const {
        expect(value.is_array());
        for (auto item = value.begin(); item != value.end(); ++item) {
            choice(*item);
            expect(std::find(value.begin(), item, *item) == item);
        }
        return value;
    }

    json integer(const json& value) const {
        expect(value.is_number_integer() && key_.range.contains(value.get<double>()));
        return value;
    }

    json number(const json& value) const {
        expect(value.is_number() && key_.range.contains(value.get<double>()));
        return value.get<double>();
    }

    json expression(const json& value) const {
        expect(value.is_number() || value.is_string());
        if (value.is_number()) {
            return number(value);
        }
        try {
            return Expression(value.get<std::string>(), dimension_).text();
        } catch (const SceneError& error) {
            fail(entry_.where, entry_.key + ": bad expression " + error.what());
        }
    }

    json free_expression(const json& value) const { return value == "free" ? value : expression(value); }

    template <class Part>
    json vector(const json& value, Part part) const {
        expect(value.is_array() && value.size() == static_cast<std::size_t>(dimension_));
        json list = json::array();
        for (const auto& item : value) {
            list.push_back((this->*part)(item));
        }
        return list;
    }

    json matrix(const json& value, int n, bool semidefinite) const {
        const auto size = static_cast<std::size_t>(n);
        expect(value.is_array() && value.size() == size);
        json rows = json::array();
        std::vector<double> flat;
        for (const auto& row : value) {
            expect(row.is_array() && row.size() == size);
            rows.push_back(json::array());
            for (const auto& item : row) {
                rows.back().push_back(number(item));
                flat.push_back(item.get<double>());
            }
        }
        if (!is_symmetric(flat, n)) {
            fail_value(key_, entry_, dimension_, " (not symmetric)");
        }
        if (const double smallest = smallest_eigenvalue(flat, n); semidefinite && !(smallest >= 0)) {
            fail_value(key_, entry_, dimension_, " (smallest eigenvalue " + rounded(smallest) + ")");
        }
        return rows;
    }

    json tensor(const json& value, bool semidefinite) const {
        if (!value.is_number()) {
            return matrix(value, dimension_, semidefinite);
        }
        expect(!semidefinite || value.get<double>() > 0);
        return number(value);
    }

  private:
    static std::string rounded(double value) {
        std::array<char, 32> text{};
        std::snprintf(text.data(), text.size(), "%.3g", value);
        return text.data();
    }

    void expect(bool condition) const {
        if (!condition) {
            fail_value(key_, entry_, dimension_);
        }
    }

    const Key& key_;
    const Entry& entry_;
    int dimension_;
};

}  // namespace

void fail_value(const Key& key, const Entry& entry, int dimension, const std::string& remark) {
    const std::string found = entry.is_table ? "a table" : show(entry.value);
    fail(entry.where, entry.key + ": expected " + expectation(key, dimension) + ", found " + found + remark);
}

json check_value(const Key& key, const Entry& entry, int dimension) {
    const Checker check(key, entry, dimension);
    const json& value = entry.value;
    if (entry.is_table) {
        fail_value(key, entry, dimension);
    }
    switch (key.type) {
        case Type::text:
            return check.text(value);
        case Type::choice:
            return check.choice(value);
        case Type::choices:
            return check.choices(value);
        case Type::integer:
            return check.integer(value);
        case Type::integer_or_choice:
            return value.is_string() ? check.choice(value) : check.integer(value);
        case Type::number:
            return check.number(value);
        case Type::numbers:
            return check.vector(value, &Checker::number);
        case Type::integers:
            return check.vector(value, &Checker::integer);
        case Type::expression:
            return check.expression(value);
        case Type::expressions:
            return check.vector(value, &Checker::expression);
        case Type::free_expressions:
            return check.vector(value, &Checker::free_expression);
        case Type::symmetric_tensor:
            return check.tensor(value, false);
        case Type::semidefinite_tensor:
            return check.tensor(value, true);
        case Type::voigt_tensor:
            return check.matrix(value, voigt_size(dimension), true);
    }
    fail_value(key, entry, dimension);
}

}  // namespace thermocontact::scene
