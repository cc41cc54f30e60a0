// Steps that adapt to time.tolerance.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "march/simulation.h"
#include "march/step_error.h"
#include "support/scenes.h"

namespace thermocontact::march {
namespace {

scene::TimeSpec time_of(std::optional<double> radius) {
    scene::TimeSpec time{1.0, 1, ""};
    time.spectral_radius = radius;
    time.tolerance = 1e-3;
    return time;
}

/// y = t^power on steps that change, from exact rates: what the estimate says of the last step.
double estimated(std::optional<double> radius, int power, const std::vector<double>& steps) {
    const Scheme scheme(time_of(radius));
    const parallel::Alone alone;
    const auto y = [&](double t) { return std::pow(t, power); };
    double t = 1, last = 0, lag = 0, estimate = 0;
    std::vector<double> q, curvature;
    for (const double k : steps) {
        const StepRule rule = scheme.rule(t, t + k, k, last);
        const StepError error = step_error(rule, lag, {y(t)}, {y(t + k)}, q, curvature);
        EXPECT_EQ(error.size, y(t + k));
        estimate = error.error;
        renew_rates(scheme, rule, {y(t)}, {y(t + k)}, q, curvature);
        lag = scheme.carries_curvature() && rule.lag >= 0 ? curvature_lag(rule) : 0;
        last = k;
        t += k;
    }
    return estimate;
}

/// The rates of bdf2 and backward Euler are mean rates of single steps: y" is exact for parabolas whatever
/// the steps, y"' for cubics on equal steps.
TEST(StepError, IsThatOfTheScheme) {
    const double k = 0.1;
    const std::vector<double> equal(4, k), changing{0.1, 0.1, 0.2, 0.1};
    EXPECT_NEAR(estimated(std::nullopt, 1, changing), 0.0, 1e-13);
    EXPECT_NEAR(estimated(std::nullopt, 2, changing), k * k / 2 * 2, 1e-13);
    EXPECT_NEAR(estimated(0.0, 2, changing), 0.0, 1e-13);
    EXPECT_NEAR(estimated(0.0, 3, equal), 2.0 / 9 * k * k * k * 6, 1e-13);
    EXPECT_NEAR(estimated(0.0, 3, changing) / estimated(0.0, 3, equal), 1.0, 0.2);
}

/// A slab that a sudden heat flux and then a sudden load meet.
std::string sudden(double tolerance, const std::string& scheme) {
    return "mesh = {cells = [2, 6]}\ntime = {end = 2, steps = 4, scheme = \"" + scheme +
           "\", tolerance = " + std::to_string(tolerance) +
           "}\n"
           "material = {density = 1, elasticity = {young = 5, poisson = 0.2}, viscosity = {trace = 1, shear "
           "= 1}}\n"
           "heat = {capacity = 1, conductivity = 1, thermal_stress = 0.2, strain_heating = 0.2}\n"
           "boundary.top = {displacement = [0, 0], temperature = 0}\n"
           "boundary.bottom = {heat_flux = 1, traction = [0, \"t > 1 ? 1 : 0\"]}\n";
}

struct Course {
    State state;
    Totals totals;
    std::vector<AcceptedPart> parts;
};

Course march(const std::string& text) {
    const scene::Scene scene = scene::read(text);
    Simulation simulation(scene);
    Course course;
    while (!simulation.finished()) {
        simulation.advance();
        EXPECT_EQ(simulation.state().time, scene.time.end * simulation.state().step / scene.time.steps);
        course.parts.insert(course.parts.end(), simulation.parts().begin(), simulation.parts().end());
    }
    course.state = simulation.state();
    course.totals = simulation.totals();
    return course;
}

double difference(const std::vector<double>& a, const std::vector<double>& b) {
    double largest = 0, size = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        largest = std::max(largest, std::abs(a[i] - b[i]));
        size = std::max(size, std::abs(b[i]));
    }
    return largest / size;
}

class Adaptive : public testing::TestWithParam<std::string> {};

TEST_P(Adaptive, StepsAreShortAfterSuddenLoadsAndLongElsewhere) {
    const Course course = march(sudden(1e-2, GetParam()));
    double reached = 0, before_jump = 0, after_jump = 1;
    for (const AcceptedPart& part : course.parts) {
        EXPECT_NEAR(part.end - part.length, reached, 1e-14);
        reached = part.end;
        if (part.end <= 1) {
            before_jump = part.length;
        } else if (part.end <= 1.1) {
            after_jump = std::min(after_jump, part.length);
        }
    }
    EXPECT_EQ(reached, 2.0);
    EXPECT_EQ(course.parts.front().length, 0.5 / 256);
    EXPECT_GE(before_jump, 8 * after_jump);
    EXPECT_GT(course.totals.rejections, 0) << "nothing was rejected: the case tests little";
    EXPECT_EQ(course.totals.steps, static_cast<int>(course.parts.size()));
    // rejected steps leave no trace in the balances
    EXPECT_LE(course.totals.energy_residual, 1e-11);
    EXPECT_LE(course.totals.force_residual, 1e-11);
    EXPECT_LE(course.totals.heat_residual, 1e-11);
}

/// The error follows the tolerance, and is reached in fewer steps than equal ones as short take.
TEST_P(Adaptive, ErrorFollowsTheTolerance) {
    const Course exact = march(sudden(1e-5, GetParam())), coarse = march(sudden(1e-2, GetParam())),
                 fine = march(sudden(1e-3, GetParam()));
    const double of_coarse = difference(coarse.state.velocity, exact.state.velocity),
                 of_fine = difference(fine.state.velocity, exact.state.velocity);
    EXPECT_LT(of_fine, of_coarse / 2);
    EXPECT_LT(difference(fine.state.temperature, exact.state.temperature), 1e-2);
    EXPECT_LT(coarse.totals.steps, fine.totals.steps);
    EXPECT_LT(fine.totals.steps, 2.0 / fine.totals.smallest_step / 2);
}

INSTANTIATE_TEST_SUITE_P(Schemes, Adaptive, testing::Values("backward-euler", "bdf2", "generalized-alpha"),
                         [](const auto& info) { return "scheme_" + std::to_string(info.index); });

}  // namespace
}  // namespace thermocontact::march
