/// Numbers as text: short for people, exact for files.
#pragma once

#include <string>

namespace thermocontact {

/// At most 6 digits: "0.0123", "1e-12".
std::string short_text(double value);

/// 17 digits, which read back as the same number.
std::string exact_text(double value);

}  // namespace thermocontact
