#include "number.h"

#include <array>
#include <cstdio>

namespace thermocontact {
namespace {

std::string print(const char* format, double value) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), format, value);
    return text.data();
}

}  // namespace

std::string short_text(double value) {
    return print("%.6g", value);
}

std::string exact_text(double value) {
    return print("%.17g", value);
}

}  // namespace thermocontact
