#include "solve/column_group.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

#include "prefetch.h"

namespace thermocontact::solve {
namespace {

constexpr std::ptrdiff_t prefetch_reach = 8192;  ///< bytes

/// Numbers that the triangle takes: whole cache lines.
constexpr std::int64_t triangle(std::int32_t width) {
    return (width * width + chunk - 1) / chunk * chunk;
}

/// What one chunk takes, bytes.
template <int width>
constexpr std::size_t chunk_bytes = width* chunk * sizeof(double);

template <int width>
void solve(const double* __restrict L, std::int32_t rows, double* __restrict x) {
    for (int c = 0; c < width; ++c) {
        x[c] *= L[c * width + c];
        for (int r = c + 1; r < width; ++r) {
            x[r] -= L[c * width + r] * x[c];
        }
    }
    double pivots[width];
    std::copy_n(x, width, pivots);
    const double* below = L + triangle(width);
    const char* ahead = reinterpret_cast<const char*>(L) + prefetch_reach;
    for (std::int32_t r = width; r < rows; r += chunk, below += width * chunk, ahead += chunk_bytes<width>) {
        prefetch<chunk_bytes<width>>(ahead);
#pragma omp simd
        for (int i = 0; i < chunk; ++i) {
            double sum = 0;
            for (int c = 0; c < width; ++c) {
                sum += below[c * chunk + i] * pivots[c];
            }
            x[r + i] -= sum;
        }
    }
}

template <int width>
void solve_transposed(const double* __restrict L, std::int32_t rows, double* __restrict x) {
    double sums[width][chunk] = {};
    const double* below = L + triangle(width);
    const char* ahead = reinterpret_cast<const char*>(L) - prefetch_reach;
    for (std::int32_t r = width; r < rows; r += chunk, below += width * chunk, ahead += chunk_bytes<width>) {
        prefetch<chunk_bytes<width>>(ahead);
        for (int c = 0; c < width; ++c) {
#pragma omp simd
            for (int i = 0; i < chunk; ++i) {
                sums[c][i] += below[c * chunk + i] * x[r + i];
            }
        }
    }
    for (int c = width - 1; c >= 0; --c) {
        for (int i = 0; i < chunk; ++i) {
            x[c] -= sums[c][i];
        }
        for (int r = c + 1; r < width; ++r) {
            x[c] -= L[c * width + r] * x[r];
        }
        x[c] *= L[c * width + c];
    }
}

/// Calls function.operator()<width>().
template <typename Function>
void with_width(std::int32_t width, Function&& function) {
    switch (width) {
        case 1:
            return function.template operator()<1>();
        case 2:
            return function.template operator()<2>();
        case 3:
            return function.template operator()<3>();
        case group:
            return function.template operator()<group>();
        default:
            throw std::logic_error("columns of a group");
    }
}

}  // namespace

std::int64_t group_size(std::int32_t width, std::int32_t rows) {
    const std::int64_t chunks = (rows - width + chunk - 1) / chunk;
    return triangle(width) + chunks * chunk * width;
}

void store_group(const double* columns, std::int64_t leading, std::int32_t width, std::int32_t rows,
                 double* L) {
    std::fill_n(L, group_size(width, rows), 0.0);
    double* below = L + triangle(width);
    for (std::int32_t c = 0; c < width; ++c) {
        const double* column = columns + c * leading;
        std::copy_n(column + c, width - c, L + c * width + c);
        L[c * width + c] = 1 / L[c * width + c];
        for (std::int32_t r = width; r < rows; ++r) {
            const std::int32_t i = r - width;
            below[(i / chunk * width + c) * chunk + i % chunk] = column[r];
        }
    }
}

void solve_group(const double* L, std::int32_t width, std::int32_t rows, double* x) {
    with_width(width, [&]<int columns>() { solve<columns>(L, rows, x); });
}

void solve_group_transposed(const double* L, std::int32_t width, std::int32_t rows, double* x) {
    with_width(width, [&]<int columns>() { solve_transposed<columns>(L, rows, x); });
}

}  // namespace thermocontact::solve
