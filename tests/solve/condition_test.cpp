#include "solve/condition.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "support/dense.h"

namespace thermocontact::solve {
namespace {

Eigen::MatrixXd random_matrix(int n, unsigned seed) {
    return support::as_vector(support::random_numbers(static_cast<std::size_t>(n * n), seed)).reshaped(n, n);
}

double norm_1(const Eigen::MatrixXd& B) {
    return B.cwiseAbs().colwise().sum().maxCoeff();
}

double estimate(const Eigen::MatrixXd& B) {
    return estimate_norm_1(
        B.rows(), [&](const Eigen::VectorXd& v) -> Eigen::VectorXd { return B * v; },
        [&](const Eigen::VectorXd& v) -> Eigen::VectorXd { return B.transpose() * v; });
}

TEST(Condition, NormIsEstimatedFromBelow) {
    for (unsigned seed = 1; seed <= 50; ++seed) {
        const Eigen::MatrixXd B = random_matrix(static_cast<int>(seed % 12) + 1, seed);
        EXPECT_LE(estimate(B), norm_1(B) * (1 + 1e-14)) << seed;
        EXPECT_GE(estimate(B), norm_1(B) / 3) << seed;
    }
}

TEST(Condition, NormOfOneColumnIsFound) {
    Eigen::MatrixXd B = 1e-3 * random_matrix(9, 3);
    B.col(6) = support::vector({1, -2, 3, -4, 5, 6, 7, -8, 9});
    EXPECT_NEAR(estimate(B), 45, 1e-12);
}

/// The largest column is outweighed by the three others, so that the first gradient shows it with a minus.
TEST(Condition, ColumnsOfEitherSignAreFound) {
    const Eigen::VectorXd v = support::vector({1, -2, 3, 4});
    Eigen::MatrixXd B(4, 4);
    B << v, -0.4 * v, -0.4 * v, -0.4 * v;
    EXPECT_NEAR(estimate(B), 10, 1e-12);
}

/// cond(T, x) by its definition.
double exact_condition(const Eigen::MatrixXd& T, const Eigen::VectorXd& x) {
    return (T.inverse().cwiseAbs() * (T.cwiseAbs() * x.cwiseAbs())).lpNorm<Eigen::Infinity>() /
           x.lpNorm<Eigen::Infinity>();
}

double condition_of(const Eigen::MatrixXd& T, const Eigen::VectorXd& x) {
    const Eigen::PartialPivLU<Eigen::MatrixXd> factors(T);
    return skeel_condition(
        [&](const Eigen::VectorXd& v) -> Eigen::VectorXd { return factors.solve(v); },
        [&](const Eigen::VectorXd& v) -> Eigen::VectorXd { return factors.transpose().solve(v); },
        T.cwiseAbs() * x.cwiseAbs(), x);
}

TEST(Condition, IsSkeels) {
    for (unsigned seed = 1; seed <= 30; ++seed) {
        const Eigen::MatrixXd T = random_matrix(7, seed);
        const Eigen::VectorXd x = support::as_vector(support::random_numbers(7, seed + 100));
        const double exact = exact_condition(T, x), estimated = condition_of(T, x);
        EXPECT_LE(estimated, exact * (1 + 1e-10)) << seed;
        EXPECT_GE(estimated, exact / 3) << seed;
    }
}

/// Scaled rows are harmless, however badly; so is a diagonal of any decades.
TEST(Condition, SeesThroughScaling) {
    const Eigen::MatrixXd T = random_matrix(5, 4);
    const Eigen::VectorXd x = support::vector({1, 0.5, -1, 2, 1});
    const Eigen::VectorXd decades = support::vector({1e-12, 1, 1e8, 1e14, 1e-3});
    EXPECT_NEAR(condition_of(decades.asDiagonal() * T, x) / condition_of(T, x), 1, 1e-9);
    EXPECT_EQ(condition_of(decades.asDiagonal().toDenseMatrix(), x), 1);
}

/// Rows that nearly agree: 1 / distance digits are gone.
TEST(Condition, SeesWhatIsNearlySingular) {
    Eigen::Matrix2d T;
    T << 1, 1, 1, 1 + 1e-7;
    EXPECT_NEAR(condition_of(T, support::vector({1, -0.5})), 3e7, 1e6);
    T << 1, 1, 1, 1;
    EXPECT_EQ(condition_of(T, support::vector({1, 1})), std::numeric_limits<double>::infinity());
}

TEST(Condition, OfNothingIsOne) {
    EXPECT_EQ(condition_of(random_matrix(3, 1), support::vector({0, 0, 0})), 1);
    EXPECT_EQ(skeel_condition({}, {}, {}, {}), 1);
}

TEST(Condition, LeavesDigits) {
    EXPECT_NEAR(digits_left(1), 15.65, 0.01);
    EXPECT_NEAR(digits_left(1e10), 5.65, 0.01);
    EXPECT_EQ(digits_left(1e20), 0);
    EXPECT_EQ(digits_left(std::numeric_limits<double>::infinity()), 0);
}

}  // namespace
}  // namespace thermocontact::solve
