#include "mesh/grading.h"

#include <algorithm>
#include <cmath>

namespace thermocontact::mesh {
namespace {

/// d(s): how far from its side, of the length of the axis, a point is that belongs to a side of ratio `here`.
double distance(double s, double here, double opposite) {
    const double share = -std::expm1(-std::log(here)) - std::expm1(-std::log(opposite));  // D
    return std::expm1(s * (std::log(here) + std::log(opposite))) / here / share;
}

}  // namespace

double coordinate(const Axis& axis, double place) {
    const auto [a, b] = axis.grading;
    const double length = axis.upper - axis.lower, n = axis.cells;
    if (place == 0 || place == n) {
        return place == 0 ? axis.lower : axis.upper;
    }
    if (a == 1 && b == 1) {
        return axis.lower + place * (length / n);
    }
    // s < m, written so that equal ratios find the middle exactly, whatever the compiler fuses
    const double before = place * std::log(b), after = (n - place) * std::log(a);
    const double from_lower = axis.lower + distance(place / n, a, b) * length;
    const double from_upper = axis.upper - distance((n - place) / n, b, a) * length;
    return before < after ? from_lower : before > after ? from_upper : (from_lower + from_upper) / 2;
}

double smallest_cell(const Axis& axis) {
    return std::min(coordinate(axis, 1) - axis.lower, axis.upper - coordinate(axis, axis.cells - 1));
}

}  // namespace thermocontact::mesh
