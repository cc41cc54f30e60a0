#include <cmath>

#include "error.h"
#include "scene/schema.h"
#include "scene/text.h"

namespace thermocontact::scene {

namespace {

using nlohmann::ordered_json;

ordered_json value_or_null(const std::string& text) {
    return text.empty() ? ordered_json(nullptr) : ordered_json::parse(text);
}

ordered_json text_or_null(const std::string& text) {
    return text.empty() ? ordered_json(nullptr) : ordered_json(text);
}

ordered_json bound(double value) {
    return std::isinf(value) ? ordered_json(nullptr) : ordered_json(value);
}

ordered_json range_json(const Range& range) {
    if (range.text().empty()) {
        return nullptr;
    }
    return {{"low", bound(range.low)},
            {"high", bound(range.high)},
            {"low_open", range.low_open},
            {"high_open", range.high_open}};
}

std::string as_json(const Schema& schema) {
    ordered_json list = ordered_json::array();
    for (const Key& key : schema.keys()) {
        list.push_back({{"key", key.name},
                        {"type", type_name(key.type)},
                        {"unit", text_or_null(key.unit)},
                        {"default", value_or_null(key.fallback)},
                        {"range", range_json(key.range)},
                        {"choices", key.choices.empty() ? ordered_json(nullptr) : ordered_json(key.choices)},
                        {"required", key.required},
                        {"instead", text_or_null(key.instead)},
                        {"excludes", key.excludes},
                        {"needs", key.needs},
                        {"example", value_or_null(key.example)},
                        {"description", key.description}});
    }
    return list.dump(2) + "\n";
}

/// "required", "required unless tensor is given", "default 4".
std::string presence(const Key& key) {
    std::string text = key.required           ? "required"
                       : key.fallback.empty() ? "optional"
                                              : "default " + key.fallback;
    if (!key.instead.empty()) {
        text += " unless " + split(key.instead).back() + " is given";
    }
    return text;
}

/// Range and choices together: `in [1, 9] or "vertex"`.
std::string admissible(const Key& key) {
    std::string text = key.range.text();
    if (!key.choices.empty()) {
        text += (text.empty() ? "" : " or ") + one_of(key.choices);
    }
    return text;
}

std::string relations(const Key& key) {
    std::string text;
    for (const auto& name : key.needs) {
        text += "; needs " + name;
    }
    for (const auto& name : key.excludes) {
        text += "; excludes " + name;
    }
    return text;
}

std::string as_toml(const Schema& schema) {
    std::string text =
        "# Every key of a scene with an example. Not a scene itself: some keys exclude each other.\n";
    std::string table;
    for (const Key& key : schema.keys()) {
        if (key.table() != table) {
            table = key.table();
            text += "\n[" + table + "]\n";
        }
        const std::string unit = key.unit.empty() ? "" : ", " + key.unit;
        const std::string values = admissible(key).empty() ? "" : ", " + admissible(key);
        text += "# " + key.description + "\n# " + type_name(key.type);
        text += unit;
        text +=
            values + "; " + presence(key) + relations(key) + "\n" + key.leaf() + " = " + key.example + "\n";
    }
    return text;
}

std::string code(const std::string& text) {
    return text.empty() ? "" : "`" + text + "`";
}

std::string as_markdown(const Schema& schema) {
    std::string text = "# Scene keys\n";
    std::string section = "none";
    for (const Key& key : schema.keys()) {
        if (key.table() != section) {
            section = key.table();
            text += "\n" + (section.empty() ? "" : "## `[" + section + "]`\n\n") +
                    "| key | type | unit | range | presence | meaning | example |\n"
                    "| --- | --- | --- | --- | --- | --- | --- |\n";
        }
        text += "| `" + key.leaf() + "` | " + type_name(key.type) + " | " + key.unit + " | " +
                admissible(key) + " | " + presence(key) + relations(key) + " | " + key.description + " | " +
                code(key.example) + " |\n";
    }
    return text;
}

}  // namespace

std::string print_schema(const std::string& format, const Schema& schema) {
    if (format == "toml") {
        return as_toml(schema);
    }
    if (format == "json") {
        return as_json(schema);
    }
    if (format == "markdown") {
        return as_markdown(schema);
    }
    throw SceneError("schema --format: expected \"toml\", \"json\" or \"markdown\", found \"" +
                     one_line(format) + "\"");
}

}  // namespace thermocontact::scene
