/// When a balance is not kept (MODEL.md, 6), and what it is relative to.
///
/// A step is solved to `solver.tolerance` of its terms, and at round-off to 1e4 of it in sums over contact
/// (line_search.h): an audit beyond that is of a step that is not solved, or whose digits are lost.
///
/// The difference of the two sides is relative to the magnitudes of the terms, and to what the last bits of
/// the unknowns are worth in them, for no step is solved to less: a body at rest stores c theta and gives
/// nothing away, and c theta/tau, whose difference is the only term that is not zero, is known to some
/// epsilon of itself. A row of at most 243 terms leaves 16 epsilon at random, 64 are allowed
/// (condensed_problem.cpp); beside `least_audit`, which is asked for, they count as 64 epsilon/1e-8 of what
/// is stored. Beside terms that are not 1e6 times smaller that changes nothing.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace thermocontact::march {

constexpr double least_audit = 1e-8;

/// The largest relative residual of a balance in a step that is solved to `tolerance`.
inline double audit_limit(double tolerance) {
    constexpr double at_round_off = 1e4;
    return std::max(least_audit, at_round_off * tolerance);
}

/// What `stored` adds to the magnitudes that an audit is relative to; both of one unit.
inline double worth_of_round_off(double stored) {
    constexpr double roundings = 64;
    return roundings * std::numeric_limits<double>::epsilon() / least_audit * stored;
}

inline double relative(double difference, double scale) {
    return scale > 0 ? std::abs(difference) / scale : 0.0;
}

/// One kind of term of a balance: its name, with the key that makes it, and its magnitude.
struct Magnitude {
    const char* of;
    double value;
};

/// "its energy is kept only to 0.17 of its terms (1e-08 are allowed), ...": the two largest terms, the digits
/// that are left, and what to do.
std::string unkept_text(const std::string& which, double residual, double limit, std::vector<Magnitude> terms,
                        const std::string& unit);

}  // namespace thermocontact::march
