// The estimate against the error that a step really makes, and what is done about it.

#include "march/step_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "march/step_control.h"

namespace thermocontact::march {
namespace {

scene::TimeSpec time_of(std::optional<double> radius) {
    scene::TimeSpec time{1.0, 1, ""};
    time.spectral_radius = radius;
    time.tolerance = 1e-3;
    return time;
}

/// Estimate and true local error of the last of equal steps for y' = a y, y(0) = 1. The steps before start
/// from exact values, too, so that the memory is that of exact values; what the first one gets wrong decays
/// by rho a step.
struct LastStep {
    double estimate, truth;
};

LastStep last_step(std::optional<double> radius, double k, int steps) {
    const double a = -0.8;
    const Scheme scheme(time_of(radius));
    const auto exact = [&](double t) { return std::exp(a * t); };
    std::vector<double> q, curvature;
    double last = 0, lag = 0;
    LastStep result{};
    for (int n = 0; n < steps; ++n) {
        const double t = n * k;
        const StepRule rule = scheme.rule(t, t + k, k, last);
        const auto advanced = [&](double y) {
            const double base = y + (q.empty() ? 0.0 : rule.memory() * q[0]);
            return rule.completed(y, base / (1 - a * rule.tau));
        };
        const std::vector<double> y{exact(t)}, y_new{advanced(y[0])}, y_exact{exact(t + k)};
        const auto estimate = error_estimate(rule, lag, y, y_exact, q, curvature);
        EXPECT_EQ(estimate.empty(), n == 0);
        result = {estimate.empty() ? 0.0 : std::abs(estimate[0]), std::abs(y_new[0] - y_exact[0])};
        renew_rates(scheme, rule, y, y_exact, q, curvature);
        lag = curvature_lag(scheme, rule);
        last = k;
    }
    return result;
}

class Estimate : public testing::TestWithParam<std::optional<double>> {};

/// The ratio tends to 1 with k.
TEST_P(Estimate, IsTheErrorThatAStepMakes) {
    double before = 1;
    for (const double k : {0.04, 0.02, 0.01}) {
        const LastStep step = last_step(GetParam(), k, 120);
        ASSERT_GT(step.truth, 1e-10) << "above round-off";
        const double off = std::abs(step.estimate / step.truth - 1);
        EXPECT_LT(off, 3 * k);
        EXPECT_LT(off, 0.6 * before);
        before = off;
    }
}

INSTANTIATE_TEST_SUITE_P(Schemes, Estimate,
                         testing::Values(std::nullopt, std::optional(0.0), std::optional(0.3),
                                         std::optional(0.5), std::optional(0.8)),
                         [](const auto& info) { return "scheme_" + std::to_string(info.index); });

TEST(ErrorConstant, IsThatOfTheKnownSchemes) {
    EXPECT_NEAR(error_constant(1.0), 2.0 / 9, 1e-15) << "bdf2";
    EXPECT_NEAR(error_constant(0.5), 1.0 / 12, 1e-15) << "midpoint";
    EXPECT_NEAR(error_constant(2.0 / 3), 4.0 / 45, 1e-15);
}

/// Of backward Euler y" is that of the parabola through three values, whatever the steps.
TEST(ErrorEstimate, IsExactForParabolasOnUnequalSteps) {
    const Scheme scheme(time_of(std::nullopt));
    std::vector<double> q, none, estimate;
    double t = 1, last = 0;
    for (const double k : {0.1, 0.3, 0.05}) {
        const StepRule rule = scheme.rule(t, t + k, k, last);
        estimate = error_estimate(rule, 0, {t * t}, {(t + k) * (t + k)}, q, none);
        if (last > 0) {
            EXPECT_NEAR(estimate.at(0), k * k / 2 * 2, 1e-14);
        }
        renew_rates(scheme, rule, {t * t}, {(t + k) * (t + k)}, q, none);
        last = k;
        t += k;
    }
    EXPECT_TRUE(none.empty());
}

/// Of bdf2 y"' is exact for cubics on equal steps. Where the last two sizes are k and 2k after k, y" holds at
/// -k/3 and -5k/3 from the step's begin and is taken to hold at -k/4 and -7k/4: 8/9 of y"'.
TEST(ErrorEstimate, OfCubicsOnUnequalSteps) {
    const Scheme scheme(time_of(0.0));
    const auto y = [](double t) { return std::vector<double>{t * t * t}; };
    for (const auto& [sizes, share] : std::map<std::vector<double>, double>{
             {{0.1, 0.1, 0.1, 0.1}, 1.0}, {{0.1, 0.1, 0.2, 0.1}, 8.0 / 9}}) {
        std::vector<double> q, curvature, estimate;
        double t = 1, last = 0, lag = 0;
        for (const double k : sizes) {
            const StepRule rule = scheme.rule(t, t + k, k, last);
            estimate = error_estimate(rule, lag, y(t), y(t + k), q, curvature);
            renew_rates(scheme, rule, y(t), y(t + k), q, curvature);
            lag = curvature_lag(scheme, rule);
            last = k;
            t += k;
        }
        EXPECT_NEAR(estimate.at(0), share * 2.0 / 9 * 1e-3 * 6, 1e-14);
    }
}

TEST(StepControl, GoesDownByAsManyRungsAsItTakes) {
    const StepControl control{1e-3};
    EXPECT_TRUE(control.accepts(1e-3));
    EXPECT_FALSE(control.accepts(1.001e-3));
    const double aim = StepControl::safety * 1e-3;
    for (const int order : {1, 2}) {
        const double halved = std::pow(2.0, order + 1);
        EXPECT_EQ(control.down(1.001e-3, order), 1) << "at least";
        EXPECT_EQ(control.down(0.99 * aim * halved, order), 1);
        EXPECT_EQ(control.down(1.01 * aim * halved, order), 2);
        EXPECT_EQ(control.down(0.99 * aim * std::pow(halved, 5), order), 5);
    }
}

TEST(StepControl, GoesUpWhenItMayAndHasWaited) {
    const StepControl control{1e-3};
    const double aim = StepControl::safety * 1e-3;
    for (const int order : {1, 2}) {
        const double doubled = std::pow(2.0, order + 1);
        EXPECT_EQ(control.up(1.01 * aim / doubled, order, 100), 0);
        EXPECT_EQ(control.up(0.99 * aim / doubled, order, 100), 1);
        EXPECT_EQ(control.up(0.99 * aim / doubled, order, StepControl::patience - 1), 0);
        EXPECT_EQ(control.up(0.99 * aim / std::pow(doubled, 3), order, StepControl::patience), 3);
        EXPECT_GT(control.up(0.0, order, StepControl::patience), 8) << "the ladder is the limit";
    }
}

}  // namespace
}  // namespace thermocontact::march
