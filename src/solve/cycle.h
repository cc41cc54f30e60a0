/// Whether a Newton iteration goes round in circles: through contact states (open and closed, stick and slip)
/// that it has been in before.
///
/// A state determines the next step, so that an iteration which returns to one never ends. The states lie in
/// kernels that only evaluate forces; the three norms that the residual is made of, |R|, |A x| and |F(x)|,
/// tell them apart as well, cost nothing, and are the same on all processes. Steps that the line search takes
/// for the norm lower it by 1e-10 at least (Armijo's constant times the shortest length); one that returns
/// has been taken for the work (line_search.h), which is no energy where there is friction.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace thermocontact::solve {

class CycleDetector {
  public:
    static constexpr std::size_t longest = 12;  ///< iterations in a round

    /// |R|, |A x|, |F(x)|.
    using Norms = std::array<double, 3>;

    /// Takes those of the next iterate; whether the last round of iterations repeated the one before: each
    /// norm changed by a thousandth of what it changes by within the round, or by round-off.
    bool returns(const Norms& norms) {
        seen_.push_back(norms);
        for (std::size_t period = 1; period <= longest && 2 * period <= seen_.size(); ++period) {
            if (repeats(period)) {
                return true;
            }
        }
        return false;
    }

  private:
    bool repeats(std::size_t period) const {
        constexpr double share = 1e-3, round_off = 8 * std::numeric_limits<double>::epsilon();
        const auto last = seen_.end() - static_cast<std::ptrdiff_t>(period);
        const auto before = last - static_cast<std::ptrdiff_t>(period);
        for (std::size_t k = 0; k < Norms{}.size(); ++k) {
            const auto [least, most] = std::minmax_element(
                last, seen_.end(), [k](const Norms& a, const Norms& b) { return a[k] < b[k]; });
            const double allowed = std::max(share * ((*most)[k] - (*least)[k]), round_off * (*most)[k]);
            for (std::size_t i = 0; i < period; ++i) {
                const auto at = static_cast<std::ptrdiff_t>(i);
                if (!(std::abs(last[at][k] - before[at][k]) <= allowed)) {
                    return false;
                }
            }
        }
        return true;
    }

    std::vector<Norms> seen_;
};

}  // namespace thermocontact::solve
