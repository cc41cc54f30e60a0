#include "solve/equal_fronts.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "solve/front_stages.h"
#include "solve/grid_dissection.h"
#include "solve/panel_factor.h"
#include "support/dense.h"
#include "support/laplacian.h"
#include "support/permuted.h"

namespace thermocontact::solve {
namespace {

/// Five-point differences on n x n nodes, shifted to be regular, in the order of a dissection along grid
/// lines.
SymmetricMatrix grid(std::int32_t n) {
    std::vector<mesh::GridPlace> places;
    std::vector<std::int32_t> nodes;
    for (std::int32_t i = 0; i < n * n; ++i) {
        places.push_back({2 * (i % n), 2 * (i / n), 0});
        nodes.push_back(i);
    }
    return support::permuted(support::laplacian(n, 4.1), grid_dissection(places, nodes));
}

/// A tree of fronts and what it refers to.
struct Tree {
    SymmetricMatrix matrix;
    Supernodes supernodes;
    FrontTree tree;

    explicit Tree(const SymmetricMatrix& of, std::int32_t tail = 0)
        : matrix(of), supernodes(matrix, tail), tree(matrix, supernodes) {}
    std::vector<std::int32_t> equal(std::int32_t tail = 0) const {
        return equal_fronts(tree, matrix.size - tail);
    }
};

std::size_t count_first(const std::vector<std::int32_t>& first) {
    std::size_t count = 0;
    for (std::size_t s = 0; s < first.size(); ++s) {
        count += static_cast<std::size_t>(first[s]) == s ? 1 : 0;
    }
    return count;
}

/// Twice as many nodes along each side add parts of two sizes, squares and halves, each of nine kinds by the
/// sides that the grid ends at; a part's nodes are one supernode or two.
TEST(EqualFronts, DifferOnAGridByTheSizeAndSidesOfTheirPart) {
    const std::size_t at_31 = count_first(Tree(grid(31)).equal()),
                      at_63 = count_first(Tree(grid(63)).equal()), all = Tree(grid(63)).supernodes.count();
    EXPECT_LE(at_63, at_31 + 2 * 2 * 9);
    EXPECT_GT(all, 3 * at_63);
}

/// What differs by more than round-off is not taken for equal, nor is what is made from it; all else is.
TEST(EqualFronts, OneEntryMakesAFrontAndItsAncestorsDiffer) {
    const Tree before(grid(31));
    const std::vector<std::int32_t> same = before.equal();
    std::vector<int> equals(same.size(), 0);
    for (const std::int32_t s : same) {
        ++equals[static_cast<std::size_t>(s)];
    }
    const auto chosen = static_cast<std::size_t>(std::ranges::max_element(equals) - equals.begin());
    ASSERT_GT(equals[chosen], 10);
    const auto last = static_cast<std::size_t>(
        same.rend() - std::find(same.rbegin(), same.rend(), static_cast<std::int32_t>(chosen)) - 1);
    const auto changed_by = [&](double share) {
        SymmetricMatrix changed = before.matrix;
        const auto column = static_cast<std::size_t>(
            before.supernodes.order()[static_cast<std::size_t>(before.supernodes[last].first)]);
        const auto diagonal = std::find(changed.rows.begin() + changed.offsets[column], changed.rows.end(),
                                        static_cast<std::int32_t>(column));
        changed.values[static_cast<std::size_t>(diagonal - changed.rows.begin())] *= 1 + share;
        return Tree(changed).equal();
    };
    EXPECT_EQ(changed_by(0.9 * equal_entries), same);
    const std::vector<std::int32_t> now = changed_by(1.1 * equal_entries);
    ASSERT_EQ(now.size(), same.size());
    std::vector<char> above(same.size(), 0);
    above[last] = 1;
    for (std::size_t s = 0; s < same.size(); ++s) {
        for (const std::int32_t child : before.tree.children(s)) {
            above[s] |= above[static_cast<std::size_t>(child)];
        }
        EXPECT_EQ(now[s], above[s] != 0 ? static_cast<std::int32_t>(s) : same[s]) << s;
    }
}

/// Rows of the tail are stored by their place: columns there are not shared.
TEST(EqualFronts, ColumnsOfTheTailStayApart) {
    const std::int32_t tail = 200;
    const Tree tree(grid(31), tail);
    const std::vector<std::int32_t> first = tree.equal(tail);
    for (std::size_t s = 0; s < first.size(); ++s) {
        if (tree.supernodes[s].first + tree.supernodes[s].columns > tree.matrix.size - tail) {
            EXPECT_EQ(first[s], static_cast<std::int32_t>(s));
        }
    }
}

/// Cut anywhere, each first front is made once, and what it needs before.
TEST(FrontStages, MakeEachFrontOnceAndItsChildrenBefore) {
    const Tree tree(grid(31));
    const std::vector<std::int32_t> first = tree.equal();
    std::vector<std::int32_t> parents(first.size(), -1);
    std::vector<std::int64_t> weights;
    for (std::size_t s = 0; s < first.size(); ++s) {
        weights.push_back(tree.supernodes[s].columns);
        for (const std::int32_t child : tree.tree.children(s)) {
            parents[static_cast<std::size_t>(child)] = static_cast<std::int32_t>(s);
        }
    }
    for (const int count : {1, 2, 3, 4, 7}) {
        const FrontStages stages = front_stages(tree.tree, first, cut_into_branches(parents, weights, count));
        EXPECT_EQ(stages.common.empty(), count == 1);
        std::vector<int> made(first.size(), -1);  // when, or -1
        const auto make = [&](const std::vector<std::int32_t>& list, const std::vector<int>& known) {
            for (const std::int32_t s : list) {
                ASSERT_EQ(first[static_cast<std::size_t>(s)], s);
                ASSERT_EQ(made[static_cast<std::size_t>(s)], -1);
                for (const std::int32_t child : tree.tree.children(static_cast<std::size_t>(s))) {
                    const auto needed = static_cast<std::size_t>(first[static_cast<std::size_t>(child)]);
                    EXPECT_TRUE(known[needed] >= 0 ||
                                std::ranges::find(list, needed) < std::ranges::find(list, s));
                }
                made[static_cast<std::size_t>(s)] = 1;
            }
        };
        make(stages.common, made);
        const std::vector<int> common = made;
        for (const std::vector<std::int32_t>& branch : stages.branches) {
            make(branch, common);  // beside the others
        }
        make(stages.trunk, std::vector<int>(made));
        EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(made, 1)), count_first(first));
    }
}

