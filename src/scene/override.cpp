// `--set KEY=VALUE`: VALUE takes the place of whatever the scene has at KEY.

#include <algorithm>

#include "error.h"
#include "scene/document.h"
#include "scene/text.h"

namespace thermocontact::scene {

namespace {

std::string trimmed(const std::string& text) {
    const std::size_t begin = text.find_first_not_of(" \t");
    if (begin == std::string::npos) {
        return {};
    }
    return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

bool is_bare_path(const std::string& key) {
    constexpr std::string_view allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
    return !key.empty() && key.find_first_not_of(allowed) == std::string::npos && key.front() != '.' &&
           key.back() != '.' && key.find("..") == std::string::npos;
}

std::string quoting_hint(const std::string& key, const std::string& value) {
    if (value.empty() || value.find_first_of("\"'\n") != std::string::npos) {
        return {};
    }
    if (value.front() == '[' || value.front() == '{') {
        return "; strings in it need quotes";
    }
    return "; a string needs quotes: --set '" + key + "=\"" + one_line(value) + "\"'";
}

/// Entries of the value alone, the first of them with key "value".
std::vector<Entry> parse_value(const std::string& key, const std::string& value, const Location& where) {
    std::vector<Entry> entries;
    try {
        entries = parse_entries("value = " + value, where);
    } catch (const SceneError&) {
        fail(where, key + ": the value is not valid TOML" + quoting_hint(key, value));
    }
    const bool single = !entries.empty() && std::all_of(entries.begin(), entries.end(), [](const Entry& e) {
        return e.key == "value" || e.key.starts_with("value.");
    });
    if (!single) {
        fail(where, key + ": one value expected");
    }
    return entries;
}

/// Makes sure that the tables above `key` exist and are tables.
void open_tables(Document& document, const std::string& key, const Location& where) {
    const auto parts = split(key);
    for (std::size_t n = 1; n < parts.size(); ++n) {
        const std::string parent = join(parts, n);
        const Entry* entry = document.find(parent);
        if (entry == nullptr) {
            document.entries.push_back({parent, where, true, {}});
        } else if (!entry->is_table) {
            fail(where,
                 parent + ": is no table but " + show(entry->value) + " (" + entry->where.text() + ")");
        }
    }
}

}  // namespace

void apply_override(Document& document, const std::string& argument, int order) {
    const Location where{.source = "--set " + one_line(argument, 100), .order = order};
    const std::size_t equals = argument.find('=');
    if (equals == std::string::npos) {
        fail(where, "expected KEY=VALUE, for instance --set mesh.cells=[32,32]");
    }
    const std::string key = trimmed(argument.substr(0, equals));
    if (!is_bare_path(key) || split(key).size() > 20) {
        fail(where,
             "expected a dotted key such as mesh.cells before \"=\", found \"" + one_line(key, 40) + '"');
    }
    std::vector<Entry> added = parse_value(key, trimmed(argument.substr(equals + 1)), where);
    open_tables(document, key, where);
    std::erase_if(document.entries,
                  [&](const Entry& e) { return e.key == key || e.key.starts_with(key + "."); });
    for (Entry& entry : added) {
        entry.key = key + entry.key.substr(std::string_view("value").size());
        document.entries.push_back(std::move(entry));
    }
}

}  // namespace thermocontact::scene
