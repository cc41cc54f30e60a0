/// A reader of VTK's XML as written here, for the tests: a second, independent view of the format.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace thermocontact::output {

/// Decodes character by character: six bits each, until the padding.
inline std::vector<std::uint8_t> decode_base64(const std::string& text) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<std::uint8_t> bytes;
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        if (c == '=') {
            break;
        }
        const auto digit = digits.find(c);
        EXPECT_NE(digit, std::string::npos) << "not base64: " << c;
        bits = bits << 6 | static_cast<std::uint32_t>(digit & 63);
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes.push_back(static_cast<std::uint8_t>(bits >> count & 255));
        }
    }
    EXPECT_EQ(text.size() % 4, 0U);
    return bytes;
}

/// The text between the first `begin` after `from` and the next `end`.
inline std::string between(const std::string& text, const std::string& begin, const std::string& end,
                           std::size_t from = 0) {
    const std::size_t at = text.find(begin, from);
    EXPECT_NE(at, std::string::npos) << begin;
    if (at == std::string::npos) {
        return "";
    }
    const std::size_t start = at + begin.size();
    return text.substr(start, text.find(end, start) - start);
}

/// The array of that name: its size header is checked against what follows.
template <typename Number>
std::vector<Number> read_array(const std::string& vtu, const std::string& name, const std::string& type,
                               int components) {
    const std::size_t at = vtu.find("Name=\"" + name + "\"");
    EXPECT_NE(at, std::string::npos) << "no array " << name;
    if (at == std::string::npos) {
        return {};
    }
    const std::size_t open = vtu.rfind('<', at), close = vtu.find('>', at);
    const std::string tag = vtu.substr(open, close - open + 1);
    EXPECT_NE(tag.find("<DataArray "), std::string::npos) << tag;
    EXPECT_NE(tag.find("type=\"" + type + "\""), std::string::npos) << tag;
    EXPECT_NE(tag.find("NumberOfComponents=\"" + std::to_string(components) + "\""), std::string::npos)
        << tag;
    EXPECT_NE(tag.find("format=\"binary\""), std::string::npos) << tag;
    const std::vector<std::uint8_t> bytes =
        decode_base64(vtu.substr(close + 1, vtu.find('<', close) - close - 1));
    std::uint64_t size = 0;
    EXPECT_GE(bytes.size(), sizeof size);
    for (std::size_t i = 0; i < 8; ++i) {  // little endian
        size |= static_cast<std::uint64_t>(bytes[i]) << 8 * i;
    }
    EXPECT_EQ(size, bytes.size() - sizeof size) << name;
    std::vector<Number> values(size / sizeof(Number));
    if (size > 0) {
        std::memcpy(values.data(), bytes.data() + sizeof size, size);
    }
    return values;
}

}  // namespace thermocontact::output
