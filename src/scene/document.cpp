#include "scene/document.h"

#include <toml++/toml.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "error.h"
#include "scene/text.h"

namespace thermocontact::scene {

namespace {

constexpr std::size_t largest_file = 4 << 20;   // bytes
constexpr std::size_t part_of_file = 16 << 10;  // bytes read at once: mostly all there is
// toml++ recurses over nested tables, so that a hostile key "a.a.a..." would exhaust the stack.
constexpr int most_dots_in_a_line = 100;
constexpr int deepest_table = 100;

bool is_bare(std::string_view key) {
    return !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
               c == '-';
    });
}

nlohmann::json to_json(const toml::node& node) {
    if (const auto* text = node.as_string()) {
        return text->get();
    }
    if (const auto* integer = node.as_integer()) {
        return integer->get();
    }
    if (const auto* number = node.as_floating_point()) {
        return number->get();
    }
    if (const auto* boolean = node.as_boolean()) {
        return boolean->get();
    }
    if (const auto* array = node.as_array()) {
        auto list = nlohmann::json::array();
        for (const auto& item : *array) {
            list.push_back(to_json(item));
        }
        return list;
    }
    return nlohmann::json::object();
}

class Flattener {
  public:
    explicit Flattener(Location where) : where_(std::move(where)) {}

    void add(const toml::table& table, const std::string& prefix, int depth) {
        for (const auto& [name, node] : table) {
            Location where = where_;
            if (where.order == 0) {
                where.line = static_cast<int>(node.source().begin.line);
            }
            if (!is_bare(name.str())) {
                fail(where, prefix + '"' + one_line(name.str(), 40) +
                                "\": unknown key; keys consist of letters, digits, _ and -");
            }
            const std::string key = prefix + std::string(name.str());
            if (depth > deepest_table) {
                fail(where, one_line(key) + ": tables nested too deeply");
            }
            const auto* child = node.as_table();
            entries.push_back(
                {key, where, child != nullptr, child != nullptr ? nlohmann::json() : to_json(node)});
            positions.push_back(node.source().begin);
            if (child != nullptr) {
                add(*child, key + ".", depth + 1);
            }
        }
    }

    std::vector<Entry> in_order_of_the_file() const {
        std::vector<std::size_t> order(entries.size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            order[i] = i;
        }
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return positions[a] < positions[b]; });
        std::vector<Entry> sorted;
        sorted.reserve(entries.size());
        for (const std::size_t i : order) {
            sorted.push_back(entries[i]);
        }
        return sorted;
    }

  private:
    Location where_;
    std::vector<Entry> entries;
    std::vector<toml::source_position> positions;
};

void check_dots(std::string_view text, Location where) {
    int dots = 0;
    int line = 1;
    char quote = 0;  // of the string, or # of the comment, that goes on
    for (const char c : text) {
        if (c == '\n') {
            ++line;
            dots = 0;
            quote = 0;
        } else if (quote != 0) {
            quote = c == quote && quote != '#' ? '\0' : quote;
        } else if (c == '"' || c == '\'' || c == '#') {
            quote = c;
        } else if (c == '.' && ++dots > most_dots_in_a_line) {
            where.line = where.order == 0 ? line : 0;
            fail(where, "more than " + std::to_string(most_dots_in_a_line) + " dots in one line");
        }
    }
}

std::string read_text(const std::filesystem::path& path) {
    const std::string name = path.string();
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) {
        throw SceneError(name + ": is a directory, expected a scene file");
    }
    std::ifstream file(path, std::ios::binary);
    if (!file) {
        const bool exists = std::filesystem::exists(path, ignored);
        throw SceneError(name + (exists ? ": cannot be read" : ": no such file"));
    }
    std::string text;
    while (file && text.size() <= largest_file) {
        const std::size_t before = text.size();
        text.resize(before + part_of_file);
        file.read(text.data() + before, static_cast<std::streamsize>(part_of_file));
        text.resize(before + static_cast<std::size_t>(file.gcount()));
    }
    if (file.bad()) {
        throw SceneError(name + ": cannot be read");
    }
    if (text.size() > largest_file) {
        throw SceneError(name + ": larger than 4 MiB, hence no scene file");
    }
    return text;
}

}  // namespace

std::string Location::text() const {
    return line > 0 ? source + ":" + std::to_string(line) : source;
}

std::string Location::brief() const {
    return line > 0 ? "line " + std::to_string(line) : source;
}

const Entry* Document::find(const std::string& key) const {
    const auto found =
        std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.key == key; });
    return found == entries.end() ? nullptr : &*found;
}

void fail(const Location& where, const std::string& message) {
    throw SceneError(where.text() + ": " + message);
}

std::vector<Entry> parse_entries(std::string_view text, const Location& where) {
    check_dots(text, where);
    try {
        Flattener flattener(where);
        flattener.add(toml::parse(text), "", 1);
        return flattener.in_order_of_the_file();
    } catch (const toml::parse_error& error) {
        Location place = where;
        place.line = where.order == 0 ? static_cast<int>(error.source().begin.line) : 0;
        const std::string column = std::to_string(error.source().begin.column);
        fail(place, "not valid TOML: " + one_line(error.description(), 200) +
                        (where.order == 0 ? " (column " + column + ")" : ""));
    }
}

Document read_document(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
    Document document;
    document.file = path.string();
    document.entries = parse_entries(read_text(path), {.source = document.file});
    int order = 0;
    for (const std::string& argument : overrides) {
        apply_override(document, argument, ++order);
    }
    return document;
}

}  // namespace thermocontact::scene