struct SharedCase {
    std::int64_t smallest_cut;
    std::int32_t tail;
    Storage storage;
};

class SharedColumns : public testing::TestWithParam<SharedCase> {};

/// As accurate as panel_factor_test.cpp has it, with three threads, from less than half the bytes: entries
/// that are taken for equal differ by 2 x 2^-51 at most.
TEST_P(SharedColumns, SolveLikeColumnsOfTheirOwn) {
    const auto [smallest_cut, tail, storage] = GetParam();
    SymmetricMatrix matrix = grid(63);
    const auto noise = support::random_numbers(matrix.values.size(), 7);
    for (std::size_t i = 0; i < noise.size(); ++i) {
        matrix.values[i] *= 1 + 0x1p-51 * noise[i];  // as the coordinates of cells make it
    }
    PanelFactor factor(matrix, tail, std::make_shared<Workers>(3), storage, smallest_cut);
    const double number = bytes_of(storage);
    EXPECT_LT(static_cast<double>(factor.bytes()), 0.5 * number * static_cast<double>(factor.entries()));
    const Eigen::VectorXd solution =
        support::as_vector(support::random_numbers(static_cast<std::size_t>(matrix.size), 3));
    Eigen::VectorXd b = Eigen::VectorXd::Zero(matrix.size);
    for (std::int32_t column = 0; column < matrix.size; ++column) {
        for (std::int32_t i = matrix.offsets[static_cast<std::size_t>(column)];
             i < matrix.offsets[static_cast<std::size_t>(column) + 1]; ++i) {
            const std::int32_t row = matrix.rows[static_cast<std::size_t>(i)];
            const double value = matrix.values[static_cast<std::size_t>(i)];
            b[row] += value * solution[column];
            b[column] += row == column ? 0.0 : value * solution[row];
        }
    }
    std::vector<double> x(static_cast<std::size_t>(matrix.size));
    for (std::size_t i = 0; i < x.size(); ++i) {
        x[i] = b[factor.order()[i]];
    }
    factor.forward(x);
    if (tail > 0) {
        Eigen::Map<Eigen::VectorXd> of_tail(x.data() + matrix.size - tail, tail);
        of_tail = factor.schur_complement().llt().solve(of_tail).eval();
    }
    factor.backward(x);
    const double u = storage == Storage::words ? 0x1p-32 : 0x1p-53, condition = 8.1 / 0.1;
    for (std::size_t i = 0; i < x.size(); ++i) {
        EXPECT_NEAR(x[i], solution[factor.order()[i]], 10 * condition * u * matrix.size);
    }
}

INSTANTIATE_TEST_SUITE_P(Ways, SharedColumns,
                         testing::Values(SharedCase{worth_threads, 0, Storage::doubles},
                                         SharedCase{0, 0, Storage::doubles},
                                         SharedCase{0, 37, Storage::doubles},
                                         SharedCase{0, 0, Storage::words}, SharedCase{0, 37, Storage::words}),
                         [](const auto& info) { return std::to_string(info.index); });

}  // namespace
}  // namespace thermocontact::solve
