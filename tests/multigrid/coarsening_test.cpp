#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <map>

#include "multigrid/blocks.h"
#include "multigrid/body.h"
#include "multigrid/coarse_scaling.h"
#include "multigrid/galerkin.h"
#include "multigrid/level.h"

namespace thermocontact::multigrid {
namespace {

const parallel::Alone alone;

Eigen::MatrixXd dense(const Matrix& A) {
    const auto stride = static_cast<std::size_t>(lanes(A.size));
    const Eigen::Index n = Eigen::Index{A.node_count()} * A.size;
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index column = 0; column < n; ++column) {
        std::vector<float> x(static_cast<std::size_t>(A.node_count()) * stride, 0.0F), y(x.size());
        x[static_cast<std::size_t>(column / A.size) * stride + static_cast<std::size_t>(column % A.size)] =
            1.0F;
        A.subtract_product(x, y);
        for (Eigen::Index row = 0; row < n; ++row) {
            result(row, column) =
                -y[static_cast<std::size_t>(row / A.size) * stride + static_cast<std::size_t>(row % A.size)];
        }
    }
    return result;
}

Eigen::MatrixXd dense(const Prolongation& P, Eigen::Index coarse_nodes) {
    const auto stride = static_cast<std::size_t>(lanes(P.coarse_size)),
               size = static_cast<std::size_t>(P.fine_size);
    const auto fine_nodes = static_cast<Eigen::Index>(P.offsets.size()) - 1;
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(fine_nodes * P.fine_size, coarse_nodes * P.coarse_size);
    for (Eigen::Index i = 0; i < fine_nodes; ++i) {
        for (auto entry = P.offsets[static_cast<std::size_t>(i)];
             entry < P.offsets[static_cast<std::size_t>(i) + 1]; ++entry) {
            const auto place = static_cast<std::size_t>(entry);
            for (std::size_t r = 0; r < size; ++r) {
                for (int c = 0; c < P.coarse_size; ++c) {
                    result(i * P.fine_size + static_cast<Eigen::Index>(r),
                           P.columns[place] * P.coarse_size + c) =
                        P.values[(place * size + r) * stride + static_cast<std::size_t>(c)];
                }
            }
        }
    }
    return result;
}

/// A body's finest level and the next one.
struct TwoLevels {
    Body body;
    SharedNodes nodes;
    Scaling scaling;
    Matrix A;
    Aggregates aggregates;
    NearNullSpace motions;

