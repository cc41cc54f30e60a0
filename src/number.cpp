#include "number.h"

#include <array>
#include <charconv>

namespace thermocontact {
namespace {

/// As printf's %.{digits}g.
std::string print(int digits, double value) {
    std::array<char, 40> text{};
    const auto end = std::to_chars(text.begin(), text.end(), value, std::chars_format::general, digits).ptr;
    return {text.begin(), end};
}

}  // namespace

std::string short_text(double value) {
    return print(6, value);
}

std::string exact_text(double value) {
    return print(17, value);
}

}  // namespace thermocontact
