#include "scene/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace thermocontact::scene {

std::size_t edit_distance(std::string_view a, std::string_view b) {
    const std::size_t columns = b.size() + 1;
    std::vector<std::size_t> cost((a.size() + 1) * columns);
    const auto at = [&](std::size_t i, std::size_t j) -> std::size_t& { return cost[i * columns + j]; };
    for (std::size_t i = 0; i <= a.size(); ++i) {
        at(i, 0) = i;
    }
    for (std::size_t j = 0; j <= b.size(); ++j) {
        at(0, j) = j;
    }
    for (std::size_t i = 1; i <= a.size(); ++i) {
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replace = at(i - 1, j - 1) + (a[i - 1] == b[j - 1] ? 0 : 1);
            at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, replace});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
            }
        }
    }
    return at(a.size(), b.size());
}

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
    constexpr std::size_t longest = 64;  // no name is longer; keeps the table of distances small
    if (word.empty() || word.size() > longest) {
        return {};
    }
    std::size_t best = std::max<std::size_t>(1, word.size() / 3) + 1;  // more is no resemblance
    best = std::min(best, word.size());                                // nor is a word replaced as a whole
    std::string found;
    for (const std::string& candidate : candidates) {
        if (const std::size_t distance = edit_distance(word, candidate); distance < best) {
            best = distance;
            found = candidate;
        }
    }
    return found;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
    const std::string name = nearest(word, candidates);
    return name.empty() ? "" : "; did you mean \"" + name + "\"?";
}

std::string one_of(const std::vector<std::string>& names) {
    std::string list;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0) {
            list += i + 1 == names.size() ? " or " : ", ";
        }
        list += '"' + names[i] + '"';
    }
    return list;
}

std::string one_line(std::string_view text, std::size_t length) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string line;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20 || byte == 0x7f) {
            line += c == '\n' ? "\\n" : std::string("\\x") + digits[byte >> 4] + digits[byte & 0xf];
        } else {
            line += c;
        }
    }
    if (line.size() <= length) {
        return line;
    }
    std::size_t end = length;
    while (end > 0 && (static_cast<unsigned char>(line[end]) & 0xc0) == 0x80) {
        --end;  // never cut inside a UTF-8 character
    }
    return line.substr(0, end) + "...";
}

std::string number_text(double value) {
    if (!std::isfinite(value)) {
        return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
    }
    std::array<char, 32> buffer{};
    char* end = buffer.data() + buffer.size();
    const bool whole = std::abs(value) < 1e10 && value == std::floor(value);  // 100000000 rather than 1e+08
    const auto result = whole ? std::to_chars(buffer.data(), end, value, std::chars_format::fixed)
                              : std::to_chars(buffer.data(), end, value);
    return {buffer.data(), result.ptr};
}

namespace {

std::string show_whole(const nlohmann::json& value) {
    if (value.is_number_float()) {
        const std::string text = number_text(value.get<double>());
        const bool looks_integer = text.find_first_not_of("-0123456789") == std::string::npos;
        return looks_integer ? text + ".0" : text;
    }
    if (value.is_object()) {
        return "a table or a date";
    }
    if (!value.is_array()) {
        return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    }
    std::string list;
    for (const auto& item : value) {
        list += (list.empty() ? "" : ", ") + show_whole(item);
    }
    return "[" + list + "]";
}

}  // namespace

std::string show(const nlohmann::json& value) {
    return one_line(show_whole(value));
}

std::vector<std::string> split(std::string_view text) {
    std::vector<std::string> parts;
    std::size_t begin = 0;
    while (true) {
        const std::size_t dot = text.find('.', begin);
        parts.emplace_back(text.substr(begin, dot - begin));
        if (dot == std::string_view::npos) {
            return parts;
        }
        begin = dot + 1;
    }
}

std::string join(const std::vector<std::string>& parts, std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i) {
        text += (i == 0 ? "" : ".") + parts[i];
    }
    return text;
}

}  // namespace thermocontact::scene