    TwoLevels(int dimension, int cells, bool scalar)
        : body(dimension, cells, scalar),
          nodes(body.part.numbers, alone),
          scaling(body.A.rows, fine_diagonal(body.A, {}, body.fixed, nodes)),
          A(fine_matrix(body.A, {}, body.fixed, scaling)),
          aggregates(aggregate(A, std::vector<char>(nodes.node_count(), 1), nodes)),
          motions{scalar ? 1 : 3 * (dimension - 1), {}} {
        const auto entries = body.dofs() * static_cast<std::size_t>(motions.motions);
        motions.values = support::random_numbers(entries, 7);
    }
};

class Coarsen : public ::testing::TestWithParam<std::tuple<int, bool>> {
  protected:
    TwoLevels at{std::get<0>(GetParam()), std::get<0>(GetParam()) == 2 ? 7 : 4, std::get<1>(GetParam())};
};

/// The entries are of order one, sums have some dozens of terms, single precision has 6e-8.
TEST_P(Coarsen, CoarseMatrixIsTheProjection) {
    const Coarsening coarse = coarsen(at.A, 2.0, at.aggregates, at.motions, at.nodes);
    const std::size_t count = coarse.numbers.global.size();
    const Eigen::MatrixXd P = dense(coarse.prolongation, static_cast<Eigen::Index>(count));
    const Eigen::MatrixXd expected = P.transpose() * dense(at.A) * P;
    EXPECT_GT(expected.cwiseAbs().maxCoeff(), 0.1);
    EXPECT_LT((dense(galerkin(at.A, coarse.prolongation, count)) - expected).cwiseAbs().maxCoeff(), 1e-5);
}

/// Q R = B on aggregates; columns of Q are orthonormal; P = (1 - 2/3 A) Q for an eigenvalue of 2.
TEST_P(Coarsen, ProlongationsCarryTheMotions) {
    const Tentative given = tentative(at.aggregates, at.motions, at.A.size, 0);
    const Rows& rows = given.transposed;
    const Prolongation tentative_only{at.A.size, at.motions.motions, rows.offsets, rows.columns, rows.values};
    const Eigen::MatrixXd Q = dense(tentative_only, at.aggregates.count);
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::Map<const RowMajor> R(given.motions.values.data(), Q.cols(), at.motions.motions);
    const Eigen::Map<const RowMajor> B(at.motions.values.data(), Q.rows(), at.motions.motions);
    for (std::size_t node = 0; node < at.aggregates.of.size(); ++node) {
        const auto first = static_cast<Eigen::Index>(node) * at.A.size;
        const double difference =
            (Q.middleRows(first, at.A.size) * R - B.middleRows(first, at.A.size)).norm();
        EXPECT_LT(difference, at.aggregates.of[node] < 0 ? 1e9 : 1e-5);
    }
    const Eigen::MatrixXd square = Q.transpose() * Q;
    EXPECT_LT((square - square.cwiseAbs().diagonal().asDiagonal().toDenseMatrix()).norm(), 1e-5);
    const Coarsening coarse = coarsen(at.A, 2.0, at.aggregates, at.motions, at.nodes);
    const Eigen::MatrixXd P = dense(coarse.prolongation, at.aggregates.count);
    EXPECT_LT((P - (Q - 2.0 / 3.0 * dense(at.A) * Q)).cwiseAbs().maxCoeff(), 1e-5);
}

/// What a motion is on the fine level and what energy it has does not depend on the scaling; diagonal blocks
/// are 1.
TEST_P(Coarsen, ScalingKeepsTheMotions) {
    Coarsening coarse = coarsen(at.A, 2.0, at.aggregates, at.motions, at.nodes);
    const std::size_t count = coarse.numbers.global.size();
    Matrix A = galerkin(at.A, coarse.prolongation, count);
    const SharedNodes nodes(coarse.numbers, alone);
    const auto on_fine_level = [&] {
        using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
        const Eigen::MatrixXd P = dense(coarse.prolongation, static_cast<Eigen::Index>(count));
        const Eigen::Map<const RowMajor> B(coarse.motions.values.data(), P.cols(), coarse.motions.motions);
        return std::pair<Eigen::MatrixXd, Eigen::MatrixXd>(P * B, B.transpose() * dense(A) * B);
    };
    const auto [before, energy] = on_fine_level();
    scale_coarse(A, coarse.prolongation, coarse.motions, nodes);
    const auto [after, same_energy] = on_fine_level();
    EXPECT_LT((after - before).norm(), 1e-4 * before.norm());
    EXPECT_LT((same_energy - energy).norm(), 1e-4 * energy.norm());
    const Eigen::VectorXd diagonal = dense(A).diagonal();
    EXPECT_LT((diagonal.array() - 1).abs().minCoeff(), 1e-4);
    EXPECT_TRUE(((diagonal.array() - 1).abs() < 1e-4 || diagonal.array().abs() < 1e-4).all());  // or lacking
}

/// L^-1 (A + (D + D^T) / 2) L^-T of the free dofs, for pieces of D that couple neighbours and are not
/// symmetric.
TEST_P(Coarsen, FinestMatrixHoldsContact) {
    const int size = at.A.size;
    Pieces D;
    for (std::int32_t node = 1; node < 3; ++node) {  // a node and the next one that couples with it
        const std::int32_t other =
            at.A.columns[static_cast<std::size_t>(at.A.offsets[static_cast<std::size_t>(node)]) + 1];
        for (const std::int32_t place : {node, other}) {
            for (int c = 0; c < size; ++c) {
                D.dofs.push_back(place * size + c);
            }
        }
        D.sizes.push_back(2 * size);
    }
    D.values = support::random_numbers(static_cast<std::size_t>(2 * 4 * size * size), 5);
    Eigen::MatrixXd expected = support::dense(at.body.A);
    const std::int32_t* dofs = D.dofs.data();
    const double* value = D.values.data();
    for (const std::int32_t n : D.sizes) {
        for (int r = 0; r < n; ++r) {
            for (int c = 0; c < n; ++c, ++value) {
                expected(dofs[r], dofs[c]) += *value / 2;
                expected(dofs[c], dofs[r]) += *value / 2;
            }
        }
        dofs += n;
    }
    const Scaling scaling(size, fine_diagonal(at.body.A, D, at.body.fixed, at.nodes));
    Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(expected.rows(), expected.cols());
    for (Eigen::Index node = 0; node < expected.rows() / size; ++node) {
        for (int r = 0; r < size; ++r) {
            for (int c = 0; c < size; ++c) {
                inverse(node * size + r, node * size + c) =
                    scaling.inverse(static_cast<std::size_t>(node))[r * size + c];
            }
        }
    }
    for (Eigen::Index dof = 0; dof < expected.rows(); ++dof) {
        if (at.body.fixed[static_cast<std::size_t>(dof)] != 0) {
            expected.row(dof).setZero();
            expected.col(dof).setZero();
        }
    }
    expected = inverse * expected * inverse.transpose();
    EXPECT_LT((dense(fine_matrix(at.body.A, D, at.body.fixed, scaling)) - expected).cwiseAbs().maxCoeff(),
              1e-5);
}

/// The estimate needs ten steps of Lanczos' method and is never above the eigenvalue.
TEST_P(Coarsen, LargestEigenvalueIsNear) {
    const double exact = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense(at.A), Eigen::EigenvaluesOnly)
                             .eigenvalues()
                             .maxCoeff();
    const double estimate = Level(at.A, at.nodes).largest();
    EXPECT_LE(estimate, (1 + 1e-5) * exact);
    EXPECT_GE(1.1 * estimate, exact);  // the smoother's interval ends there
}

