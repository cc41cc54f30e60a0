#include "theory/largest_quotient.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "error.h"
#include "support/dense.h"

namespace thermocontact::theory {
namespace {

Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
    const auto values = support::random_numbers(static_cast<std::size_t>(rows * columns), seed);
    return Eigen::Map<const Eigen::MatrixXd>(values.data(), rows, columns);
}

/// B of the given rank, A well conditioned.
struct Dense {
    Eigen::MatrixXd A, B;
    Eigen::LLT<Eigen::MatrixXd> factor;

    Dense(Eigen::Index size, Eigen::Index rank, double scale = 1) {
        const Eigen::MatrixXd a = random_matrix(size, size, 1), b = random_matrix(size, rank, 2);
        A = a * a.transpose() + Eigen::MatrixXd::Identity(size, size);
        B = scale * b * b.transpose();
        factor.compute(A);
    }

    Quotient quotient() const {
        return {A.rows(), [this](const auto& x, auto& y) { y = B * x; },
                [this](const auto& x, auto& y) { y = A * x; },
                [this](const auto& x, auto& y) { y = factor.solve(x); }};
    }
    double expected() const {
        return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(B, A, Eigen::EigenvaluesOnly)
            .eigenvalues()
            .maxCoeff();
    }
};

struct Case {
    Eigen::Index size, rank;
};

class LargestQuotient : public testing::TestWithParam<Case> {};

/// The error of an eigenvalue is of the order of the residual's square; what is left is round-off.
TEST_P(LargestQuotient, IsTheLargestEigenvalue) {
    for (const double scale : {1.0, 1e-20, 1e20}) {
        const Dense dense(GetParam().size, GetParam().rank, scale);
        const Eigenvalue found = largest_quotient(dense.quotient());
        EXPECT_NEAR(found.value / dense.expected(), 1.0, 1e-12);
        EXPECT_LE(found.residual, 1e-8);
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, LargestQuotient,
                         testing::Values(Case{1, 1}, Case{2, 1}, Case{2, 2}, Case{3, 1}, Case{5, 3},
                                         Case{24, 24}, Case{25, 1}, Case{40, 3}, Case{200, 20},
                                         Case{200, 200}),
                         [](const auto& info) {
                             return "size_" + std::to_string(info.param.size) + "_rank_" +
                                    std::to_string(info.param.rank);
                         });

TEST(LargestQuotient, IsZeroWhereTheNumeratorIs) {
    EXPECT_EQ(largest_quotient(Dense(30, 2, 0.0).quotient()).value, 0);
    EXPECT_EQ(largest_quotient({0, {}, {}, {}}).value, 0);
}

/// Nothing is returned that has not converged: with a wrong inverse, the residual tells.
TEST(LargestQuotient, RefusesWhatDoesNotSolveTheProblem) {
    const Dense dense(40, 40);
    Quotient quotient = dense.quotient();
    quotient.solve = [&](const auto& x, auto& y) {
        y = dense.factor.solve(x);
        y[3] *= 2;
    };
    EXPECT_THROW(largest_quotient(quotient), NumericsError);
}

}  // namespace
}  // namespace thermocontact::theory
