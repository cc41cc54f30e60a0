/// What Newton's method does alike in every strategy: the line search, and when round-off excuses a residual.
#pragma once

namespace thermocontact::solve {

inline constexpr double most_round_off = 1000;  ///< tolerances that round-off may take, never more

/// Halves the length of the step, from 1, until `attempt(length)`, the norm of the residual there, is lower
/// than `norm` as Armijo asks. False if no length is short enough; else the last one tried is to be taken.
template <typename Attempt>
bool line_search(double norm, Attempt&& attempt) {
    constexpr int lengths = 20;
    constexpr double sufficient_decrease = 1e-4;  // Armijo's constant
    double length = 1.0;
    for (int i = 0; i < lengths; ++i, length /= 2) {
        if (attempt(length) <= (1 - sufficient_decrease * length) * norm) {
            return true;
        }
    }
    return false;
}

}  // namespace thermocontact::solve
