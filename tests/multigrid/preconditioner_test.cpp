#include "multigrid/preconditioner.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <map>
#include <memory>

#include "multigrid/body.h"
#include "support/thread_team.h"

namespace thermocontact::multigrid {
namespace {

const parallel::Alone alone;

struct Case {
    const char* name;
    int dimension, coarse, fine;
    bool scalar;
};

class Bodies : public ::testing::TestWithParam<Case> {};

/// A V-cycle is symmetric and positive definite but for single precision: eps 6e-8, times some hundred
/// operations on an entry.
TEST_P(Bodies, CycleIsSymmetricAndPositive) {
    const Body body(GetParam().dimension, GetParam().coarse, GetParam().scalar);
    Solver solver(body, alone);
    const std::vector<double> a = solver.free(solver.noise(1)), b = solver.free(solver.noise(2));
    std::vector<double> Ma(a.size()), Mb(b.size());
    solver.preconditioner.apply(a, Ma);
    solver.preconditioner.apply(b, Mb);
    const double size = std::sqrt(solver.dot(a, Ma) * solver.dot(b, Mb));
    EXPECT_GT(solver.dot(a, Ma), 0);
    EXPECT_NEAR(solver.dot(a, Mb), solver.dot(b, Ma), 1e-5 * size);
    EXPECT_EQ(solver.free(Ma), Ma) << "a fixed dof moved";
}

/// Eight digits in few iterations, and hardly more on twice as fine a mesh. Without coarse levels it takes
/// more than 100.
TEST_P(Bodies, IterationsDoNotGrow) {
    const Body coarse(GetParam().dimension, GetParam().coarse, GetParam().scalar);
    const Body fine(GetParam().dimension, GetParam().fine, GetParam().scalar);
    const int few = Solver(coarse, alone).iterations(), many = Solver(fine, alone).iterations();
    EXPECT_LE(few, 20);
    EXPECT_LE(many, 1.25 * few);
}

/// Three processes find about as good a cycle, and each finds the same as the others at shared nodes, to the
/// last bit.
TEST_P(Bodies, AsGoodOnSeveralProcesses) {
    constexpr int processes = 3;
    const Body whole(GetParam().dimension, GetParam().coarse, GetParam().scalar);
    const int at_once = Solver(whole, alone).iterations();
    std::vector<int> iterations(processes);
    std::vector<std::unique_ptr<Body>> parts;
    for (int rank = 0; rank < processes; ++rank) {
        parts.push_back(std::make_unique<Body>(GetParam().dimension, GetParam().coarse, GetParam().scalar,
                                               processes, rank));
    }
    std::vector<std::map<std::int32_t, double>> found(processes);
    support::ThreadTeam::run(processes, [&](const parallel::Team& team) {
        const auto rank = static_cast<std::size_t>(team.rank());
        const Body& body = *parts[rank];
        Solver solver(body, team);
        iterations[rank] = solver.iterations();
        std::vector<double> z(body.dofs());
        solver.preconditioner.apply(solver.free(solver.noise(1)), z);
        for (std::size_t dof = 0; dof < z.size(); ++dof) {
            const auto size = static_cast<std::size_t>(body.A.rows);
            const std::int32_t node = body.part.numbers.whole[dof / size];
            found[rank][node * body.A.rows + static_cast<std::int32_t>(dof % size)] = z[dof];
        }
    });
    EXPECT_EQ(iterations[1], iterations[0]);
    EXPECT_EQ(iterations[2], iterations[0]);
    EXPECT_NEAR(iterations[0], at_once, 0.25 * at_once);
    for (const auto& [dof, value] : found[0]) {
        for (int other = 1; other < processes; ++other) {
            const auto there = found[static_cast<std::size_t>(other)].find(dof);
            if (there != found[static_cast<std::size_t>(other)].end()) {
                EXPECT_EQ(there->second, value);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Preconditioner, Bodies,
                         ::testing::Values(Case{"scalar_plane", 2, 40, 80, true},
                                           Case{"plane", 2, 30, 60, false},
                                           Case{"scalar_space", 3, 12, 20, true},
                                           Case{"space", 3, 8, 14, false}),
                         [](const auto& info) { return info.param.name; });

/// Iterations of GMRES that lower the residual of (1 + C M^-1) b 1e8-fold, 100 at most; `product` is x -> A
/// x.
template <typename Product>
int gmres_iterations(Preconditioner& preconditioner, Product&& product, const Eigen::VectorXd& b) {
    constexpr int most = 100;
    Eigen::MatrixXd basis(b.size(), most + 1), H = Eigen::MatrixXd::Zero(most + 1, most);
    basis.col(0) = b.normalized();
    std::vector<double> z(static_cast<std::size_t>(b.size()));
    for (int k = 0; k < most; ++k) {
        preconditioner.apply(support::as_std(basis.col(k)), z);
        Eigen::VectorXd next = support::as_vector(product(z));
        for (int turn = 0; turn < 2; ++turn) {
            const Eigen::VectorXd parts = basis.leftCols(k + 1).transpose() * next;
            next -= basis.leftCols(k + 1) * parts;
            H.col(k).head(k + 1) += parts;
        }
        H(k + 1, k) = next.norm();
        basis.col(k + 1) = next.normalized();
        const Eigen::MatrixXd small = H.topLeftCorner(k + 2, k + 1);
        const Eigen::VectorXd e = Eigen::VectorXd::Unit(k + 2, 0);
        if ((small * small.colPivHouseholderQr().solve(e) - e).norm() <= 1e-8) {
            return k + 1;
        }
    }
    return most + 1;
}

/// Friction at the bottom of the square as dF/dx has it: a normal force c u.n, and mu times it along the
/// slip. Without the rotations c = 1e10 takes more than 100 iterations.
TEST(Preconditioner, StiffContactWithFrictionCostsNoIterations) {
    constexpr double mu = 0.5;
    const Body body(2, 30, false);
    const Solver solver(body, alone);
    Preconditioner preconditioner(body.A, body.fixed, body.part, alone);
    for (const double c : {1e2, 1e6, 1e10}) {
        Pieces D;
        for (std::size_t node = 0; node < body.part.space.nodes.size(); ++node) {
            if (body.part.space.nodes[node][1] == 0.0 && body.fixed[2 * node] == 0) {
                const auto dof = static_cast<std::int32_t>(2 * node);
                D.sizes.push_back(2);
                D.dofs.insert(D.dofs.end(), {dof, dof + 1});
                D.values.insert(D.values.end(), {0, mu * c, 0, c});
            }
        }
        preconditioner.renew(D);
        const auto product = [&](const std::vector<double>& x) {
            std::vector<double> y = solver.product(x);
            for (std::size_t k = 0; k < D.dofs.size(); k += 2) {
                const auto dof = static_cast<std::size_t>(D.dofs[k]);
                y[dof] += mu * c * x[dof + 1];
                y[dof + 1] += c * x[dof + 1];
            }
            return y;
        };
        const Eigen::VectorXd b = support::as_vector(solver.free(solver.noise(3)));
        EXPECT_LE(gmres_iterations(preconditioner, product, b), 25) << "c = " << c;
    }
}

}  // namespace
}  // namespace thermocontact::multigrid
