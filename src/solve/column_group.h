/// The columns of a triangular panel, four side by side: what a pass through a factor does with such a group.
///
/// A group holds its triangle [column][row], with the reciprocals of the diagonal, and below it chunks of
/// eight rows [chunk][column][row], the last one filled up with zeros: a pass reads one chunk after the
/// other, each column of it with one aligned load, and has no remainders.
#pragma once

#include <cstdint>

namespace thermocontact::solve {

constexpr std::int32_t group = 4;  ///< columns of a group; the last one of a panel may have less
constexpr std::int32_t chunk = 8;  ///< rows of a chunk: a cache line of each column

/// Numbers stored for `width` columns of `rows` numbers, of which the first `width` rows are the triangle.
std::int64_t group_size(std::int32_t width, std::int32_t rows);

/// Writes such a group; column c begins at columns + c * leading with its row 0.
void store_group(const double* columns, std::int64_t leading, std::int32_t width, std::int32_t rows,
                 double* L);

/// Solves L x = x for the triangle and subtracts from what lies below. `x` [rows] must be followed by room
/// for another chunk, which is overwritten.
void solve_group(const double* L, std::int32_t width, std::int32_t rows, double* x);

/// The transposed counterpart of solve_group: the chunk after `x` must hold finite numbers.
void solve_group_transposed(const double* L, std::int32_t width, std::int32_t rows, double* x);

}  // namespace thermocontact::solve
