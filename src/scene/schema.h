/// Every key of a scene, declared once: what validation, messages, `resolved` and `thermocontact schema` are
/// made of.
#pragma once

#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "laws/description.h"

namespace thermocontact::scene {

/// Components of a symmetric tensor in d dimensions.
constexpr int voigt_size(int d) {
    return d * (d + 1) / 2;
}

enum class Type {
    text,
    choice,               ///< one of Key::choices
    choices,              ///< a list of names among Key::choices
    integer,              ///< in Key::range
    integer_or_choice,    ///< in Key::range, or one of Key::choices
    number,               ///< in Key::range
    numbers,              ///< [d]
    integers,             ///< [d], each in Key::range
    expression,           ///< number or formula
    expressions,          ///< [d]
    free_expressions,     ///< [d], each possibly "free"
    symmetric_tensor,     ///< number or symmetric d x d matrix
    semidefinite_tensor,  ///< number > 0 or symmetric positive semidefinite d x d matrix
    voigt_tensor          ///< symmetric positive semidefinite matrix, 3 x 3 in 2D, 6 x 6 in 3D
};

struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool low_open = false;
    bool high_open = false;
    bool infinite = false;  ///< inf itself is a value

    bool contains(double value) const;
    std::string text() const;  ///< "> 0", "in (-1, 0.5)"; empty: unlimited
};

/// Names are dotted; NAME stands for a boundary's or a region's name. Defaults and examples are JSON text
/// that is TOML as well.
struct Key {
    std::string name;
    Type type;
    std::string unit = {};
    Range range = {};
    std::vector<std::string> choices = {};
    std::string fallback = {};  ///< default; empty: none
    bool required = false;      ///< wherever its table is present
    std::string instead = {};   ///< the key that takes its place: exactly one of the two is in force
    std::vector<std::string> excludes = {};  ///< keys and tables that cannot stand beside it
    std::vector<std::string> needs = {};     ///< keys and tables without which it has no meaning
    std::string example;
    std::string description;

    std::string table() const;  ///< "mesh" of "mesh.cells"; empty for `title`
    std::string leaf() const;   ///< "cells" of "mesh.cells"
};

/// Declarations by name.
class Schema {
  public:
    /// Keys in the order of the reference; `tables` beyond those that the keys stand in.
    Schema(std::vector<Key> keys, const std::vector<std::string>& tables);

    const std::vector<Key>& keys() const { return keys_; }

    /// The declaration of `pattern` ("boundary.NAME.traction"), or nullptr.
    const Key* find(const std::string& pattern) const;

    /// Whether `pattern` is the dotted name of a table.
    bool is_table(const std::string& pattern) const { return tables_.contains(pattern); }

    /// Every table and key, outer ones first.
    std::vector<std::string> names() const;

  private:
    std::vector<Key> keys_;
    std::map<std::string, std::size_t> index_;
    std::set<std::string> tables_;
};

/// That of scenes with the built-in laws.
const Schema& schema();

/// That of a scene whose law files say this of themselves: their parameters take the place of the keys of the
/// built-in laws. Throws SceneError where a parameter has the name of a key that stays.
std::shared_ptr<const Schema> schema_with(const std::vector<laws::Description>& laws);

/// The table of a law's parameters: "boundary.NAME.contact.friction".
std::string table_of_law(const std::string& kind);

/// Whether that law of a scene without a file is a key, and no table of parameters: an expression.
bool is_key_otherwise(const std::string& kind);

/// Laws that a scene may name a file for.
std::vector<std::string> law_kinds();

/// Whether the table is in force without being written: its defaults always hold and its required keys must
/// be there.
bool is_always_present(const std::string& table);

/// Whether `parts` of a dotted name go through a named boundary or region, which is then parts[1].
bool is_named(const std::vector<std::string>& parts);

/// "boundary.left.traction" -> "boundary.NAME.traction"; other names unchanged.
std::string pattern_of(const std::string& name);

/// The inverse, for the boundary or region `name`; names without NAME unchanged.
std::string instance_of(const std::string& pattern, const std::string& name);

/// "integer", "d numbers", ...
std::string type_name(Type type);

/// What a message says was expected in `dimension` dimensions: "a number > 0 (kg/m^3)".
std::string expectation(const Key& key, int dimension);

/// The reference in `format` "toml", "json" or "markdown".
std::string print_schema(const std::string& format, const Schema& schema = scene::schema());

}  // namespace thermocontact::scene
