/// Times as people write them.
#pragma once

#include <optional>
#include <string>

namespace thermocontact::plan {

/// "30", "30s", "5m", "1.5h" in seconds; nothing for what is no positive, finite time.
std::optional<double> parse_duration(const std::string& text);

/// "0.12 s", "34 s", "2.5 min", "3.1 h": two digits.
std::string duration_text(double seconds);

/// A value to two digits.
std::string about(double value);

}  // namespace thermocontact::plan
