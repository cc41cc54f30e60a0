/// Uniform steps from a step length.
#pragma once

#include <cmath>

namespace thermocontact::scene {

constexpr int most_steps = 1'000'000'000;

/// Number of steps of length `step` (s) that make up `end` (s) to a relative 1e-9, or 0 if there is none.
inline int steps_of(double end, double step) {
    const double steps = std::round(end / step);
    const bool divides = steps >= 1 && steps <= most_steps && std::abs(steps * step - end) <= 1e-9 * end;
    return divides ? static_cast<int>(steps) : 0;
}

}  // namespace thermocontact::scene
