#include "solve/column_group.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <type_traits>

#include "prefetch.h"

namespace thermocontact::solve {
namespace {

using Word = std::int32_t;

constexpr std::ptrdiff_t prefetch_reach = 8192;  ///< bytes

template <typename Number>
constexpr Storage storage_of = std::is_same_v<Number, Word> ? Storage::words : Storage::doubles;

template <typename Number, int width>
constexpr auto head = static_cast<std::size_t>(head_bytes(storage_of<Number>, width));

/// What one chunk takes.
template <typename Number, int width>
constexpr std::size_t chunk_bytes = width* chunk * sizeof(Number);

/// A stored group: doubles, and then the chunks.
template <typename Number, int width>
struct Group {
    const double* triangle;
    const double* units;
    const Number* below;

    explicit Group(const std::byte* L)
        : triangle(reinterpret_cast<const double*>(L)),
          units(triangle + width * width),
          below(reinterpret_cast<const Number*>(L + head<Number, width>)) {}

    double unit(int column) const {
        if constexpr (std::is_same_v<Number, Word>) {
            return units[column];
        } else {
            return 1.0;
        }
    }
};

template <typename Number, int width>
void solve(const std::byte* L, std::int32_t rows, double* __restrict x) {
    const Group<Number, width> group(L);
    double factors[width];
    for (int c = 0; c < width; ++c) {
        x[c] *= group.triangle[c * width + c];
        for (int r = c + 1; r < width; ++r) {
            x[r] -= group.triangle[c * width + r] * x[c];
        }
        factors[c] = x[c] * group.unit(c);
    }
    const Number* __restrict below = group.below;
    const std::byte* ahead = L + prefetch_reach;
    prefetch<head<Number, width>>(ahead);
    ahead += head<Number, width>;
    for (std::int32_t r = width; r < rows;
         r += chunk, below += width * chunk, ahead += chunk_bytes<Number, width>) {
        prefetch<chunk_bytes<Number, width>>(ahead);
#pragma omp simd
        for (int i = 0; i < chunk; ++i) {
            double sum = 0;
            for (int c = 0; c < width; ++c) {
                sum += static_cast<double>(below[c * chunk + i]) * factors[c];
            }
            x[r + i] -= sum;
        }
    }
}

/// Of numbers that lie side by side, by halves: a chain of three additions, not of eight.
inline double total(double (&numbers)[chunk]) {
    for (int half = chunk / 2; half > 0; half /= 2) {
        for (int i = 0; i < half; ++i) {
            numbers[i] += numbers[half + i];
        }
    }
    return numbers[0];
}

/// From the last chunk to the first, so that a pass from group to group reads memory in one direction: what
/// is prefetched is what comes next, however large groups are.
template <typename Number, int width>
void solve_transposed(const std::byte* L, std::int32_t rows, double* __restrict x) {
    const Group<Number, width> group(L);
    double sums[width][chunk] = {};
    const std::int32_t chunks = (rows - width + chunk - 1) / chunk;
    const Number* __restrict below = group.below + std::ptrdiff_t{chunks} * width * chunk;
    const double* __restrict of_chunk = x + width + std::ptrdiff_t{chunks} * chunk;
    for (std::int32_t k = 0; k < chunks; ++k) {
        below -= width * chunk;
        of_chunk -= chunk;
        prefetch<chunk_bytes<Number, width>>(reinterpret_cast<const std::byte*>(below) - prefetch_reach);
        for (int c = 0; c < width; ++c) {
#pragma omp simd
            for (int i = 0; i < chunk; ++i) {
                sums[c][i] += static_cast<double>(below[c * chunk + i]) * of_chunk[i];
            }
        }
    }
    prefetch<head<Number, width>>(L - prefetch_reach);
    for (int c = width - 1; c >= 0; --c) {
        x[c] -= group.unit(c) * total(sums[c]);
        for (int r = c + 1; r < width; ++r) {
            x[c] -= group.triangle[c * width + r] * x[r];
        }
        x[c] *= group.triangle[c * width + c];
    }
}

/// Writes `count` numbers, the i-th at place(i).
template <typename Number, typename Place>
double store_column(const double* numbers, std::int32_t count, Number* below, Place&& place) {
    double unit = 1;
    if constexpr (std::is_same_v<Number, Word>) {
        double largest = 0;
        for (std::int32_t i = 0; i < count; ++i) {
            largest = std::max(largest, std::abs(numbers[i]));
        }
        unit = largest / std::numeric_limits<Word>::max();
    }
    for (std::int32_t i = 0; i < count; ++i) {
        if constexpr (std::is_same_v<Number, Word>) {
            below[place(i)] = unit > 0 ? static_cast<Word>(std::lrint(numbers[i] / unit)) : 0;
        } else {
            below[place(i)] = numbers[i];
        }
    }
    return unit;
}

template <typename Number, int width>
void store(const double* columns, std::int64_t leading, std::int32_t rows, std::byte* L) {
    auto* triangle = reinterpret_cast<double*>(L);
    auto* below = reinterpret_cast<Number*>(L + head<Number, width>);
    for (int c = 0; c < width; ++c) {
        const double* column = columns + c * leading;
        std::copy_n(column + c, width - c, triangle + c * width + c);
        triangle[c * width + c] = 1 / triangle[c * width + c];
        const double unit = store_column(column + width, rows - width, below, [c](std::int32_t i) {
            return (i / chunk * width + c) * chunk + i % chunk;
        });
        if constexpr (std::is_same_v<Number, Word>) {
            triangle[width * width + c] = unit;
        }
    }
}

/// Calls function.operator()<Number, width>().
template <typename Function>
void with(Storage storage, std::int32_t width, Function&& function) {
    const auto of_width = [&]<typename Number>(Number) {
        switch (width) {
            case 1:
                return function.template operator()<Number, 1>();
            case 2:
                return function.template operator()<Number, 2>();
            case 3:
                return function.template operator()<Number, 3>();
            case group:
                return function.template operator()<Number, group>();
            default:
                throw std::logic_error("columns of a group");
        }
    };
    storage == Storage::words ? of_width(Word{}) : of_width(double{});
}

}  // namespace

void store_group(Storage storage, const double* columns, std::int64_t leading, std::int32_t width,
                 std::int32_t rows, std::byte* L) {
    std::fill_n(L, group_bytes(storage, width, rows), std::byte{0});
    with(storage, width,
         [&]<typename Number, int count>() { store<Number, count>(columns, leading, rows, L); });
}

void solve_group(Storage storage, const std::byte* L, std::int32_t width, std::int32_t rows, double* x) {
    with(storage, width, [&]<typename Number, int columns>() { solve<Number, columns>(L, rows, x); });
}

void solve_group_transposed(Storage storage, const std::byte* L, std::int32_t width, std::int32_t rows,
                            double* x) {
    with(storage, width,
         [&]<typename Number, int columns>() { solve_transposed<Number, columns>(L, rows, x); });
}

}  // namespace thermocontact::solve
