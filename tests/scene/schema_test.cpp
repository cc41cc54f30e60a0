// Every key of the schema, exercised by what its declaration says.

#include "scene/schema.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "scene/document.h"
#include "scene/text.h"
#include "scene_files.h"

namespace thermocontact::scene {

void PrintTo(const Key& key, std::ostream* out) {
    *out << key.name;
}

namespace {

constexpr const char* boundary = "left";

using Values = std::map<std::string, std::string>;  ///< TOML by dotted key

/// Takes `name` and everything below it out of `values`.
void take_out(Values& values, const std::string& name) {
    std::erase_if(values,
                  [&](const auto& item) { return item.first == name || item.first.starts_with(name + "."); });
}

/// Makes `name` present with examples: itself, its table's required keys and whatever these need.
void put_in(Values& values, const std::string& pattern) {
    const std::string table = schema().find(pattern) != nullptr ? schema().find(pattern)->table() : pattern;
    for (const Key& key : schema().keys()) {
        const bool companion = key.table() == table && key.required && key.instead != pattern;
        if (key.name != pattern && !companion) {
            continue;
        }
        const std::string name = instance_of(key.name, boundary);
        if (!key.instead.empty() && values.contains(instance_of(key.instead, boundary))) {
            continue;
        }
        values.emplace(name, key.example);
        for (const std::string& needed : key.needs) {
            put_in(values, needed);
        }
    }
}

/// A scene that is valid with the example of `key` in it.
Values scene_with(const Key& key) {
    Values values = {{"mesh.cells", "[2, 2]"},
                     {"time.end", "1.0"},
                     {"time.steps", "4"},
                     {"material.density", "1.0"},
                     {"material.elasticity.young", "1.0"},
                     {"material.elasticity.poisson", "0.2"},
                     {"heat.capacity", "1.0"}};
    const std::string name = instance_of(key.name, boundary);
    for (const Key& other : schema().keys()) {
        const bool rival = other.instead == key.name || key.instead == other.name;
        if (rival) {
            take_out(values, other.name);
        }
    }
    if (key.name.starts_with("region.")) {
        take_out(values, "mesh.cells");
        values["mesh.file"] = "\"part.msh\"";
    }
    if (name == "mesh.grading.front" || name == "mesh.grading.back") {
        values["mesh.shape"] = "\"box\"";
        values["mesh.cells"] = "[2, 2, 2]";
    }
    values[name] = key.example;
    put_in(values, key.name);
    if (name.starts_with("forms.")) {  // a law that nothing is made of is refused
        put_in(values, table_of_law(key.leaf()));
        if (is_key_otherwise(key.leaf())) {  // whose place the parameters take
            take_out(values, table_of_law(key.leaf()));
            for (const laws::Parameter& parameter : laws::built_in_law(key.leaf()).description.parameters) {
                values[table_of_law(key.leaf()) + "." + parameter.key] = std::to_string(parameter.example);
            }
        }
    }
    const bool of_contact = name.find(".contact.") != std::string::npos;
    if (of_contact && !values.contains("boundary.left.contact.conductance.onset")) {
        put_in(values, "boundary.NAME.contact.compliance");
    }
    return values;
}

std::string text_of(const Values& values) {
    std::string text;
    for (const auto& [name, value] : values) {
        text += name + " = " + value + "\n";
    }
    return text;
}

class EveryKey : public testing::TestWithParam<Key> {};

TEST_P(EveryKey, AcceptsItsExampleAndResolvesIt) {
    const Key& key = GetParam();
    const std::string text = text_of(scene_with(key));
    ASSERT_EQ(message(text), "") << text;
    auto resolved = read(text).resolved;
    for (const std::string& part : split(instance_of(key.name, boundary))) {
        ASSERT_TRUE(resolved.contains(part)) << resolved.dump(1);
        const auto inner = resolved[part];
        resolved = inner;
    }
    EXPECT_EQ(resolved, nlohmann::ordered_json::parse(key.example));
}

TEST_P(EveryKey, RefusesAWrongTypeAndSaysWhatItExpects) {
    const Key& key = GetParam();
    const std::string name = instance_of(key.name, boundary);
    for (const char* wrong : {"true", "1979-05-27", "[true, true]", "[[[1]]]", "[{a = 1}]", "[nan, inf]"}) {
        Values values = scene_with(key);
        values[name] = wrong;
        const std::string text = message(text_of(values));
        EXPECT_NE(text.find(": " + name + ": expected " + expectation(key, 2) + ", found "),
                  std::string::npos)
            << text;
    }
}

TEST_P(EveryKey, RefusesValuesOutsideItsRange) {
    const Key& key = GetParam();
    if (key.type != Type::number && key.type != Type::integer && key.type != Type::integer_or_choice) {
        return;
    }
    const auto refused = [&](const std::string& value) {
        Values values = scene_with(key);
        values[instance_of(key.name, boundary)] = value;
        return message(text_of(values)).find(key.range.text()) != std::string::npos;
    };
    const bool whole = key.type != Type::number;
    if (std::isfinite(key.range.low)) {
        EXPECT_TRUE(refused(whole ? std::to_string(static_cast<long>(key.range.low) - 1) : "-1e6"));
        EXPECT_EQ(key.range.contains(key.range.low), !key.range.low_open);
    }
    if (std::isfinite(key.range.high)) {
        EXPECT_TRUE(refused(whole ? std::to_string(static_cast<long>(key.range.high) + 1) : "1e6"));
        EXPECT_EQ(key.range.contains(key.range.high), !key.range.high_open);
    }
    EXPECT_TRUE(refused("nan"));
    EXPECT_TRUE(refused("-inf"));
    EXPECT_EQ(key.range.contains(std::numeric_limits<double>::infinity()), key.range.infinite);
}

TEST_P(EveryKey, IsMissedWhereRequired) {
    const Key& key = GetParam();
    if (!key.required) {
        return;
    }
    Values values = scene_with(key);
    const std::string name = instance_of(key.name, boundary);
    values.erase(name);
    std::string text = text_of(values);
    const auto parts = split(name);
    const std::string table = join(parts, parts.size() - 1);
    if (text.find(table + ".") == std::string::npos) {
        text += "[" + table + "]\n";
    }
    const std::string what = message(text);
    EXPECT_NE(what.find(key.leaf() + " = " + key.example), std::string::npos) << what;
}

TEST_P(EveryKey, NeedsWhatItSays) {
    const Key& key = GetParam();
    const std::string name = instance_of(key.name, boundary);
    for (const std::string& needed : key.needs) {
        Values values = scene_with(key);
        take_out(values, instance_of(needed, boundary));
        if (needed != "heat.capacity") {
            values.emplace("heat.capacity", "1.0");
        }
        if (needed == "heat") {
            take_out(values, "heat");
        }
        values[name] = key.example;
        EXPECT_NE(message(text_of(values)).find("needs " + instance_of(needed, boundary)), std::string::npos)
            << message(text_of(values));
    }
}

TEST_P(EveryKey, IsDeclaredCompletely) {
    const Key& key = GetParam();
    EXPECT_FALSE(key.description.empty());
    EXPECT_EQ(key.description.back(), '.');
    EXPECT_FALSE(key.required && !key.fallback.empty());
    for (const std::string& name : key.needs) {
        EXPECT_TRUE(schema().find(name) != nullptr || schema().is_table(name)) << name;
    }
    for (const std::string& name : key.excludes) {
        EXPECT_TRUE(schema().find(name) != nullptr || schema().is_table(name)) << name;
    }
    EXPECT_TRUE(key.instead.empty() || schema().find(key.instead) != nullptr);
}

INSTANTIATE_TEST_SUITE_P(Schema, EveryKey, testing::ValuesIn(schema().keys()), [](const auto& info) {
    std::string name = info.param.name;
    std::replace(name.begin(), name.end(), '.', '_');
    return name;
});

/// Units as the equations have them: div sigma = f0 (N/m^3), c dtheta/dt = div(K grad theta) + q0 (W/m^3),
/// q.n = k_c theta (W/m^2), sigma = E e + V de/dt - theta M (Pa).
TEST(Schema, UnitsAreThoseOfTheEquations) {
    const std::map<std::string, std::string> units{
        {"mesh.lower", "m"},
        {"mesh.upper", "m"},
        {"time.end", "s"},
        {"time.step", "s"},
        {"material.density", "kg/m^3"},
        {"material.elasticity.young", "Pa"},
        {"material.elasticity.tensor", "Pa"},
        {"material.viscosity.trace", "Pa s"},
        {"material.viscosity.shear", "Pa s"},
        {"material.viscosity.tensor", "Pa s"},
        {"heat.capacity", "J/(m^3 K)"},
        {"heat.conductivity", "W/(m K)"},
        {"heat.source", "W/m^3"},
        {"heat.thermal_stress", "Pa/K"},
        {"heat.strain_heating", "W/m^3"},
        {"load.body_force", "N/m^3"},
        {"initial.displacement", "m"},
        {"initial.velocity", "m/s"},
        {"initial.temperature", "K"},
        {"boundary.NAME.displacement", "m"},
        {"boundary.NAME.traction", "Pa"},
        {"boundary.NAME.temperature", "K"},
        {"boundary.NAME.heat_flux", "W/m^2"},
        {"boundary.NAME.contact.gap", "m"},
        {"boundary.NAME.contact.compliance.stiffness", "Pa/m^exponent"},
        {"boundary.NAME.contact.friction.regularisation", "m/s"},
        {"boundary.NAME.contact.conductance.coefficient", "W/(m^2 K)"},
        {"boundary.NAME.contact.conductance.onset", "m"},
        {"boundary.NAME.contact.conductance.foundation_temperature", "K"},
        {"boundary.NAME.contact.conductance.limit", "K"}};
    for (const auto& [name, unit] : units) {
        ASSERT_NE(schema().find(name), nullptr) << name;
    }
    const std::string_view region = "region.NAME.";
    for (const Key& key : schema().keys()) {
        const auto known =
            units.find(key.name.starts_with(region) ? key.name.substr(region.size()) : key.name);
        if (known != units.end()) {
            EXPECT_EQ(key.unit, known->second) << key.name;
        }
    }
}

TEST(Schema, NamesAreUnique) {
    std::set<std::string> names;
    for (const Key& key : schema().keys()) {
        EXPECT_TRUE(names.insert(key.name).second) << key.name;
        EXPECT_FALSE(schema().is_table(key.name)) << key.name;
    }
}

TEST(Schema, JsonListsEveryKey) {
    const auto list = nlohmann::json::parse(print_schema("json"));
    ASSERT_EQ(list.size(), schema().keys().size());
    for (std::size_t i = 0; i < list.size(); ++i) {
        EXPECT_EQ(list[i]["key"], schema().keys()[i].name);
        for (const char* field : {"type", "unit", "default", "range", "choices", "required", "instead",
                                  "excludes", "needs", "example", "description"}) {
            EXPECT_TRUE(list[i].contains(field)) << field;
        }
    }
    EXPECT_EQ(list[0],
              nlohmann::json::parse(R"({"key": "title", "type": "string", "unit": null, "default": "",
        "range": null, "choices": null, "required": false, "instead": null, "excludes": [], "needs": [],
        "example": "sliding block", "description": "Title of the scene, repeated in the results."})"));
}

TEST(Schema, TomlIsToml) {
    const std::string text = print_schema("toml");
    std::set<std::string> names;
    for (const Entry& entry : parse_entries(text, {.source = "schema"})) {
        names.insert(entry.key);
    }
    for (const Key& key : schema().keys()) {
        EXPECT_TRUE(names.contains(key.name)) << key.name;
        EXPECT_NE(text.find("# " + key.description + "\n"), std::string::npos);
    }
}

TEST(Schema, MarkdownHasARowForEveryKey) {
    const std::string text = print_schema("markdown");
    for (const Key& key : schema().keys()) {
        EXPECT_NE(text.find("| `" + key.leaf() + "` | "), std::string::npos);
        EXPECT_TRUE(key.table().empty() || text.find("## `[" + key.table() + "]`") != std::string::npos);
    }
    EXPECT_NE(
        text.find("| `exponent` | number |  | >= 1 | default 1.0; needs material | Exponent of the normal "
                  "compliance law. | `1.5` |\n"),
        std::string::npos);
}

TEST(Schema, OtherFormatsAreRefused) {
    EXPECT_THROW(print_schema("xml"), SceneError);
}

}  // namespace
}  // namespace thermocontact::scene