INSTANTIATE_TEST_SUITE_P(Multigrid, Coarsen, ::testing::Combine(::testing::Values(2, 3), ::testing::Bool()),
                         [](const auto& info) {
                             return std::string(std::get<1>(info.param) ? "scalar" : "vector") +
                                    std::to_string(std::get<0>(info.param)) + "d";
                         });

TEST(Aggregation, EveryNodeHasOneAndTheyAreConnected) {
    const TwoLevels at(2, 20, true);
    EXPECT_LT(at.aggregates.count, 441 / 4);
    std::vector<int> members(static_cast<std::size_t>(at.aggregates.count), 0);
    for (std::size_t node = 0; node < at.nodes.node_count(); ++node) {
        if (at.body.fixed[node] == 0) {
            ASSERT_GE(at.aggregates.of[node], 0);
            ++members[static_cast<std::size_t>(at.aggregates.of[node])];
        } else {
            EXPECT_EQ(at.aggregates.of[node], -1) << "a fixed node couples with none";
        }
    }
    EXPECT_TRUE(std::ranges::all_of(members, [](int count) { return count > 1; }));
}

/// Conduction that is 1e4 times better along y: aggregates lie along y.
TEST(Aggregation, FollowsStrongCouplings) {
    Body body(2, 16, true);
    for (double& value : body.A.values) {
        value = 0;
    }
    const fem::Constants constants{{"K", {1, 0, 0, 1e4}}};
    auto kernel = fem::find_kernel("conduction.conduction", "triangle", 1);
    body.A.add(1.0, fem::assemble_matrix({std::move(kernel), body.part.mesh, constants}, body.part.space,
                                         body.graph, 1, 1));
    const SharedNodes nodes(body.part.numbers, alone);
    const Scaling scaling(1, fine_diagonal(body.A, {}, body.fixed, nodes));
    const Matrix A = fine_matrix(body.A, {}, body.fixed, scaling);
    const Aggregates aggregates = aggregate(A, std::vector<char>(nodes.node_count(), 1), nodes);
    std::map<std::int32_t, double> place;
    for (std::size_t node = 0; node < nodes.node_count(); ++node) {
        if (const std::int32_t a = aggregates.of[node]; a >= 0) {
            const double x = body.part.space.nodes[node][0];
            EXPECT_EQ(place.try_emplace(a, x).first->second, x);
        }
    }
    EXPECT_GT(place.size(), 16U);
}

/// Blocks as stiff contact makes them, 1e10 to 1 along an oblique normal: the scaled block is the identity
/// but for what eps times the ratio leaves of the softer direction.
TEST(Scaling, StiffBlocksBecomeTheIdentity) {
    const double c = 1e10;  // eps c = 2e-6
    std::vector<double> D{1 + 0.36 * c, 0.48 * c, 0.48 * c, 1 + 0.64 * c};
    const Scaling scaling(2, D);
    scaling.scale(0, 0, D);
    EXPECT_NEAR(D[0], 1, 1e-5);
    EXPECT_NEAR(D[1], 0, 1e-5);
    EXPECT_NEAR(D[2], 0, 1e-5);
    EXPECT_NEAR(D[3], 1, 1e-5);
}

TEST(Scaling, OfABlockThatIsNotPositiveDefiniteTakesItsDiagonal) {
    const Scaling scaling(2, {4, 5, 5, -1});
    EXPECT_EQ(scaling.inverse(0)[0], 0.5);
    EXPECT_EQ(scaling.inverse(0)[1], 0);
    EXPECT_EQ(scaling.inverse(0)[2], 0);
    EXPECT_EQ(scaling.inverse(0)[3], 1);
}

}  // namespace
}  // namespace thermocontact::multigrid
