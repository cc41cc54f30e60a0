#include "fem/both_ways.h"

#include <gtest/gtest.h>

#include <limits>

#include "mesh/shapes.h"
#include "solve/workers.h"
#include "support/dense.h"

namespace thermocontact::fem {
namespace {

struct Body {
    mesh::Mesh mesh = mesh::make_rectangle({"rectangle", {0, 0}, {1, 1}, {4, 80}, "right"});
    Space space = make_space(mesh, 1);
    NodeGraph graph = make_node_graph(space);

    /// As it is assembled: the second block of a node with itself is zero.
    BlockMatrix random(int rows) const {
        BlockMatrix matrix = zero_matrix(graph, rows, 1);
        matrix.values = support::random_numbers(matrix.values.size(), 3);
        for (std::size_t node = 0; node + 1 < graph.offsets.size(); ++node) {
            for (int r = 0; r < rows; ++r) {
                matrix.values[static_cast<std::size_t>((2 * graph.offsets[node] + 1) * rows + r)] = 0;
            }
        }
        return matrix;
    }

    BlockMatrix heating(const std::vector<double>& R) const {
        return assemble_matrix({find_kernel("strain_heating.coupling", "triangle", 1), mesh, {{"R", R}}},
                               space, graph, 1, 2);
    }
    BlockMatrix coupling(const std::vector<double>& M) const {
        return assemble_matrix({find_kernel("thermal_stress.coupling", "triangle", 1), mesh, {{"M", M}}},
                               space, graph, 2, 1);
    }
};

/// Of any number of components, by ranges of any size and any number of threads, whose number changes no bit.
TEST(BothWays, AreAMatrixAndItsTranspose) {
    const Body body;
    const auto nodes = static_cast<std::size_t>(body.graph.node_count());
    for (const int rows : {2, 3}) {
        const BlockMatrix A = body.random(rows);
        const auto size = nodes * static_cast<std::size_t>(rows);
        const std::vector<double> x = support::random_numbers(nodes, 4), u = support::random_numbers(size, 5);
        const Eigen::MatrixXd dense = support::dense(A);
        // at most 7 nodes couple with one: sums of 21 terms of size 1, times 2.5, in another order
        const double tolerance = 2 * 2.5 * 21 * 21 * std::numeric_limits<double>::epsilon();
        std::vector<double> first;
        for (const std::int32_t range : {1 << 20, 100, 1}) {
            for (const int threads : {1, 3}) {
                solve::Workers workers(threads);
                Traversal traversal(
                    body.graph, [&](int count, const auto& task) { workers.run(count, task); }, range);
                std::vector<double> y(size, 9), back(nodes, 9);
                const BothWays both{&A, &x, &y, -2.5, &u, &back};
                traversal.run(std::array{pass_of(both)});
                const Eigen::VectorXd there = support::as_vector(y) - dense * support::as_vector(x),
                                      again = support::as_vector(back) +
                                              2.5 * dense.transpose() * support::as_vector(u);
                EXPECT_LE(there.cwiseAbs().maxCoeff(), tolerance);
                EXPECT_LE(again.cwiseAbs().maxCoeff(), tolerance);
                y.insert(y.end(), back.begin(), back.end());
                EXPECT_TRUE(threads == 1 || y == first);
                first = y;
            }
        }
    }
}

TEST(BothWays, TransposesAreFoundUpToAFactor) {
    const Body body;
    const BlockMatrix M = body.coupling({1, 0.3, 0.3, 2});
    const auto factor = factor_of_transposed(M, body.heating({-0.7, -0.21, -0.21, -1.4}));
    ASSERT_TRUE(factor);
    EXPECT_NEAR(*factor, -0.7, 1e-14);  // some epsilon of the entry that tells
    EXPECT_FALSE(factor_of_transposed(M, body.heating({-0.7, -0.21, -0.21, -1.4000001})));
    EXPECT_FALSE(factor_of_transposed(M, body.heating({-0.7, -0.2100001, -0.2100001, -1.4})));
    EXPECT_FALSE(factor_of_transposed(body.coupling({0, 0, 0, 0}), body.heating({1, 0, 0, 1})));
    EXPECT_EQ(factor_of_transposed(M, body.heating({0, 0, 0, 0})), 0.0);
}

}  // namespace
}  // namespace thermocontact::fem
