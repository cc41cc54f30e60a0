/// The columns of a triangular panel, four side by side: what a pass through a factor does with such a group.
///
/// A group holds its triangle [column][row], with the reciprocals of the diagonal, and below it chunks of
/// eight rows [chunk][column][row], the last one filled up with zeros: a pass reads one chunk after the
/// other, each column of it with one aligned load, and has no remainders.
///
/// What lies below the triangle is stored as doubles or as words of 32 bits, a column's largest magnitude
/// being 2^31 - 1: half the bytes, and each number to 2^-32 of that magnitude. Single precision (24 bits)
/// would take as many bytes and be off by up to 2^-24 of each number, 250 times as much where it counts.
#pragma once

#include <cstddef>
#include <cstdint>

namespace thermocontact::solve {

constexpr std::int32_t group = 4;  ///< columns of a group; the last one of a panel may have less
constexpr std::int32_t chunk = 8;  ///< rows of a chunk: a cache line of each column

/// Below the triangle.
enum class Storage { doubles, words };

constexpr double bytes_of(Storage storage) {
    return storage == Storage::words ? sizeof(std::int32_t) : sizeof(double);
}

/// Bytes of what precedes a group's chunks, whole cache lines: the triangle and, for words, what each
/// column's are multiples of.
constexpr std::int64_t head_bytes(Storage storage, std::int32_t width) {
    constexpr std::int64_t line = 64;
    const std::int64_t numbers = width * width + (storage == Storage::words ? width : 0);
    return (numbers * static_cast<std::int64_t>(sizeof(double)) + line - 1) / line * line;
}

/// Bytes stored for `width` columns of `rows` numbers, of which the first `width` rows are the triangle:
/// whole cache lines, or halves of them.
constexpr std::int64_t group_bytes(Storage storage, std::int32_t width, std::int32_t rows) {
    const std::int64_t chunks = (rows - width + chunk - 1) / chunk;
    const std::int64_t number = storage == Storage::words ? sizeof(std::int32_t) : sizeof(double);
    return head_bytes(storage, width) + chunks * chunk * width * number;
}

/// Writes such a group; column c begins at columns + c * leading with its row 0.
void store_group(Storage storage, const double* columns, std::int64_t leading, std::int32_t width,
                 std::int32_t rows, std::byte* L);

/// Solves L x = x for the triangle and subtracts from what lies below. `x` [rows] must be followed by room
/// for another chunk, which is overwritten.
void solve_group(Storage storage, const std::byte* L, std::int32_t width, std::int32_t rows, double* x);

/// The transposed counterpart of solve_group: the chunk after `x` must hold finite numbers.
void solve_group_transposed(Storage storage, const std::byte* L, std::int32_t width, std::int32_t rows,
                            double* x);

}  // namespace thermocontact::solve
