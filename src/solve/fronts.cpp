#include "solve/fronts.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace thermocontact::solve {
namespace {

using Dense = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

/// Pivots below this share of the diagonal they come from are round-off: the matrix is singular.
constexpr double smallest_pivot = 1e-14;

constexpr Eigen::Index block = 32;  ///< columns eliminated by themselves, before BLAS takes what follows
constexpr Eigen::Index tile = 128;  ///< rows below, which are one task

Dense dense(double* numbers, Eigen::Index rows, Eigen::Index columns, Eigen::Index leading) {
    return {numbers, rows, columns, Eigen::OuterStride<>(leading)};
}

/// L L^T = the lower triangle of A, in place. Returns the first column without a pivot, or -1.
Eigen::Index factor_block(Dense A, const double* diagonal) {
    const Eigen::Index n = A.rows();
    for (Eigen::Index k = 0; k < n; ++k) {
        double* column = &A(0, k);
        if (!(column[k] > smallest_pivot * diagonal[k]) || !std::isfinite(column[k])) {
            return k;
        }
        const double pivot = std::sqrt(column[k]);
        column[k] = pivot;
        for (Eigen::Index i = k + 1; i < n; ++i) {
            column[i] /= pivot;
        }
        for (Eigen::Index j = k + 1; j < n; ++j) {
            double* __restrict other = &A(0, j);
            const double factor = column[j];
            for (Eigen::Index i = j; i < n; ++i) {
                other[i] -= factor * column[i];
            }
        }
    }
    return -1;
}

/// rows := rows L^-T.
void solve_rows(const Dense& L, Dense rows) {
    L.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(rows);
}

/// The same of a triangle of any size.
Eigen::Index factor_triangle(Dense A, const double* diagonal) {
    const Eigen::Index n = A.rows(), leading = A.outerStride();
    for (Eigen::Index k = 0; k < n; k += block) {
        const Eigen::Index width = std::min(block, n - k), rest = n - k - width;
        const Dense L = dense(&A(k, k), width, width, leading);
        if (const Eigen::Index failed = factor_block(L, diagonal + k); failed >= 0) {
            return k + failed;
        }
        if (rest > 0) {
            const Dense below = dense(&A(k + width, k), rest, width, leading);
            solve_rows(L, below);
            dense(&A(k + width, k + width), rest, rest, leading)
                .selfadjointView<Eigen::Lower>()
                .rankUpdate(below, -1.0);
        }
    }
    return -1;
}

/// Calls work(begin, rows) for tiles of `count` rows, the last ones first: they have the most to do.
template <typename Work>
void by_tiles(Eigen::Index count, const fem::Beside& beside, Work&& work) {
    const auto tiles = static_cast<int>((count + tile - 1) / tile);
    beside(tiles, [&](int task) {
        const Eigen::Index begin = (tiles - 1 - task) * tile;
        work(begin, std::min(tile, count - begin));
    });
}

/// The lower triangle of update -= below below^T, rows [begin, begin + rows).
void subtract_products(const Dense& below, Eigen::Index begin, Eigen::Index rows, Dense update) {
    const auto of_tile = below.middleRows(begin, rows);
    if (begin > 0) {
        update.block(begin, 0, rows, begin).noalias() -= of_tile * below.topRows(begin).transpose();
    }
    update.block(begin, begin, rows, rows).selfadjointView<Eigen::Lower>().rankUpdate(of_tile, -1.0);
}

}  // namespace

Fronts::Fronts(const SymmetricMatrix& matrix, const Supernodes& supernodes)
    : matrix_(&matrix),
      supernodes_(&supernodes),
      place_(static_cast<std::size_t>(matrix.size)),
      children_(supernodes.count()),
      updates_(supernodes.count()) {
    std::vector<std::size_t> owner(place_.size());
    for (std::size_t i = 0; i < place_.size(); ++i) {
        place_[static_cast<std::size_t>(supernodes.order()[i])] = static_cast<std::int32_t>(i);
    }
    for (std::size_t s = 0; s < supernodes.count(); ++s) {
        std::fill_n(owner.begin() + supernodes[s].first, supernodes[s].columns, s);
    }
    for (std::size_t s = 0; s < supernodes.count(); ++s) {
        if (const auto below = supernodes[s].below(); !below.empty()) {
            children_[owner[static_cast<std::size_t>(below.front())]].push_back(s);
        }
    }
}

