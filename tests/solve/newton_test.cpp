#include "solve/newton.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>

#include "solve/continuation.h"
#include "solve/line_search.h"
#include "support/componentwise.h"
#include "support/dense.h"

namespace thermocontact::solve {
namespace {

using support::Componentwise;
using support::vector;

constexpr NewtonOptions options{1e-12, 50};

Eigen::MatrixXd identity(int n) {
    return Eigen::MatrixXd::Identity(n, n);
}

/// 4 x 4, symmetric positive definite, smallest eigenvalue above 1.
Eigen::MatrixXd stiffness() {
    Eigen::MatrixXd S = Eigen::MatrixXd::Constant(4, 4, 0.5);
    S.diagonal() << 3, 4, 5, 6;
    return S;
}

TEST(Newton, LinearProblemsTakeOneIterationAndOneFactorisation) {
    Componentwise F([](double x) { return 2 * x; }, [](double) { return 2.0; });
    Newton newton(options);
    for (int round = 1; round <= 3; ++round) {
        const Eigen::VectorXd expected = round * vector({1, -2, 3, 0.5});
        const Eigen::VectorXd s = stiffness() * expected + 2 * expected;
        Eigen::VectorXd x = vector({0, 0, 0, 0});
        const NewtonResult result = newton.solve(stiffness(), s, F, x);
        EXPECT_EQ(result.end, NewtonEnd::converged);
        EXPECT_EQ(result.iterations, 1);
        EXPECT_LE(result.residual, options.tolerance);
        EXPECT_LE((x - expected).norm(), 1e-14 * round * 10);
    }
    EXPECT_EQ(newton.factorisations(), 1) << "the factors of the first round serve the others";
}

TEST(Newton, NothingToDo) {
    Componentwise F([](double x) { return x * x; }, [](double x) { return 2 * x; });
    Eigen::VectorXd x = vector({1, 2, 3, 4});
    const Eigen::VectorXd s = stiffness() * x + x.cwiseProduct(x);
    Newton newton(options);
    EXPECT_EQ(newton.solve(stiffness(), s, F, x).iterations, 0);
    EXPECT_EQ(x, vector({1, 2, 3, 4}));
    EXPECT_EQ(newton.factorisations(), 0);
    x.setZero();
    EXPECT_EQ(newton.solve(stiffness(), vector({0, 0, 0, 0}), F, x).end, NewtonEnd::converged) << "0 = 0";
}

/// S x + x^2 = s with a known solution. The relative residual 1e-12 is of terms of size |s|; the derivative's
/// smallest singular value is above 1 there.
TEST(Newton, QuadraticProblem) {
    Componentwise F([](double x) { return x * x; }, [](double x) { return 2 * x; });
    const Eigen::VectorXd expected = vector({1, 2, 0.3, 4});
    const Eigen::VectorXd s = stiffness() * expected + expected.cwiseProduct(expected);
    for (const double start : {0.0, 1.0, 100.0}) {
        Eigen::VectorXd x = Eigen::VectorXd::Constant(4, start);
        Newton newton(options);
        const NewtonResult result = newton.solve(stiffness(), s, F, x);
        ASSERT_EQ(result.end, NewtonEnd::converged) << start;
        EXPECT_LE((x - expected).norm(), 4 * options.tolerance * s.norm());
        // from 100: halved some 6 times, then squared 5 times; kept factors add a few
        EXPECT_LE(result.iterations, 20);
        EXPECT_LE(newton.factorisations(), result.iterations);
    }
}

/// Newton alone diverges on atan from |x| > 1.39; the line search brings it home.
TEST(Newton, LineSearchTamesAtan) {
    Componentwise F([](double x) { return std::atan(x); }, [](double x) { return 1 / (1 + x * x); });
    Eigen::VectorXd x = Eigen::VectorXd::Constant(1, 20.0);
    const NewtonResult result =
        Newton(options).solve(1e-6 * identity(1), Eigen::VectorXd::Constant(1, 0.5), F, x);
    ASSERT_EQ(result.end, NewtonEnd::converged);
    EXPECT_NEAR(1e-6 * x[0] + std::atan(x[0]), 0.5, 1e-12);
}

/// Frictionless contact of a stiff foundation: S x + c (x - g)_+ = s with c = 1e8 and S that couples
/// strongly. At its kinks Newton's direction need not lower the residual, however short the step; the energy
/// falls all the same.
class KinkedEnergy : public ::testing::TestWithParam<int> {};

TEST_P(KinkedEnergy, IsMinimised) {
    constexpr double c = 1e8;
    constexpr int n = 24;
    std::srand(static_cast<unsigned>(GetParam()));
    const Eigen::MatrixXd B = Eigen::MatrixXd::Random(n, n);
    const Eigen::MatrixXd S = B * B.transpose() + 1e-3 * identity(n);
    const Eigen::VectorXd s = 100 * Eigen::VectorXd::Random(n);
    Componentwise F([](double x) { return c * std::max(x, 0.0); }, [](double x) { return x >= 0 ? c : 0.0; });
    Eigen::VectorXd x = Eigen::VectorXd::Random(n);
    Newton newton({1e-10, 200});
    const NewtonResult result = newton.solve(S, s, F, x);
    ASSERT_EQ(result.end, NewtonEnd::converged) << "after " << result.iterations;
    // complementarity of the limit c -> infinity, to p / c
    const Eigen::VectorXd pressure = s - S * x;
    for (Eigen::Index i = 0; i < n; ++i) {
        EXPECT_NEAR(pressure[i], c * std::max(x[i], 0.0), 1e-9 * s.norm());
    }
}

INSTANTIATE_TEST_SUITE_P(Random, KinkedEnergy, ::testing::Range(1, 13));

struct Failure {
    std::string name;
    NewtonEnd end;
    double stiffness;
    std::function<double(double)> f, derivative;
    int max_iterations;
    int iterations;  ///< made before the end
};

const std::vector<Failure> failures{
    {"too_many_iterations", NewtonEnd::too_many_iterations, 1, [](double x) { return x * x * x; },
     [](double x) { return 3 * x * x; }, 1, 1},
    {"no_iteration_allowed", NewtonEnd::too_many_iterations, 1, [](double) { return 0.0; },
     [](double) { return 0.0; }, 0, 0},
    {"ascent_direction", NewtonEnd::line_search_failed, 1, [](double) { return 0.0; },
     [](double) { return -2.0; }, 50, 0},
    {"not_a_number", NewtonEnd::not_finite, 1, [](double) { return std::nan(""); },
     [](double) { return 0.0; }, 50, 0},
    {"infinite", NewtonEnd::not_finite, 1, [](double) { return std::numeric_limits<double>::infinity(); },
     [](double) { return 0.0; }, 50, 0},
    {"singular", NewtonEnd::singular, 0, [](double) { return 0.0; }, [](double) { return 0.0; }, 50, 0},
    {"cancelled_to_singular", NewtonEnd::singular, 1, [](double) { return 0.0; }, [](double) { return -1.0; },
     50, 0}};

class NewtonFailures : public testing::TestWithParam<Failure> {};

TEST_P(NewtonFailures, AreNamed) {
    const Failure& failure = GetParam();
    Componentwise F(failure.f, failure.derivative);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(2);
    Newton newton({1e-12, failure.max_iterations});
    const NewtonResult result = newton.solve(failure.stiffness * identity(2), vector({1, 2}), F, x);
    EXPECT_EQ(result.end, failure.end);
    EXPECT_EQ(result.iterations, failure.iterations);
    EXPECT_FALSE(result.residual <= 1e-12);
    EXPECT_NE(std::string(describe(result.end)), "");
    EXPECT_NE(std::string(describe(result.end)), describe(NewtonEnd::converged));
    EXPECT_EQ(x == vector({0, 0}), failure.iterations == 0) << "x is the last iterate";
}

INSTANTIATE_TEST_SUITE_P(Ends, NewtonFailures, testing::ValuesIn(failures),
                         [](const auto& info) { return info.param.name; });

/// slope (x - root) with a root that no number is: where the last bit of x is worth more than the tolerance,
/// a solution is what rounding it makes of the residual, as long as that is small.
NewtonResult between_two_numbers(double slope) {
    Componentwise F([=](double x) { return slope * (x - 1); }, [=](double) { return slope; });
    Eigen::VectorXd x = vector({2, 3});
    return Newton(options).solve(identity(2), vector({1234.567, 1111.11}), F, x);
}

TEST(Newton, EndsAtRoundOffAndSaysSo) {
    const NewtonResult gentle = between_two_numbers(10), steep = between_two_numbers(1e10),
                       too_steep = between_two_numbers(1e14);
    EXPECT_EQ(gentle.end, NewtonEnd::converged);
    EXPECT_FALSE(gentle.at_round_off);
    EXPECT_EQ(steep.end, NewtonEnd::converged);
    EXPECT_TRUE(steep.at_round_off);
    EXPECT_GT(steep.residual, options.tolerance);
    EXPECT_NE(too_steep.end, NewtonEnd::converged) << "an ulp of x is worth 2e-2 of some 2e3";
    EXPECT_FALSE(too_steep.at_round_off);
}

TEST(RoundOff, IsBoundedByTheTermsOrByContact) {
    const double tolerance = 1e-12;
    EXPECT_TRUE(may_be_round_off(1e-9, 1, 0, tolerance));
    EXPECT_FALSE(may_be_round_off(1.1e-9, 1, 0, tolerance));
    EXPECT_TRUE(may_be_round_off(1.1e-9, 1, 1e8, tolerance));
    EXPECT_FALSE(may_be_round_off(1.1e-9, 1.1, 1e8, tolerance));
}

/// After a failure (here: singular) the same object solves the next problem.
TEST(Newton, RecoversAfterAFailure) {
    Newton newton(options);
    Componentwise bad([](double) { return 0.0; }, [](double) { return -1.0; }),
        good([](double x) { return x; }, [](double) { return 1.0; });
    Eigen::VectorXd x = Eigen::VectorXd::Zero(2);
    EXPECT_EQ(newton.solve(identity(2), vector({1, 2}), bad, x).end, NewtonEnd::singular);
    EXPECT_EQ(newton.solve(identity(2), vector({1, 2}), good, x).end, NewtonEnd::converged);
    EXPECT_LE((x - vector({0.5, 1})).norm(), 1e-14);
}

/// One pivot that vanishes is enough.
TEST(Newton, SingularInOneUnknown) {
    Componentwise F([](double x) { return x; }, [](double x) { return x == 0 ? -1.0 : 1.0; });
    Eigen::VectorXd x = vector({3, 0});
    EXPECT_EQ(Newton(options).solve(identity(2), vector({1, 2}), F, x).end, NewtonEnd::singular);
}

/// J x, J = (a, b; c, d).
class Linear : public NonlinearTerm {
  public:
    Linear(double a, double b, double c, double d) : J_(2, 2) { J_ << a, b, c, d; }
    void evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& value) override { value = J_ * x; }
    void visit_derivative(const Eigen::VectorXd&, const Piece& visit) override {
        const std::array<std::int32_t, 2> unknowns{0, 1};
        const Eigen::MatrixXd rows = J_.transpose();
        visit(unknowns, std::span(rows.data(), 4));
    }

