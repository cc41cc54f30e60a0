/// Numbers of a row of the history, and the size of nodal values.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "march/simulation.h"

namespace thermocontact::support {

/// The row must have it.
inline double value(const march::Record& record, const std::string& name) {
    return std::ranges::find(record, name, &march::Record::value_type::first)->second;
}

/// Largest magnitude; 0 of none.
inline double largest(const std::vector<double>& values) {
    double result = 0;
    for (const double v : values) {
        result = std::max(result, std::abs(v));
    }
    return result;
}

}  // namespace thermocontact::support
