// Steps whose balances show that they are not solved, and bodies at rest whose balances round-off outweighs.

#include <gtest/gtest.h>

#include <algorithm>

#include "error.h"
#include "march/audit_limit.h"
#include "march/simulation.h"
#include "support/scenes.h"

namespace thermocontact::march {
namespace {

/// A body so stiff, turned so far, that rounding its displacement is worth a tenth of its weight: linear
/// strain of (-y, x) is zero, and K u sums up to 2^-53 |K| |u| of 1e14 N/m instead. The step
/// is so short that inertia, 1/tau, is not lost beside that.
std::string turned(const std::string& time) {
    return "mesh.cells = [4, 4]\ntime = {end = 0.02, steps = 2" + time +
           "}\nload.body_force = [0, -1]\ninitial.displacement = [\"0.3 - 1.1*y\", \"1.1*x - 0.7\"]\n"
           "material = {density = 1, elasticity = {young = 1e14, poisson = 0.3}}\n";
}

class Unkept : public testing::TestWithParam<std::string> {};

/// Newton's method has nothing to object to, as there is no contact; the balance of forces has.
TEST_P(Unkept, StopsAndRestores) {
    const scene::Scene scene = scene::read(turned(GetParam()));
    Simulation simulation(scene);
    const State before = simulation.state();
    std::string message;
    try {
        simulation.advance();
    } catch (const NumericsError& error) {
        message = error.what();
    }
    ASSERT_FALSE(message.empty()) << "force audit " << simulation.totals().force_residual;
    for (const char* word : {"step 1", "momentum balance: the solution keeps the balance of", "of its terms",
                             "digits", "material.density", "try more time.steps", "times, down to 1/256"}) {
        EXPECT_NE(message.find(word), std::string::npos) << word << " in: " << message;
    }
    const State& after = simulation.state();
    EXPECT_EQ(after.step, 0);
    EXPECT_EQ(after.time, 0);
    EXPECT_EQ(after.last_step, before.last_step);
    EXPECT_EQ(after.displacement, before.displacement);
    EXPECT_EQ(after.velocity, before.velocity);
    EXPECT_EQ(after.displacement_rate, before.displacement_rate);
    EXPECT_EQ(simulation.totals().force_residual, 0) << "of steps that were taken";
}

INSTANTIATE_TEST_SUITE_P(Schemes, Unkept,
                         testing::Values("", ", scheme = \"bdf2\"", ", scheme = \"generalized-alpha\"",
                                         ", scheme = \"bdf2\", tolerance = 1e-2"),
                         [](const auto& info) { return "case_" + std::to_string(info.index); });

/// What a loose tolerance leaves is no failure.
TEST(AuditLimit, FollowsTheTolerance) {
    EXPECT_DOUBLE_EQ(audit_limit(1e-14), least_audit);
    EXPECT_DOUBLE_EQ(audit_limit(1e-12), 1e-8);
    EXPECT_DOUBLE_EQ(audit_limit(1e-6), 1e-2);
}

/// 1e9 Pa, 1.4 m from where it was meshed: the last bit of a displacement is worth more energy than 1e-8 of
/// what its weight makes, and the sum of K u, which is round-off, times 1.4 m even more.
TEST(AtRest, AStiffBodyFarAwayIsNoFailure) {
    const scene::Scene scene = scene::read(
        "mesh.cells = [4, 4]\ntime = {end = 1, steps = 8}\nload.body_force = [0, -0.1]\n"
        "initial.displacement = [1.4, 0]\n"
        "material = {density = 1, elasticity = {young = 1e9, poisson = 0.3}, "
        "viscosity = {trace = 1e6, shear = 1e6}}\n"
        "[boundary.bottom.contact]\ncompliance = {stiffness = 1e9}\n"
        "friction = {coefficient = 0.5, regularisation = 1e-3}\n");
    Simulation simulation(scene);
    while (!simulation.finished()) {
        simulation.advance();
    }
    EXPECT_LE(simulation.totals().energy_residual, 1e-8);
    EXPECT_LE(simulation.totals().force_residual, 1e-8);
}

/// A foundation of 1e10 W/m^2 K cools the lowest cells within microseconds: c theta/tau is 1e9 W/m, what
/// flows by then a few, and the last bits of c theta/tau are worth 1e-7 of that.
TEST(AtRest, HeatThatFlowsNoMoreIsNoFailure) {
    const scene::Scene scene = scene::read(
        "mesh.cells = [4, 4]\ntime = {end = 1.506779874025787e-05, steps = 8}\n"
        "load.body_force = [0, -1]\n"
        "material = {density = 112.4, elasticity = {young = 7.5e-06, poisson = 0.34, plane = \"strain\"}, "
        "viscosity = {trace = 1.1e5, shear = 1.1e5}}\n"
        "heat = {capacity = 1, conductivity = 2.87e-06, source = 1, "
        "thermal_stress = [[0.0026, 0.0026], [0.0026, 0.0026]]}\n"
        "boundary.top.displacement = [0, 0]\n"
        "boundary.left = {traction = [1.4, 0.4], temperature = 0}\n"
        "boundary.right = {traction = [-0.8, 0.4], temperature = 0}\n"
        "[boundary.bottom.contact]\ncompliance = {stiffness = 0.019}\n"
        "conductance = {coefficient = 8880863901, onset = 7.79e-11, foundation_temperature = -4828.7, "
        "limit = 1389.75}\n");
    Simulation simulation(scene);
    while (!simulation.finished()) {
        simulation.advance();
    }
    EXPECT_LE(simulation.totals().heat_residual, 1e-8);
}

}  // namespace
}  // namespace thermocontact::march
