#include "solve/column_group.h"

#include <cstddef>

#include "prefetch.h"

namespace thermocontact::solve {
namespace {

// The columns of a group are too short for the hardware prefetcher, but groups follow each other in memory.
constexpr std::ptrdiff_t chunk = 8;  ///< rows between prefetches: four columns of one cache line each
constexpr std::ptrdiff_t prefetch_reach = 8192, prefetched = 4 * chunk * sizeof(double);  ///< bytes

/// x_below -= L x for one group of columns; `rows` numbers in each column, `leading` apart.
void subtract_columns(const double* __restrict L, std::ptrdiff_t leading, std::ptrdiff_t rows,
                      const double* __restrict x, double* __restrict below) {
    const double x0 = x[0], x1 = x[1], x2 = x[2], x3 = x[3];
    const double *L1 = L + leading, *L2 = L1 + leading, *L3 = L2 + leading;
    const char* ahead = reinterpret_cast<const char*>(L) + prefetch_reach;
    std::ptrdiff_t r = 0;
    for (; r + chunk <= rows; r += chunk, ahead += prefetched) {
        prefetch<prefetched>(ahead);
#pragma omp simd
        for (std::ptrdiff_t i = r; i < r + chunk; ++i) {
            below[i] -= L[i] * x0 + L1[i] * x1 + L2[i] * x2 + L3[i] * x3;
        }
    }
    for (; r < rows; ++r) {
        below[r] -= L[r] * x0 + L1[r] * x1 + L2[r] * x2 + L3[r] * x3;
    }
}

/// x -= L^T below for one group of columns.
void subtract_products(const double* __restrict L, std::ptrdiff_t leading, std::ptrdiff_t rows,
                       const double* __restrict below, double* __restrict x) {
    const double *L1 = L + leading, *L2 = L1 + leading, *L3 = L2 + leading;
    const char* ahead = reinterpret_cast<const char*>(L) - prefetch_reach;
    double s[4][chunk] = {};
    std::ptrdiff_t r = 0;
    for (; r + chunk <= rows; r += chunk, ahead += prefetched) {
        prefetch<prefetched>(ahead);
#pragma omp simd
        for (std::ptrdiff_t i = 0; i < chunk; ++i) {
            s[0][i] += L[r + i] * below[r + i];
            s[1][i] += L1[r + i] * below[r + i];
            s[2][i] += L2[r + i] * below[r + i];
            s[3][i] += L3[r + i] * below[r + i];
        }
    }
    for (; r < rows; ++r) {
        s[0][0] += L[r] * below[r];
        s[1][0] += L1[r] * below[r];
        s[2][0] += L2[r] * below[r];
        s[3][0] += L3[r] * below[r];
    }
    for (std::ptrdiff_t c = 0; c < 4; ++c) {
        for (std::ptrdiff_t i = 0; i < chunk; ++i) {
            x[c] -= s[c][i];
        }
    }
}

}  // namespace

void solve_group(const double* L, std::int32_t width, std::int32_t rows, double* x) {
    const std::ptrdiff_t leading = rows;
    for (std::int32_t c = 0; c < width; ++c) {
        x[c] /= L[c * leading + c];
        for (std::int32_t r = c + 1; r < width; ++r) {
            x[r] -= L[c * leading + r] * x[c];
        }
    }
    if (width == group) {
        subtract_columns(L + group, leading, rows - group, x, x + group);
        return;
    }
    for (std::int32_t c = 0; c < width; ++c) {
        for (std::int32_t r = width; r < rows; ++r) {
            x[r] -= L[c * leading + r] * x[c];
        }
    }
}

void solve_group_transposed(const double* L, std::int32_t width, std::int32_t rows, double* x) {
    const std::ptrdiff_t leading = rows;
    if (width == group) {
        subtract_products(L + group, leading, rows - group, x + group, x);
    } else {
        for (std::int32_t c = 0; c < width; ++c) {
            for (std::int32_t r = width; r < rows; ++r) {
                x[c] -= L[c * leading + r] * x[r];
            }
        }
    }
    for (std::int32_t c = width - 1; c >= 0; --c) {
        for (std::int32_t r = c + 1; r < width; ++r) {
            x[c] -= L[c * leading + r] * x[r];
        }
        x[c] /= L[c * leading + c];
    }
}

}  // namespace thermocontact::solve
