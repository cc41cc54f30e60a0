#include "multigrid/hierarchy.h"

#include <algorithm>

#include "multigrid/aggregation.h"
#include "multigrid/blocks.h"
#include "multigrid/coarse_scaling.h"
#include "multigrid/galerkin.h"

namespace thermocontact::multigrid {
namespace {

constexpr std::int64_t few = 700;        ///< unknowns of a level that is solved
constexpr std::int64_t solvable = 1500;  ///< and of one that cannot be coarsened
constexpr double least_coarsening = 0.8;

std::int64_t unknowns(const Level& level) {
    return std::int64_t{level.nodes().numbers().total()} * level.matrix().size;
}

/// Nodes with a motion that is not zero.
std::vector<char> movable(const NearNullSpace& motions, std::size_t nodes) {
    std::vector<char> result(nodes, 0);
    for (std::size_t node = 0; node < nodes; ++node) {
        const auto length = static_cast<std::ptrdiff_t>(motions.values.size() / nodes);
        const auto first = motions.values.begin() + static_cast<std::ptrdiff_t>(node) * length;
        result[node] = std::any_of(first, first + length, [](double value) { return value != 0; }) ? 1 : 0;
    }
    return result;
}

/// The motions at all coarse nodes of the process, those of others zero: they aggregate their own.
NearNullSpace at_all_nodes(NearNullSpace motions, std::size_t nodes) {
    const auto n = static_cast<std::size_t>(motions.motions);
    motions.values.resize(nodes * n * n, 0.0);
    return motions;
}

}  // namespace

Hierarchy::Hierarchy(Matrix fine, SharedNodes nodes, NearNullSpace motions) {
    levels_.push_back(std::make_unique<Level>(std::move(fine), std::move(nodes)));
    while (unknowns(*levels_.back()) > few) {
        Level& level = *levels_.back();
        const Aggregates aggregates =
            aggregate(level.matrix(), movable(motions, level.nodes().node_count()), level.nodes());
        Coarsening coarse = coarsen(level.matrix(), level.largest(), aggregates, motions, level.nodes());
        const std::int32_t total = coarse.numbers.total();
        if (total == 0 || total > least_coarsening * level.nodes().numbers().total()) {
            break;
        }
        const std::size_t count = coarse.numbers.global.size();
        const SharedNodes shared(std::move(coarse.numbers), level.nodes().team());
        Matrix matrix = galerkin(level.matrix(), coarse.prolongation, count);
        motions = at_all_nodes(std::move(coarse.motions), count);
        scale_coarse(matrix, coarse.prolongation, motions, shared);
        level.prolongation = std::move(coarse.prolongation);
        levels_.push_back(std::make_unique<Level>(std::move(matrix), shared));
    }
    factor_coarsest();
}

void Hierarchy::factor_coarsest() {
    const Level& level = *levels_.back();
    dense_ = unknowns(level) <= solvable;
    if (!dense_) {
        return;
    }
    const Matrix& A = level.matrix();
    const int size = A.size, stride = lanes(size);
    const auto n = static_cast<Eigen::Index>(unknowns(level));
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
    const std::vector<std::int32_t>& global = level.nodes().numbers().global;
    for (std::size_t i = 0; i + 1 < A.offsets.size(); ++i) {
        const auto first = static_cast<std::size_t>(A.offsets[i]);
        for (auto pair = first; pair < static_cast<std::size_t>(A.offsets[i + 1]); ++pair) {
            const Eigen::Index row = Eigen::Index{global[i]} * size;
            const Eigen::Index column =
                Eigen::Index{global[static_cast<std::size_t>(A.columns[pair])]} * size;
            for (int r = 0; r < size; ++r) {
                for (int c = 0; c < size; ++c) {
                    const double value = A.block(pair)[c * stride + r];
                    dense(row + r, column + c) += value;
                    if (pair != first) {
                        dense(column + c, row + r) += value;
                    }
                }
            }
        }
    }
    level.nodes().team().sum(std::span(dense.data(), static_cast<std::size_t>(dense.size())));
    for (Eigen::Index k = 0; k < n; ++k) {  // 1, but for fixed dofs and lacking motions
        dense(k, k) += dense(k, k) < 0.5 ? 1.0 : 0.0;
    }
    coarsest_.compute(dense);
}

void Hierarchy::solve_coarsest() {
    Level& level = *levels_.back();
    const int size = level.matrix().size, stride = lanes(size);
    const SharedNodes& nodes = level.nodes();
    Eigen::VectorXd dense = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(unknowns(level)));
    const auto visit = [&](auto&& at) {
        for (std::size_t node = 0; node < nodes.node_count(); ++node) {
            const Eigen::Index first = Eigen::Index{nodes.numbers().global[node]} * size;
            for (int c = 0; c < size; ++c) {
                at(node, dense[first + c],
                   node * static_cast<std::size_t>(stride) + static_cast<std::size_t>(c));
            }
        }
    };
    visit([&](std::size_t node, double& value, std::size_t place) {
        if (nodes.owned(node)) {
            value = level.b[place];
        }
    });
    nodes.team().sum(std::span(dense.data(), static_cast<std::size_t>(dense.size())));
    dense = coarsest_.solve(dense);
    visit([&](std::size_t, double& value, std::size_t place) { level.x[place] = static_cast<float>(value); });
}

void Hierarchy::cycle(std::size_t number) {
    Level& level = *levels_[number];
    if (number + 1 == levels_.size() && dense_) {
        solve_coarsest();
        return;
    }
    level.smooth_from_zero();
    if (level.prolongation) {
        Level& coarse = *levels_[number + 1];
        level.prolongation->restrict_to(level.residual, level.nodes(), coarse.b);
        coarse.nodes().add_up(coarse.b, static_cast<std::size_t>(lanes(coarse.matrix().size)));
        cycle(number + 1);
        level.prolongation->add_to(coarse.x, level.x);
    }
    level.smooth();
}

}  // namespace thermocontact::multigrid