void Fronts::add_matrix(const Supernode& supernode, Workspace& work) const {
    double* column = work.panel.data();
    for (std::int32_t c = 0; c < supernode.columns; ++c, column += supernode.rows.size()) {
        const std::int32_t own = supernodes_->order()[static_cast<std::size_t>(supernode.first + c)];
        for (std::int32_t i = matrix_->offsets[static_cast<std::size_t>(own)];
             i < matrix_->offsets[static_cast<std::size_t>(own) + 1]; ++i) {
            const std::int32_t row = matrix_->rows[static_cast<std::size_t>(i)];
            const double value = matrix_->values[static_cast<std::size_t>(i)];
            column[work.local[static_cast<std::size_t>(place_[static_cast<std::size_t>(row)])]] += value;
            if (row == own) {
                work.diagonal[static_cast<std::size_t>(c)] = value;
            }
        }
    }
}

void Fronts::add_update(std::size_t child, const Supernode& supernode, const Workspace& work, double* panel,
                        double* update) const {
    const auto below = (*supernodes_)[child].below();
    const auto rows = static_cast<std::ptrdiff_t>(supernode.rows.size());
    std::vector<std::int32_t> places(below.size());
    std::ranges::transform(below, places.begin(),
                           [&](std::int32_t row) { return work.local[static_cast<std::size_t>(row)]; });
    const double* from = updates_[child].data();
    for (std::size_t c = 0; c < places.size(); ++c, from += places.size()) {
        const std::ptrdiff_t column = places[c], columns = supernode.columns;
        double* to = column < columns ? panel + column * rows
                                      : update + (column - columns) * (rows - columns) - columns;
        for (std::size_t r = c; r < places.size(); ++r) {
            to[places[r]] += from[r];
        }
    }
}

void Fronts::assemble(std::size_t number, Workspace& work) {
    const Supernode supernode = (*supernodes_)[number];
    const std::size_t rows = supernode.rows.size(), columns = static_cast<std::size_t>(supernode.columns);
    work.local.resize(place_.size());
    for (std::size_t r = 0; r < rows; ++r) {
        work.local[static_cast<std::size_t>(supernode.rows[r])] = static_cast<std::int32_t>(r);
    }
    work.panel.assign(rows * columns, 0.0);
    work.diagonal.assign(columns, 0.0);
    updates_[number].assign((rows - columns) * (rows - columns), 0.0);
    add_matrix(supernode, work);
    for (const std::size_t child : children_[number]) {
        add_update(child, supernode, work, work.panel.data(), updates_[number].data());
        std::vector<double>().swap(updates_[child]);
    }
}

const double* Fronts::factor(std::size_t number, Workspace& work, const fem::Beside& beside) {
    assemble(number, work);
    const Supernode supernode = (*supernodes_)[number];
    const auto rows = static_cast<Eigen::Index>(supernode.rows.size()),
               columns = Eigen::Index{supernode.columns};
    const Dense L = dense(work.panel.data(), columns, columns, rows);
    if (const Eigen::Index failed = factor_triangle(L, work.diagonal.data()); failed >= 0) {
        throw NotPositiveDefinite{supernodes_->order()[static_cast<std::size_t>(supernode.first + failed)]};
    }
    if (const Eigen::Index count = rows - columns; count > 0) {
        const Dense below = dense(work.panel.data() + columns, count, columns, rows);
        const Dense update = dense(updates_[number].data(), count, count, count);
        by_tiles(count, beside, [&](Eigen::Index begin, Eigen::Index height) {
            solve_rows(L, dense(work.panel.data() + columns + begin, height, columns, rows));
        });
        by_tiles(count, beside, [&](Eigen::Index begin, Eigen::Index height) {
            subtract_products(below, begin, height, update);
        });
    }
    return work.panel.data();
}

}  // namespace thermocontact::solve
