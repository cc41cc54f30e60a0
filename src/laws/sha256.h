/// SHA-256 (FIPS 180-4), by which compiled laws are found again.
#pragma once

#include <string>
#include <string_view>

namespace thermocontact::laws {

/// 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace thermocontact::laws
