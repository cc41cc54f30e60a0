#include "solve/fronts.h"

#include <Eigen/Core>
#include <algorithm>
#include <atomic>
#include <cmath>

namespace thermocontact::solve {
namespace {

using Dense = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

/// Pivots below this share of the diagonal they come from are round-off: the matrix is singular.
constexpr double smallest_pivot = 1e-14;

constexpr Eigen::Index block = 32;  ///< columns eliminated by themselves, before BLAS takes what follows
constexpr Eigen::Index tile = 128;  ///< rows below, which are one task

/// Rows and columns, and the numbers from one column to the next.
Dense dense(double* numbers, Eigen::Index height, Eigen::Index width, Eigen::Index leading) {
    return {numbers, height, width, Eigen::OuterStride<>(leading)};
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
void solve_rows(const Dense& L, const Dense& rows) {
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

Fronts::Fronts(const FrontTree& tree, std::span<const std::int32_t> first)
    : tree_(&tree), first_(first), uses_(first.size(), 0), updates_(first.size()) {
    for (std::size_t s = 0; s < first.size(); ++s) {
        if (static_cast<std::size_t>(first[s]) == s) {
            for (const std::int32_t child : tree.children(s)) {
                ++uses_[static_cast<std::size_t>(first[static_cast<std::size_t>(child)])];
            }
        }
    }
}

void Fronts::add_matrix(std::size_t number, Workspace& work) const {
    const auto rows = static_cast<std::ptrdiff_t>(tree_->supernodes()[number].rows.size());
    tree_->each_entry(number, work.local, [&](std::int32_t column, std::int32_t place, double value) {
        work.panel[static_cast<std::size_t>(column * rows + place)] += value;
        if (place == column) {
            work.diagonal[static_cast<std::size_t>(column)] = value;
        }
    });
}

void Fronts::add_update(std::size_t child, const Supernode& supernode, Workspace& work,
                        double* update) const {
    tree_->places(child, work.local, work.places);
    const auto rows = static_cast<std::ptrdiff_t>(supernode.rows.size());
    const double* from = updates_[static_cast<std::size_t>(first_[child])].data();
    const std::ptrdiff_t columns = supernode.columns;
    for (std::size_t c = 0; c < work.places.size(); ++c, from += work.places.size()) {
        for (std::size_t r = c; r < work.places.size(); ++r) {
            const auto [column, row] = std::minmax<std::ptrdiff_t>({work.places[c], work.places[r]});
            double* to = column < columns ? work.panel.data() + column * rows
                                          : update + (column - columns) * (rows - columns) - columns;
            to[row] += from[r];
        }
    }
}

/// Fronts that run beside each other may have equal children.
void Fronts::release(std::size_t child) {
    const auto made = static_cast<std::size_t>(first_[child]);
    if (std::atomic_ref(uses_[made]).fetch_sub(1) == 1) {
        std::vector<double>().swap(updates_[made]);
    }
}

void Fronts::assemble(std::size_t number, Workspace& work) {
    const Supernode supernode = tree_->supernodes()[number];
    const std::size_t rows = supernode.rows.size(), columns = static_cast<std::size_t>(supernode.columns);
    tree_->locate(number, work.local);
    work.panel.assign(rows * columns, 0.0);
    work.diagonal.assign(columns, 0.0);
    updates_[number].assign((rows - columns) * (rows - columns), 0.0);
    add_matrix(number, work);
    for (const std::int32_t child : tree_->children(number)) {
        add_update(static_cast<std::size_t>(child), supernode, work, updates_[number].data());
        release(static_cast<std::size_t>(child));
    }
}

const double* Fronts::factor(std::size_t number, Workspace& work, const fem::Beside& beside) {
    assemble(number, work);
    const Supernodes& supernodes = tree_->supernodes();
    const Supernode supernode = supernodes[number];
    const auto rows = static_cast<Eigen::Index>(supernode.rows.size()),
               columns = Eigen::Index{supernode.columns};
    const Dense L = dense(work.panel.data(), columns, columns, rows);
    if (const Eigen::Index failed = factor_triangle(L, work.diagonal.data()); failed >= 0) {
        throw NotPositiveDefinite{supernodes.order()[static_cast<std::size_t>(supernode.first + failed)]};
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