  private:
    Eigen::MatrixXd J_;
};

/// A slipping point: compliance c_n and friction mu c_n in one column, beside a body whose stiffness against
/// slip is 1e-16 of them. It is regular, but for a body that nothing holds against slip.
TEST(Newton, StiffContactIsNotSingular) {
    for (const double stiffness : {1e-3, 1e-8}) {
        Linear F(1e13, 0, 0.5e13, 0);
        Eigen::VectorXd x = vector({0, 0});
        const Eigen::VectorXd s = vector({1e4, 0.5e4 + stiffness});
        const NewtonResult result = Newton(options).solve(stiffness * identity(2), s, F, x);
        EXPECT_EQ(result.end, NewtonEnd::converged) << stiffness;
        EXPECT_NEAR(x[0], 1e-9, 1e-20);
    }
    Linear F(1e13, 0, 0.5e13, 0);
    Eigen::VectorXd x = vector({0, 0});
    EXPECT_EQ(Newton(options).solve(0 * identity(2), vector({1e4, 1}), F, x).end, NewtonEnd::singular);
    Linear cancelling(1, 1, 1, 1 + 1e-15);
    EXPECT_EQ(Newton(options).solve(0 * identity(2), vector({1, 2}), cancelling, x).end, NewtonEnd::singular);
}

/// What a solve that failed has factored does not serve the next one: that goes the way of a new object, to
/// the last bit.
TEST(Newton, AFailureLeavesNothingBehind) {
    Componentwise cubic([](double x) { return x * x * x; }, [](double x) { return 3 * x * x; });
    const NewtonOptions few{1e-12, 12};
    Newton used(few), fresh(few);
    const Eigen::VectorXd s = vector({1.1, -2, 3, 0.6});
    Eigen::VectorXd far = Eigen::VectorXd::Constant(4, 1e6), a = vector({1, 1, 1, 1}), b = a;
    ASSERT_EQ(used.solve(stiffness(), s, cubic, far).end, NewtonEnd::too_many_iterations);
    EXPECT_FALSE(used.kept_derivative(stiffness()));
    const NewtonResult after = used.solve(stiffness(), s, cubic, a),
                       expected = fresh.solve(stiffness(), s, cubic, b);
    EXPECT_EQ(expected.end, NewtonEnd::converged);
    EXPECT_EQ(after.end, expected.end);
    EXPECT_EQ(after.iterations, expected.iterations);
    EXPECT_EQ(a, b);
}

/// Armijo: the norm must fall by a share of what a straight line would make it fall.
TEST(LineSearch, AsksForADecreaseInProportionToTheLength) {
    const auto result_of = [](double share) {  // the residual falls by that share of the length
        int attempts = 0;
        const bool found = line::lower_norm(2.0, [&](double length) {
            ++attempts;
            return LineResidual{(1 - share * length) * 2.0, 0.0};
        });
        return std::pair(found, attempts);
    };
    EXPECT_EQ(result_of(1.0), std::pair(true, 1));
    EXPECT_EQ(result_of(2e-4), std::pair(true, 1));
    EXPECT_EQ(result_of(0.5e-4), std::pair(false, 20)) << "falls, but too little";
    EXPECT_EQ(result_of(0.0), std::pair(false, 20));
    EXPECT_EQ(result_of(-0.5e-4), std::pair(false, 20)) << "rises";
}

/// Coulomb friction of one unknown: mu x / sqrt(x^2 + eps^2), eps >= floor.
struct Friction {
    double bound, epsilon;
    Componentwise raised(double floor) const {
        const double b = bound, e = std::max(floor, epsilon);
        return {[=](double x) { return b * x / std::hypot(x, e); },
                [=](double x) { return b * e * e / std::pow(std::hypot(x, e), 3); }};
    }
};

struct Rubbing {
    std::string name;
    double start, load;
};

/// x + sign_eps(x) = load with eps = 1e-12: it sticks for |load| < 1, x = eps load / sqrt(1 - load^2) up to
/// eps^2, and slips with x = load - 1 beyond. Newton alone finds the zone of width eps by its line search;
/// the ladder must come to the same end.
class Ladder : public testing::TestWithParam<Rubbing> {
  protected:
    const Friction friction{1.0, 1e-12};
    const double load = GetParam().load;
    Newton newton{options};
    std::vector<double> floors;
    ContinuationResult climb(double start, Eigen::VectorXd& x) {
        const auto rung = [&](double floor, Eigen::VectorXd& value) {
            floors.push_back(floor);
            Componentwise F = friction.raised(floor);
            return newton.solve(identity(1), Eigen::VectorXd::Constant(1, load), F, value);
        };
        return continue_regularisation(rung, start, friction.epsilon, x);
    }
};

TEST_P(Ladder, AgreesWithNewtonAlone) {
    Componentwise F = friction.raised(0);
    Eigen::VectorXd alone = Eigen::VectorXd::Constant(1, GetParam().start);
    ASSERT_EQ(Newton(options).solve(identity(1), Eigen::VectorXd::Constant(1, load), F, alone).end,
              NewtonEnd::converged);
    Eigen::VectorXd x = Eigen::VectorXd::Constant(1, GetParam().start);
    const ContinuationResult result = climb(1.0, x);
    ASSERT_EQ(result.newton.end, NewtonEnd::converged);
    EXPECT_EQ(result.rungs, static_cast<int>(floors.size()));
    EXPECT_EQ(floors.front(), 1.0);
    EXPECT_EQ(floors.back(), friction.epsilon);
    EXPECT_GE(result.newton.iterations, result.rungs) << "the sum over the rungs";
    const double share = x[0] / std::hypot(x[0], friction.epsilon);
    EXPECT_NEAR(x[0] + share, load, options.tolerance * (2 + std::abs(load)));
    EXPECT_NEAR(alone[0] + alone[0] / std::hypot(alone[0], friction.epsilon), load,
                options.tolerance * (2 + std::abs(load)));
}

INSTANTIATE_TEST_SUITE_P(Loads, Ladder,
                         testing::Values(Rubbing{"sticks", 1.0, 0.5}, Rubbing{"sticks_backwards", 2.0, -0.7},
                                         Rubbing{"nearly_slips", -1.0, 0.999}, Rubbing{"slips", 1.0, -3.0}),
                         [](const auto& info) { return info.param.name; });

/// A solve that never succeeds ends the ladder at its first rung, and leaves x alone.
TEST(Continuation, CannotSucceed) {
    int calls = 0;
    Eigen::VectorXd x = Eigen::VectorXd::Constant(1, 3.0);
    const auto result = continue_regularisation(
        [&](double, Eigen::VectorXd& value) {
            ++calls;
            value[0] = 99;
            return NewtonResult{NewtonEnd::line_search_failed, 7, 0.5};
        },
        1.0, 1e-12, x);
    EXPECT_EQ(result.newton.end, NewtonEnd::line_search_failed);
    EXPECT_EQ(result.newton.iterations, 7);
    EXPECT_EQ(result.rungs, 1);
    EXPECT_EQ(calls, 1);
    EXPECT_EQ(x[0], 3.0);
}

/// A wall at 1e-3: the ladder comes close to it from above, by ever smaller strides, and ends with the last
/// value solved.
TEST(Continuation, EndsAtAWall) {
    double lowest = 1;
    Eigen::VectorXd x = Eigen::VectorXd::Constant(1, 3.0);
    const auto result = continue_regularisation(
        [&](double floor, Eigen::VectorXd& value) {
            value[0] = floor;
            if (floor < 1e-3) {
                return NewtonResult{NewtonEnd::too_many_iterations, 50, 0.5};
            }
            lowest = std::min(lowest, floor);
            return NewtonResult{NewtonEnd::converged, 2, 1e-13};
        },
        1.0, 1e-12, x);
    EXPECT_EQ(result.newton.end, NewtonEnd::too_many_iterations);
    EXPECT_LT(lowest, 1.2e-3);
    EXPECT_EQ(x[0], lowest);
    EXPECT_LE(result.rungs, 200);
}

/// Rungs that fail at a tenth are tried again closer, and the ladder still arrives.
TEST(Continuation, ShortensItsStride) {
    double last = 1;
    Eigen::VectorXd x = Eigen::VectorXd::Zero(1);
    const auto result = continue_regularisation(
        [&](double floor, Eigen::VectorXd&) {
            if (floor < 0.3 * last) {
                return NewtonResult{NewtonEnd::line_search_failed, 1, 0.5};
            }
            last = floor;
            return NewtonResult{NewtonEnd::converged, 1, 1e-13};
        },
        1.0, 1e-4, x);
    EXPECT_EQ(result.newton.end, NewtonEnd::converged);
    EXPECT_EQ(last, 1e-4);
    EXPECT_GE(result.rungs, 8) << "ln 1e-4 / ln 0.3 = 7.6";
}

/// A start below the target is the target: one solve.
TEST(Continuation, StartBelowTheTarget) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(1);
    std::vector<double> floors;
    const auto result = continue_regularisation(
        [&](double floor, Eigen::VectorXd&) {
            floors.push_back(floor);
            return NewtonResult{NewtonEnd::converged, 1, 0};
        },
        0.0, 1e-2, x);
    EXPECT_EQ(result.rungs, 1);
    EXPECT_EQ(floors, std::vector<double>{1e-2});
}

}  // namespace
}  // namespace thermocontact::solve
