#include "solve/panel_factor.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <numeric>

#include "prefetch.h"
#include "solve/cholmod.h"

namespace thermocontact::solve {
namespace {

constexpr std::int32_t group = 4;  ///< columns stored side by side; four streams suit the hardware prefetcher

/// Pivots below this share of the diagonal they come from are round-off: the matrix is singular.
constexpr double smallest_pivot = 1e-14;

void throw_if_failed(CholmodCommon& common) {
    if (common->status == CHOLMOD_OUT_OF_MEMORY || common->status == CHOLMOD_TOO_LARGE) {
        throw std::bad_alloc();
    }
}

FactorPointer analyse(const cholmod_sparse& matrix, std::vector<std::int32_t>& order, bool postorder,
                      CholmodCommon& common) {
    common->nmethods = 1;
    common->method[0].ordering = CHOLMOD_GIVEN;
    common->postorder = postorder ? 1 : 0;
    common->supernodal = CHOLMOD_SUPERNODAL;
    FactorPointer factor(
        cholmod_analyze_p(const_cast<cholmod_sparse*>(&matrix), order.data(), nullptr, 0, common.get()),
        {&common});
    throw_if_failed(common);
    return factor;
}

bool keeps_tail(const cholmod_factor& factor, std::span<const std::int32_t> order, std::int32_t tail) {
    const auto* refined = static_cast<const std::int32_t*>(factor.Perm);
    std::vector<std::int32_t> now(refined + factor.n - tail, refined + factor.n);
    std::vector<std::int32_t> wanted(order.end() - tail, order.end());
    std::ranges::sort(now);
    std::ranges::sort(wanted);
    return now == wanted;
}

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

/// One group: `width` columns of `rows` numbers, the first `width` rows being the triangle. Solves L x = x
/// and subtracts from what lies below.
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

/// The transposed counterpart of solve_group.
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

/// Numbers in a panel stored by groups.
std::int64_t stored(std::int32_t columns, std::int32_t rows) {
    std::int64_t count = 0;
    for (std::int32_t c = 0; c < columns; c += group) {
        count += static_cast<std::int64_t>(std::min(group, columns - c)) * (rows - c);
    }
    return count;
}

std::vector<double> diagonal(const SymmetricMatrix& matrix) {
    std::vector<double> result;
    for (std::size_t column = 0; column < static_cast<std::size_t>(matrix.size); ++column) {
        result.push_back(matrix.values[static_cast<std::size_t>(matrix.offsets[column])]);
    }
    return result;
}

}  // namespace

PanelFactor::PanelFactor(const SymmetricMatrix& matrix, std::span<const std::int32_t> order,
                         std::int32_t tail)
    : size_(matrix.size), head_(matrix.size - tail), tail_(Eigen::MatrixXd::Zero(tail, tail)) {
    CholmodCommon common;
    cholmod_sparse input = view(matrix);
    std::vector<std::int32_t> given(order.begin(), order.end());
    FactorPointer factor = analyse(input, given, true, common);
    if (!keeps_tail(*factor, order, tail)) {
        factor = analyse(input, given, false, common);
    }
    cholmod_factorize(&input, factor.get(), common.get());
    throw_if_failed(common);
    const auto* perm = static_cast<const std::int32_t*>(factor->Perm);
    order_.assign(perm, perm + size_);
    if (common->status == CHOLMOD_NOT_POSDEF || factor->minor < factor->n) {
        throw NotPositiveDefinite{order_[factor->minor]};
    }
    const auto* super = static_cast<const std::int32_t*>(factor->super);
    const auto* pi = static_cast<const std::int32_t*>(factor->pi);
    const auto* px = static_cast<const std::int32_t*>(factor->px);
    const auto* indices = static_cast<const std::int32_t*>(factor->s);
    const auto* numbers = static_cast<const double*>(factor->x);
    const std::vector<double> original = diagonal(matrix);
    values_.reserve(factor->xsize);
    for (std::size_t s = 0; s < factor->nsuper; ++s) {
        const std::span<const std::int32_t> rows(indices + pi[s], indices + pi[s + 1]);
        const auto leading = static_cast<std::int32_t>(rows.size());
        const double* block = numbers + px[s];
        for (std::int32_t c = 0; c < super[s + 1] - super[s]; ++c) {
            const double pivot = block[static_cast<std::ptrdiff_t>(c) * leading + c];
            const std::int32_t row = order_[static_cast<std::size_t>(super[s]) + static_cast<std::size_t>(c)];
            if (!(pivot * pivot > smallest_pivot * original[static_cast<std::size_t>(row)])) {
                throw NotPositiveDefinite{row};
            }
        }
        store(block, leading, super[s], super[s + 1] - super[s], rows);
    }
}

void PanelFactor::store(const double* supernode, std::int32_t leading, std::int32_t first,
                        std::int32_t columns, std::span<const std::int32_t> rows) {
    const auto column = [&](std::int32_t c) { return supernode + static_cast<std::ptrdiff_t>(c) * leading; };
    const std::int32_t in_head = std::clamp(head_ - first, 0, columns);
    if (in_head > 0) {
        panels_.push_back({first, in_head, leading, entries(), static_cast<std::int64_t>(rows_.size())});
        for (std::int32_t begin = 0; begin < in_head; begin += group) {
            for (std::int32_t c = begin; c < std::min(begin + group, in_head); ++c) {
                values_.insert(values_.end(), column(c) + begin, column(c) + leading);
            }
        }
        rows_.insert(rows_.end(), rows.begin() + in_head, rows.end());
        buffer_.resize(std::max(buffer_.size(), rows.size()));
    }
    for (std::int32_t c = in_head; c < columns; ++c) {
        for (std::int32_t r = c; r < leading; ++r) {
            tail_(rows[static_cast<std::size_t>(r)] - head_, first + c - head_) = column(c)[r];
        }
    }
}

void PanelFactor::forward(std::vector<double>& x) {
    for (const Panel& panel : panels_) {
        double* local = buffer_.data();
        const std::int32_t below = panel.rows - panel.columns;
        std::copy_n(x.data() + panel.first_column, panel.columns, local);
        std::fill_n(local + panel.columns, below, 0.0);
        const double* L = values_.data() + panel.values;
        for (std::int32_t c = 0; c < panel.columns; c += group) {
            const std::int32_t width = std::min(group, panel.columns - c);
            solve_group(L, width, panel.rows - c, local + c);
            L += static_cast<std::ptrdiff_t>(width) * (panel.rows - c);
        }
        std::copy_n(local, panel.columns, x.data() + panel.first_column);
        const std::int32_t* rows = rows_.data() + panel.below;
        for (std::int32_t r = 0; r < below; ++r) {
            x[static_cast<std::size_t>(rows[r])] += local[panel.columns + r];
        }
    }
}

void PanelFactor::backward(std::vector<double>& x) {
    for (std::size_t i = panels_.size(); i-- > 0;) {
        const Panel& panel = panels_[i];
        double* local = buffer_.data();
        const std::int32_t below = panel.rows - panel.columns;
        const std::int32_t* rows = rows_.data() + panel.below;
        std::copy_n(x.data() + panel.first_column, panel.columns, local);
        for (std::int32_t r = 0; r < below; ++r) {
            local[panel.columns + r] = x[static_cast<std::size_t>(rows[r])];
        }
        const double* L = values_.data() + panel.values + stored(panel.columns, panel.rows);
        for (std::int32_t c = (panel.columns - 1) / group * group; c >= 0; c -= group) {
            const std::int32_t width = std::min(group, panel.columns - c);
            L -= static_cast<std::ptrdiff_t>(width) * (panel.rows - c);
            solve_group_transposed(L, width, panel.rows - c, local + c);
        }
        std::copy_n(local, panel.columns, x.data() + panel.first_column);
    }
}

Eigen::MatrixXd PanelFactor::schur_complement() const {
    if (tail_.size() == 0) {
        return tail_;  // BLAS refuses empty products
    }
    return tail_.triangularView<Eigen::Lower>() * tail_.transpose();
}

std::vector<std::int32_t> nested_dissection(const SymmetricMatrix& graph) {
    std::vector<std::int32_t> order(static_cast<std::size_t>(graph.size));
    std::iota(order.begin(), order.end(), 0);
    CholmodCommon common;
    cholmod_sparse pattern = view(graph);
    if (graph.size > 0 && cholmod_metis(&pattern, nullptr, 0, 0, order.data(), common.get()) == 0) {
        cholmod_amd(&pattern, nullptr, 0, order.data(), common.get());
        throw_if_failed(common);
    }
    return order;
}

}  // namespace thermocontact::solve
