// Springs that hold sides: what they do to a body in a step, what they store, and who moves their far ends.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "error.h"
#include "march/simulation.h"
#include "support/scenes.h"

namespace thermocontact::march {
namespace {

double value(const Record& record, const std::string& name) {
    return std::ranges::find(record, name, &Record::value_type::first)->second;
}

const std::string bar = R"(
mesh = {upper = [2.0, 0.5], cells = [4, 2]}
time.end = 1
time.steps = 4
material.elasticity = {young = 200, poisson = 0}
boundary.bottom.displacement = ["free", 0.0]
)";

/// A bar between a spring and a load: u = f/k_s + f x/E, and the spring holds f H.
TEST(Springs, HoldAPulledBar) {
    const scene::Scene scene = scene::read(bar + R"(
boundary.right.traction = [3.0, 0.0]
boundary.left.spring.stiffness = 40
)");
    Simulation simulation(scene);
    simulation.advance();
    for (std::size_t i = 0; i < simulation.space().nodes.size(); ++i) {
        const double x = simulation.space().nodes[i][0];
        EXPECT_NEAR(simulation.state().displacement[2 * i], 3.0 / 40 + 3.0 * x / 200, 1e-13);
    }
    const Record record = simulation.record();
    EXPECT_NEAR(value(record, "spring_force_x"), 1.5, 1e-12);
    EXPECT_NEAR(value(record, "spring_energy"), 0.5 * 0.5 * 3.0 * 3.0 / 40, 1e-13);
    EXPECT_EQ(value(record, "anchor_work"), 0.0);
    EXPECT_LE(simulation.totals().energy_residual, 1e-13);
    EXPECT_LE(simulation.totals().force_residual, 1e-13);
}

/// Drawn from its far end against another spring: two springs and the bar in series. The far end is taken
/// at the end of each step, where the force is; its work is what is stored and what the scheme dissipates.
TEST(Springs, FollowTheirFarEnds) {
    const scene::Scene scene = scene::read(bar + R"(
boundary.left.spring.stiffness = 40
boundary.right.spring = {stiffness = [[60.0, 0.0], [0.0, 0.0]], anchor = ["0.2*t^2", 0.0]}
)");
    Simulation simulation(scene);
    const double flexibility = (1.0 / 40 + 2.0 / 200 + 1.0 / 60) / 0.5;  // m/N
    double work = 0, dissipated = 0, before = 0;
    for (int step = 1; step <= 4; ++step) {
        simulation.advance();
        const double t = step / 4.0, end = 0.2 * t * t, force = end / flexibility;
        const Record record = simulation.record();
        EXPECT_NEAR(value(record, "spring_force_x"), 0.0, 1e-12) << "one pulls as the other";
        EXPECT_NEAR(value(record, "spring_energy"), 0.5 * force * force * (1.0 / 40 + 1.0 / 60) / 0.5, 1e-12);
        EXPECT_NEAR(value(record, "anchor_work"), force * (end - before), 1e-12);
        work += value(record, "anchor_work");
        dissipated +=
            value(record, "spring_numerical_dissipation") + value(record, "strain_numerical_dissipation");
        EXPECT_NEAR(value(record, "spring_energy") + value(record, "strain_energy") + dissipated, work,
                    1e-12);
        before = end;
    }
    EXPECT_LE(simulation.totals().energy_residual, 1e-13);
}

/// The far ends are those of the stage: without inertia and viscosity the stage of the midpoint rule has them
/// in the middle of the step, and the next stage follows by what the scheme keeps.
TEST(Springs, TakeTheirFarEndsAtTheStage) {
    for (const char* scheme : {"midpoint", "bdf2", "generalized-alpha"}) {
        const scene::Scene scene = scene::read(bar + "time.scheme = \"" + scheme + R"("
material.density = 1e-9
boundary.left.spring = {stiffness = 40, anchor = ["0.4*t", 0.0]}
)");
        Simulation simulation(scene);
        while (!simulation.finished()) {
            simulation.advance();
            for (std::size_t i = 0; i < simulation.state().displacement.size(); i += 2) {
                EXPECT_NEAR(simulation.state().displacement[i], 0.4 * simulation.state().time, 1e-7)
                    << scheme;
            }
        }
    }
}

/// Every term is there and the balance closes, whatever the scheme, with far ends that wander along the side
/// and differ at the corner that two springs share.
TEST(Springs, BalanceInEveryScheme) {
    for (const char* scheme : {"backward-euler", "bdf2", "midpoint", "generalized-alpha"}) {
        const scene::Scene scene = support::repository_scene(
            "anisotropic", {"mesh.cells=[5,4]", std::string("time.scheme=\"") + scheme + "\"",
                            "boundary.left.spring.stiffness=[[30,10],[10,20]]",
                            "boundary.left.spring.anchor=[\"0.1*sin(9*t)*y\",\"0.2 - t\"]",
                            "boundary.bottom.spring={stiffness=5.0,anchor=[\"-t\",0.1]}"});
        Simulation simulation(scene);
        std::map<std::string, double> largest;
        while (!simulation.finished()) {
            simulation.advance();
            for (const char* name : {"spring_energy", "anchor_work", "spring_force_x", "spring_force_y",
                                     "spring_numerical_dissipation"}) {
                largest[name] = std::max(largest[name], std::abs(value(simulation.record(), name)));
            }
        }
        for (const auto& [name, term] : largest) {
            EXPECT_GT(term, 1e-6) << name << " is not in play, " << scheme;
        }
        EXPECT_LE(simulation.totals().energy_residual, 1e-11) << scheme;
        EXPECT_LE(simulation.totals().force_residual, 1e-11) << scheme;
    }
}

/// Nothing but the springs holds the body; with a spring that leaves a direction it is not taken for held.
TEST(Springs, HoldABodyWithoutInertia) {
    const std::string free = R"(
mesh.cells = [3, 2]
time = {end = 1, steps = 1}
material.elasticity = {young = 7, poisson = 0.3}
load.body_force = [1.0, -2.0]
)";
    const scene::Scene scene = scene::read(free + "boundary.left.spring.stiffness = 4\n");
    Simulation simulation(scene);
    simulation.advance();
    EXPECT_NEAR(value(simulation.record(), "spring_force_x"), 1.0, 1e-11);
    EXPECT_NEAR(value(simulation.record(), "spring_force_y"), -2.0, 1e-11);
    const scene::Scene loose =
        scene::read(free + "boundary.left.spring.stiffness = [[4.0, 0.0], [0.0, 0.0]]\n");
    try {
        const Simulation refused(loose);
        ADD_FAILURE() << "a singular system was taken for a regular one";
    } catch (const NumericsError& error) {
        EXPECT_NE(std::string(error.what()).find("free to move along y"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("spring"), std::string::npos) << error.what();
    }
}

/// Where nothing is prescribed beside, the reaction is that of the spring, too.
TEST(Springs, PullAtPrescribedSides) {
    const scene::Scene scene = scene::read(bar + R"(
boundary.left.displacement = [0.01, "free"]
boundary.left.spring = {stiffness = [[40.0, 0.0], [0.0, 40.0]], anchor = [0.03, 0.0]}
)");
    Simulation simulation(scene);
    simulation.advance();
    const Record record = simulation.record();
    EXPECT_NEAR(value(record, "spring_force_x"), 0.5 * 40 * (0.01 - 0.03), 1e-12);
    EXPECT_NEAR(value(record, "reaction_force_x"), 0.5 * 40 * (0.01 - 0.03), 1e-12);
    EXPECT_LE(simulation.totals().force_residual, 1e-13);
    EXPECT_LE(simulation.totals().energy_residual, 1e-13);
}

}  // namespace
}  // namespace thermocontact::march
