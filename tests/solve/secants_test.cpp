#include "solve/secants.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "support/dense.h"

namespace thermocontact::solve {
namespace {

/// The derivative that Broyden's formula makes of the steps taken, B := B + r s^T / |s|^2 with the residual r
/// after each, as a matrix.
TEST(Secants, AreBroydensUpdates) {
    const Eigen::Index n = 8;
    const Eigen::MatrixXd A =
        support::as_vector(support::random_numbers(64)).reshaped(n, n) + 4 * Eigen::MatrixXd::Identity(n, n);
    const Eigen::MatrixXd kept = 3.5 * Eigen::MatrixXd::Identity(n, n);
    Eigen::MatrixXd B = kept;
    Eigen::VectorXd x = support::as_vector(support::random_numbers(8, 2));
    Secants secants;
    for (int iteration = 0; iteration < 4; ++iteration) {
        const Eigen::VectorXd residual = A * x;
        NewtonUpdate update = secants.improved({-residual / 3.5, A * (-residual / 3.5)});
        const Eigen::VectorXd step = update.step;
        const Eigen::VectorXd expected = -B.partialPivLu().solve(residual);
        EXPECT_LE((step - expected).norm(), 1e-12 * expected.norm()) << iteration;
        x += step;
        const Eigen::VectorXd left = A * x;
        B += left * step.transpose() / step.squaredNorm();
        EXPECT_LE((update.linear - A * step).norm(), 1e-12 * (A * step).norm()) << iteration;
        secants.take(std::move(update));
    }
    secants.forget();
    const Eigen::VectorXd chord = Eigen::VectorXd::Ones(n);
    EXPECT_EQ(secants.improved({chord, chord}).step, chord);
}

/// A step straight back would divide by zero.
TEST(Secants, ANearlySingularUpdateIsLeftOut) {
    Secants secants;
    const Eigen::VectorXd step = Eigen::VectorXd::Ones(3);
    secants.take({step, 2 * step});
    EXPECT_EQ(secants.improved({step, 2 * step}).step, step);
    const NewtonUpdate back = secants.improved({-step, -2 * step});
    EXPECT_EQ(back.step, -0.5 * step);
    EXPECT_EQ(back.linear, -step);
}

}  // namespace
}  // namespace thermocontact::solve
