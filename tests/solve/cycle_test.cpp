#include "solve/cycle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>

#include "solve/continuation.h"
#include "solve/newton.h"
#include "support/dense.h"

namespace thermocontact::solve {
namespace {

using support::vector;

/// The iterate at which a sequence of |R| returns, from 1; 0: it does not. |A x| and |F(x)| stay.
int returns_at(std::initializer_list<double> residuals) {
    CycleDetector cycle;
    int at = 0;
    for (const double residual : residuals) {
        ++at;
        if (cycle.returns({residual, 5.0, 0.0})) {
            return at;
        }
    }
    return 0;
}

TEST(Cycle, IsTwoEqualRounds) {
    EXPECT_EQ(returns_at({9, 4, 3, 8, 3, 8}), 6) << "a period of two";
    EXPECT_EQ(returns_at({4, 3, 8, 4.0001, 3, 8}), 6) << "of three, approached";
    EXPECT_EQ(returns_at({4, 3, 8, 4.02, 3, 8}), 0) << "moves by more than a thousandth of the round's 5";
    EXPECT_EQ(returns_at({9, 4, 3, 8, 4}), 0) << "one round is none";
    EXPECT_EQ(returns_at({7, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}),
              25);
    EXPECT_EQ(returns_at({3, 3 * (1 + 4e-16)}), 2) << "stands still";
}

TEST(Cycle, IsNoDescent) {
    EXPECT_EQ(returns_at({8, 4, 2, 1, 0.1, 1e-3, 1e-7}), 0);
    // the smallest steps that the line search takes: 1e-4 of 2^-19
    CycleDetector cycle;
    double residual = 1;
    for (int i = 0; i < 50; ++i, residual *= 1 - 1.9e-10) {
        ASSERT_FALSE(cycle.returns({residual, 5.0, 0.0})) << i;
    }
}

TEST(Cycle, NeedsEachNorm) {
    for (const std::size_t other : {1U, 2U}) {
        CycleDetector cycle;
        for (int i = 0; i < 24; ++i) {
            CycleDetector::Norms norms{i % 2 == 0 ? 3.0 : 8.0, 5.0, 7.0};
            norms[other] = 10 - std::pow(0.9, i);
            ASSERT_FALSE(cycle.returns(norms)) << "|R| returns, but not the state";
        }
    }
}

/// Compliance c u_+ and friction mu c u_+ v / |v|_eps of one contact point with the unknowns u, v.
class Rubbing : public NonlinearTerm {
  public:
    Rubbing(double c, double mu, double eps) : c_(c), mu_(mu), eps_(eps) {}

    void evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& value) override {
        const double pressure = c_ * std::max(x[0], 0.0);
        value = vector({pressure, mu_ * pressure * x[1] / std::hypot(x[1], eps_)});
    }
    void visit_derivative(const Eigen::VectorXd& x, const Piece& visit) override {
        const double slope = x[0] >= 0 ? c_ : 0.0, length = std::hypot(x[1], eps_);
        const double sticking = mu_ * c_ * std::max(x[0], 0.0) * eps_ * eps_ / std::pow(length, 3);
        const std::array<std::int32_t, 2> unknowns{0, 1};
        const std::array<double, 4> values{slope, 0.0, mu_ * slope * x[1] / length, sticking};
        visit(unknowns, values);
    }

  private:
    double c_, mu_, eps_;
};

/// One of the smallest problems that cycle, found among random ones: the body's coupling pulls the point from
/// the foundation as it slips and back as it sticks.
class Cycling : public testing::Test {
  protected:
    static constexpr double c = 1000, mu = 4, epsilon = 0.01;
    const Eigen::MatrixXd S = (Eigen::Matrix2d() << 9, -3, -3, 5).finished();
    const Eigen::VectorXd s = vector({7, -5}), rest = vector({0, 0});

    NewtonResult solve(int max_iterations, Eigen::VectorXd& x) const {
        Rubbing F(c, mu, epsilon);
        return Newton({1e-12, max_iterations}).solve(S, s, F, x);
    }
};

TEST_F(Cycling, IsRecognisedAfterAFewRounds) {
    Eigen::VectorXd x = rest;
    const NewtonResult result = solve(1000, x);
    EXPECT_EQ(result.end, NewtonEnd::cycling);
    EXPECT_LE(result.iterations, 25);
}

/// Cut into pieces too short to show two rounds, the iteration is not stopped: it spends whatever it may, and
/// comes no nearer.
TEST_F(Cycling, WouldNeverEnd) {
    Eigen::VectorXd x = rest;
    double nearest = 1;
    for (int piece = 0; piece < 100; ++piece) {
        const NewtonResult result = solve(8, x);
        ASSERT_EQ(result.end, NewtonEnd::too_many_iterations) << "piece " << piece;
        ASSERT_EQ(result.iterations, 8);
        nearest = std::min(nearest, result.residual);
    }
    EXPECT_GT(nearest, 1e-3);
}

TEST_F(Cycling, IsAnsweredByContinuation) {
    Eigen::VectorXd x = rest;
    const auto rung = [&](double floor, Eigen::VectorXd& value) {
        Rubbing F(c, mu, std::max(floor, epsilon));
        return Newton({1e-12, 50}).solve(S, s, F, value);
    };
    const ContinuationResult result = continue_regularisation(rung, 1.0, epsilon, x);
    ASSERT_EQ(result.newton.end, NewtonEnd::converged);
    EXPECT_LE(result.newton.iterations, 25);
    Eigen::VectorXd forces;
    Rubbing(c, mu, epsilon).evaluate(x, forces);
    EXPECT_LE((S * x + forces - s).norm(), 1e-11 * s.norm());
    EXPECT_GT(x[0], 0) << "in contact";
}

}  // namespace
}  // namespace thermocontact::solve
