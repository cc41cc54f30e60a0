/// The columns of a triangular panel, four side by side without the rows above the diagonal: what a pass
/// through a factor does with one such group.
#pragma once

#include <cstdint>

namespace thermocontact::solve {

constexpr std::int32_t group = 4;  ///< columns stored side by side; four streams suit the hardware prefetcher

/// One group: `width` columns of `rows` numbers, the first `width` rows being the triangle. Solves L x = x
/// and subtracts from what lies below.
void solve_group(const double* L, std::int32_t width, std::int32_t rows, double* x);

/// The transposed counterpart of solve_group.
void solve_group_transposed(const double* L, std::int32_t width, std::int32_t rows, double* x);

}  // namespace thermocontact::solve
