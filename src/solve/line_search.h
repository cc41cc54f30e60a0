/// What Newton's method does alike in every strategy: the line search, and when round-off excuses a residual.
#pragma once

#include <cmath>

namespace thermocontact::solve {

/// Whether a residual may be round-off at all: it is at most 1e3 tolerances, `relative` to its terms, or 1e4
/// of the contact forces (heat flows), in sums of magnitudes. The force and heat audits are at most the
/// latter quotient, as contact is among the terms they are relative to: with the default tolerance of 1e-12
/// the 1e-8 that is asked of them.
inline bool may_be_round_off(double relative, double magnitude, double contact_magnitude, double tolerance) {
    constexpr double of_terms = 1e3, of_contact = 1e4;
    return relative <= of_terms * tolerance || magnitude <= of_contact * tolerance * contact_magnitude;
}

/// The residual R at x + length d: its norm, and the work d . R.
struct LineResidual {
    double norm, work;
};

namespace line {

/// The first length of 1, 1/2, 1/4, ... at which the norm of the residual is lower as Armijo asks.
template <typename Attempt>
bool lower_norm(double norm, Attempt&& attempt) {
    constexpr int lengths = 20;
    constexpr double sufficient_decrease = 1e-4;  // Armijo's constant
    double length = 1.0;
    for (int i = 0; i < lengths; ++i, length /= 2) {
        if (attempt(length).norm <= (1 - sufficient_decrease * length) * norm) {
            return true;
        }
    }
    return false;
}

/// A length in (0, 1] at which the work has fallen to a tenth, or is not yet used up at 1: regula falsi on
/// the work, Illinois variant.
template <typename Attempt>
bool little_work(double work, Attempt&& attempt) {
    constexpr int lengths = 60;
    constexpr double remainder = 0.1;
    double low = 0, low_work = work, high = 1, high_work = attempt(high).work;
    const auto enough = [&](double left) { return std::abs(left) <= remainder * std::abs(work); };
    if (!(low_work < 0) || !std::isfinite(high_work)) {
        return false;
    }
    if (high_work <= 0 || enough(high_work)) {
        return true;
    }
    int side = 0;
    for (int i = 0; i < lengths; ++i) {
        const double length = (low * high_work - high * low_work) / (high_work - low_work);
        const double left = attempt(length).work;
        if (enough(left)) {
            return true;
        }
        if (left < 0) {
            low = length, low_work = left;
            high_work *= side == -1 ? 0.5 : 1.0;
            side = -1;
        } else {
            high = length, high_work = left;
            low_work *= side == 1 ? 0.5 : 1.0;
            side = 1;
        }
    }
    return false;
}

}  // namespace line

/// Seeks a length for Newton's step; `attempt(length)` evaluates the residual there, `start` is that at
/// length 0. First the norm of the residual is to fall. Where it does not, and round-off does not excuse the
/// start, the work of the residual along the step is to vanish: at the kinks of the contact laws Newton's
/// direction need not lower the norm however short the step, but for frictionless contact and for heat the
/// work vanishes at the minimum of a convex energy. False if neither is found; else the last length tried is
/// to be taken.
template <typename Excused, typename Attempt>
bool line_search(const LineResidual& start, Excused&& is_round_off, Attempt&& attempt) {
    return line::lower_norm(start.norm, attempt) ||
           (!is_round_off() && line::little_work(start.work, attempt));
}

}  // namespace thermocontact::solve
