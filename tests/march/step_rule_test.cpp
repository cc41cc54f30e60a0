#include "march/step_rule.h"

#include <gtest/gtest.h>

#include <cmath>

namespace thermocontact::march {
namespace {

scene::TimeSpec with_radius(std::optional<double> radius) {
    scene::TimeSpec time{1.0, 1, ""};
    time.spectral_radius = radius;
    return time;
}

constexpr double k = 0.125;

TEST(StepRule, OfBackwardEulerHasNoMemory) {
    const Scheme scheme(with_radius(std::nullopt));
    EXPECT_FALSE(scheme.carries_rates());
    for (const double last : {0.0, k}) {
        const StepRule rule = scheme.rule(1, 1 + k, k, last);
        EXPECT_EQ(rule.tau, k);
        EXPECT_EQ(rule.memory(), 0.0);
        EXPECT_EQ(rule.stage_time(), 1 + k);
        EXPECT_EQ(rule.completed(3, 5), 5.0);
    }
}

TEST(StepRule, WithoutRatesIsBackwardEuler) {
    for (const double radius : {0.0, 0.5, 1.0}) {
        const StepRule rule = Scheme(with_radius(radius)).rule(1, 1 + k, k, 0);
        EXPECT_EQ(rule.tau, k);
        EXPECT_EQ(rule.memory(), 0.0);
        EXPECT_EQ(rule.alpha, 1.0);
    }
}

TEST(StepRule, OfTheMidpointRule) {
    for (const double last : {k, k / 4, 2 * k}) {
        const StepRule rule = Scheme(with_radius(1.0)).rule(0, k, k, last);
        EXPECT_EQ(rule.tau, k / 2);
        EXPECT_EQ(rule.memory(), 0.0);
        EXPECT_EQ(rule.stage_time(), k / 2);
    }
}

/// y'(t_n) = [(1 + 2 w)/(1 + w) y_n - (1 + w) y_{n-1} + w^2/(1 + w) y_{n-2}]/k_n, w = k_n/k_{n-1}
TEST(StepRule, WithRadiusZeroIsBdf2OnVariableSteps) {
    for (const double last : {k, k / 2, 2 * k}) {
        const double w = k / last, y[3] = {0.3, -0.7, 1.9};  // oldest first
        const StepRule rule = Scheme(with_radius(0.0)).rule(0, k, k, last);
        EXPECT_EQ(rule.alpha, 1.0);
        const double q = (y[1] - y[0]) / last, base = y[1] + rule.memory() * q;
        const double rate = ((1 + 2 * w) / (1 + w) * y[2] - (1 + w) * y[1] + w * w / (1 + w) * y[0]) / k;
        EXPECT_NEAR((y[2] - base) / rule.tau, rate, 1e-14 * std::abs(rate) * 10);
        std::vector<double> next{q};
        renew_rate(rule, {y[1]}, {y[2]}, next);
        EXPECT_NEAR(next[0], (y[2] - y[1]) / k, 1e-13);
    }
}

/// On equal steps, in the variables of Jansen, Whiting and Hulbert: r = q + alpha_m (q_new - q),
/// y_s = y + alpha_f (y_new - y), y_new = y + k ((1 - gamma) q + gamma q_new).
TEST(StepRule, IsGeneralisedAlphaOnEqualSteps) {
    for (const double rho : {0.0, 0.3, 0.5, 0.9, 1.0}) {
        const double alpha_m = 0.5 * (3 - rho) / (1 + rho), alpha_f = 1 / (1 + rho),
                     gamma = 0.5 + alpha_m - alpha_f;
        const double y = 0.4, q = -1.3, r = 2.1;
        const double q_new = q + (r - q) / alpha_m, y_new = y + k * ((1 - gamma) * q + gamma * q_new);
        const StepRule rule = Scheme(with_radius(rho)).rule(0, k, k, k);
        const double stage = y + rule.memory() * q + rule.tau * r;
        EXPECT_NEAR(stage, y + alpha_f * (y_new - y), 1e-14);
        EXPECT_NEAR(rule.completed(y, stage), y_new, 1e-14);
        std::vector<double> next{q};
        renew_rate(rule, {y}, {y_new}, next);
        EXPECT_NEAR(next[0], q_new, 1e-13);
    }
}

/// y' = -y by any scheme on steps that change: the error falls with the square of the step, and a second
/// order scheme is exact for a parabola once its rates are.
double error_at_one(double rho, int steps) {
    const Scheme scheme(with_radius(rho));
    double t = 0, y = 1, last = 0;
    std::vector<double> q{0.0};
    for (int i = 0; i < steps; ++i) {
        const double pattern[4] = {1, 0.5, 0.5, 2};
        const double step = pattern[i % 4] / steps;
        const StepRule rule = scheme.rule(t, t + step, step, last);
        const double base = y + rule.memory() * q[0], stage = base / (1 + rule.tau);
        const double next = rule.completed(y, stage);
        renew_rate(rule, {y}, {next}, q);
        y = next;
        t += step;
        last = step;
    }
    return std::abs(y - std::exp(-t));
}

TEST(StepRule, IsOfSecondOrderOnStepsThatChange) {
    for (const double rho : {0.0, 0.5, 1.0}) {
        const double order = std::log2(error_at_one(rho, 512) / error_at_one(rho, 1024));
        EXPECT_NEAR(order, 2.0, 0.1) << "rho = " << rho;
    }
    EXPECT_NEAR(std::log2(error_at_one(0.5, 512) / error_at_one(0.5, 1024)), 2.0, 0.1);
}

/// y' = -y/0 (infinitely fast): what is left of a perturbation after a step is rho of it.
TEST(StepRule, DampsFastMotionsByTheSpectralRadius) {
    for (const double rho : {0.0, 0.25, 0.5, 1.0}) {
        const StepRule rule = Scheme(with_radius(rho)).rule(0, 1, 1, 1);
        // stage value 0 whatever came before; y and q are multiplied by a triangular matrix
        const double of_y = rule.completed(1, 0);
        std::vector<double> q{1.0};
        renew_rate(rule, {0.0}, {0.0}, q);
        EXPECT_NEAR(std::max(std::abs(of_y), std::abs(q[0])), rho, 1e-15);
    }
}

}  // namespace
}  // namespace thermocontact::march
