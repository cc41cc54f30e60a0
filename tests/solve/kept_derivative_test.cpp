/// How long the factors of one derivative serve.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "solve/newton.h"
#include "support/componentwise.h"
#include "support/dense.h"

namespace thermocontact::solve {
namespace {

using support::Componentwise;
using support::vector;

constexpr NewtonOptions options{1e-12, 50};

Eigen::MatrixXd stiffness(Eigen::Index n = 4) {
    Eigen::MatrixXd S = Eigen::MatrixXd::Constant(n, n, 0.5);
    S.diagonal().array() += Eigen::ArrayXd::LinSpaced(n, 2.5, 5.5);
    return S;
}

Eigen::VectorXd some(Eigen::Index n, unsigned seed = 1) {
    return support::as_vector(support::random_numbers(static_cast<std::size_t>(n), seed));
}

Componentwise stiffening() {
    return {[](double x) { return x * std::abs(x); }, [](double x) { return 2 * std::abs(x); }};
}

/// Handed on, the kept derivative takes the next solves the same way to the last bit.
TEST(KeptDerivative, CanBeHandedOn) {
    Componentwise F = stiffening();
    Newton newton(options);
    EXPECT_FALSE(newton.kept_derivative(stiffness())) << "nothing is kept before the first solve";
    Eigen::VectorXd x = vector({0, 0, 0, 0});
    newton.solve(stiffness(), vector({1, -2, 3, 0.5}), F, x);
    const auto kept = newton.kept_derivative(stiffness());
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->unknowns, 4);
    EXPECT_EQ(kept->entries, (std::vector<std::int64_t>{0, 5, 10, 15})) << "the diagonal";
    Newton other(options), fresh(options);
    other.take_up(stiffness(), *kept);
    fresh.take_up(Eigen::MatrixXd::Identity(3, 3), *kept);  // of another size: nothing to go on with
    EXPECT_FALSE(fresh.kept_derivative(Eigen::MatrixXd::Identity(3, 3)));
    const Eigen::VectorXd s = vector({1.1, -2, 3, 0.6});
    Eigen::VectorXd a = x, b = x, c = x;
    newton.solve(stiffness(), s, F, a);
    other.solve(stiffness(), s, F, b);
    fresh.solve(stiffness(), s, F, c);
    EXPECT_EQ(a, b);
    EXPECT_NE(a, c) << "another way to the same solution";
    EXPECT_LE((a - c).norm(), 1e-11);
}

/// What a step changes S x by is taken from the derivative (newton.h): if that were wrong, the residual would
/// be, of a step that solves the problem as no point opens or closes.
TEST(KeptDerivative, StepsWithItSayWhatTheyChange) {
    Componentwise F([](double x) { return std::max(3 * x, 0.0); },
                    [](double x) { return x > 0 ? 3.0 : 0.0; });
    Newton newton(options);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(4);
    newton.solve(stiffness(), vector({1, -2, 3, 0.5}), F, x);
    const int factorisations = newton.factorisations();
    const NewtonResult near = newton.solve(stiffness(), vector({1.1, -2, 2.9, 0.6}), F, x);
    EXPECT_EQ(near.end, NewtonEnd::converged);
    EXPECT_EQ(near.iterations, 1);
    EXPECT_EQ(newton.factorisations(), factorisations);
}

/// From deep inside a hard foundation forces of 1e10 take a step out, and of S x, of size 1, their changes
/// leave but four digits: what is found must solve the problem, not the sum of the changes.
TEST(KeptDerivative, SumsOfChangesDecideNothing) {
    constexpr double c = 1e10;
    Componentwise F([](double x) { return std::max(c * x, 0.0); }, [](double x) { return x > 0 ? c : 0.0; });
    Newton newton(options);
    const Eigen::MatrixXd S = stiffness();
    const Eigen::VectorXd s = vector({1, 2, 3, 0.5});
    for (const double depth : {0.7, 0.9, 1.1, 1.3}) {
        Eigen::VectorXd x = Eigen::VectorXd::Constant(4, depth), force;
        const NewtonResult result = newton.solve(S, s, F, x);
        ASSERT_EQ(result.end, NewtonEnd::converged);
        F.evaluate(x, force);
        const double scale = (S * x).norm() + force.norm() + s.norm();
        EXPECT_LE((S * x + force - s).norm(), options.tolerance * scale) << depth;
    }
}

/// Factors of T for S + D, both diagonal: an iteration leaves the part 1 - (S + D) / T of each component, of
/// which Broyden's updates catch up with few where all differ. Where there are few unknowns, new factors take
/// as long as few iterations.
TEST(KeptDerivative, IsKeptLongerWhereNewFactorsCostMore) {
    const auto factorisations = [](Eigen::Index n) {
        double wrong = 0.8;
        Componentwise F([](double x) { return std::tanh(x); },
                        [&](double x) { return wrong + 1 - std::pow(std::tanh(x), 2); });
        Newton newton(options);
        Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
        const Eigen::MatrixXd S = Eigen::MatrixXd::Identity(n, n);
        newton.solve(S, 1e-3 * some(n), F, x);
        wrong = 0;
        const int before = newton.factorisations();
        EXPECT_EQ(newton.solve(S, 2 * some(n, 2), F, x).end, NewtonEnd::converged) << n;
        return newton.factorisations() - before;
    };
    EXPECT_GE(factorisations(8), 1);
    EXPECT_EQ(factorisations(600), 0);
}

/// One load after another, each some way on: the iterations beyond those of the first solve add up to one for
/// every twenty unknowns, and new factors are made where they are next needed. Who takes over goes the same
/// way to the last bit, with new factors at the same loads.
TEST(KeptDerivative, IsMadeNewOnceItHasCostAsMuch) {
    constexpr Eigen::Index n = 60;
    constexpr int loads = 60, taken_over = 7;
    const Eigen::MatrixXd S = stiffness(n);
    const Eigen::VectorXd first = some(n), way = some(n, 2);
    Componentwise F = stiffening();
    Newton newton(options), other(options);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(n), y;
    int first_iterations = -1, more = 0, renewals = 0;
    for (int load = 0; load < loads; ++load) {
        const Eigen::VectorXd s = 10 * first + 0.03 * load * way;
        const int before = newton.factorisations(), before_of_other = other.factorisations();
        const NewtonResult result = newton.solve(S, s, F, x);
        ASSERT_EQ(result.end, NewtonEnd::converged) << load;
        if (load == taken_over) {
            other.take_up(S, newton.kept_derivative(S).value());
            y = x;
        } else if (load > taken_over) {
            other.solve(S, s, F, y);
            EXPECT_EQ(x, y) << load;
            EXPECT_EQ(other.factorisations() - before_of_other, newton.factorisations() - before) << load;
        }
        if (load == 0) {
            continue;
        }
        first_iterations = first_iterations < 0 ? result.iterations : first_iterations;
        more += std::max(0, result.iterations - first_iterations);
        ASSERT_EQ(newton.factorisations() - before, more > n / 20 ? 1 : 0) << load << ": " << more;
        if (more > n / 20) {
            first_iterations = -1;
            more = 0;
            ++renewals;
        }
    }
    EXPECT_GE(renewals, 2);
}

}  // namespace
}  // namespace thermocontact::solve
