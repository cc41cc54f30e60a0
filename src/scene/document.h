/// The keys and values of a scene file with the places they stand at, after the `--set` overrides; nothing is
/// validated beyond TOML itself.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace thermocontact::scene {

struct Location {
    std::string source;  ///< scene file as the user named it, or `--set KEY=VALUE`
    int line = 0;        ///< 0: the whole source
    int order = 0;       ///< 0: file; n: n-th override

    std::string text() const;   ///< "scene.toml:12"
    std::string brief() const;  ///< "line 12", to name a second place of the same file
};

struct Entry {
    std::string key;  ///< dotted
    Location where;
    bool is_table = false;
    nlohmann::json value;  ///< of a leaf; tables inside arrays and dates are objects
};

struct Document {
    std::string file;
    std::vector<Entry> entries;  ///< in the order of the file, then of the overrides

    const Entry* find(const std::string& key) const;
};

/// Throws SceneError "WHERE: MESSAGE".
[[noreturn]] void fail(const Location& where, const std::string& message);

/// Reads `path` and applies each override "KEY=VALUE" (VALUE in TOML); a later one beats an earlier one.
Document read_document(const std::filesystem::path& path, const std::vector<std::string>& overrides);

/// Entries of the TOML text `text`; `where.line` is set to each entry's line, except for overrides.
std::vector<Entry> parse_entries(std::string_view text, const Location& where);

/// Replaces `argument`'s key in `document`; `order` counts the overrides from 1.
void apply_override(Document& document, const std::string& argument, int order);

}  // namespace thermocontact::scene
