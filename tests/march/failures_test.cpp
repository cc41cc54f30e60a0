// Steps and scenes without solution: what is said, what is restored.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "error.h"
#include "march/simulation.h"
#include "support/scenes.h"

namespace thermocontact::march {
namespace {

std::string failure_of(Simulation& simulation) {
    try {
        simulation.advance();
        return "";
    } catch (const NumericsError& error) {
        return error.what();
    }
}

/// Scenes that fail in step 2 of 4, after a first step without contact.
struct Failing {
    std::string name, text;
    std::vector<std::string> words;  ///< of the message
};

const std::string falling = R"(
mesh.cells = [4, 4]
time.end = 1
time.steps = 4
solver.max_iterations = 1
load.body_force = [0.5, -1]
initial.velocity = [0.3, 0]
material = {density = 1, elasticity = {young = 20, poisson = 0.1}}
)";

const std::vector<Failing> failing{
    {"friction",
     "[boundary.bottom.contact]\ngap = \"t < 0.3 ? 1 : -0.1*x\"\ncompliance.stiffness = 1e4\n"
     "friction = {coefficient = 0.5, regularisation = 1e-12}\n",
     {"step 2", "t = 0.5", "momentum balance", "Newton stopped after 1 iterations",
      "too many Newton iterations", "continuation", "friction.regularisation", "time.steps",
      "solver.max_iterations"}},
    {"compliance",
     "[boundary.bottom.contact]\ngap = \"t < 0.3 ? 1 : 0.3*x\"\ncompliance = {stiffness = 1e4, exponent = "
     "2}\n",
     {"step 2", "t = 0.5", "momentum balance", "Newton stopped after 1 iterations", "time.steps"}},
    {"conductance",
     "[heat]\ncapacity = 1\nconductivity = 1\nthermal_stress = 0.1\nstrain_heating = "
     "0.1\n[boundary.bottom.contact]\ngap = -1\n"
     "conductance = {coefficient = 1e3, onset = 1e-3, foundation_temperature = \"t < 0.3 ? 0 : 10\", limit = "
     "5}\n",
     {"step 2", "t = 0.5", "heat balance", "Newton stopped after 1 iterations", "time.steps"}},
    {"not_finite",
     "boundary.left.traction = [\"t < 0.3 ? 0 : 1e308*10\", 0]\n",
     {"1e308*10", "t = 0.5", "finite"}},
    {"not_finite_at_the_end",  // of the step: found when its stage is solved and accepted
     "time.scheme = \"midpoint\"\n[boundary.bottom.contact]\ngap = \"t < 0.4 ? 1 : 1e308*10\"\n"
     "compliance.stiffness = 1e4\n",
     {"1e308*10", "t = 0.5", "finite"}}};

class Failures : public testing::TestWithParam<Failing> {};

TEST_P(Failures, RestoreTheStateAndSayWhatHappened) {
    const scene::Scene scene = scene::read(falling + GetParam().text);
    Simulation simulation(scene);
    simulation.advance();
    const State before = simulation.state();
    const auto measures_before = simulation.contact_measures();
    const Record norms_before = simulation.norms(), record_before = simulation.record();
    const Totals totals_before = simulation.totals();
    const std::string message = failure_of(simulation);
    for (const std::string& word : GetParam().words) {
        EXPECT_NE(message.find(word), std::string::npos) << "\"" << word << "\" is not in: " << message;
    }
    const State& after = simulation.state();
    EXPECT_EQ(after.step, before.step);
    EXPECT_EQ(after.time, before.time);
    EXPECT_EQ(after.displacement, before.displacement);
    EXPECT_EQ(after.velocity, before.velocity);
    EXPECT_EQ(after.temperature, before.temperature);
    EXPECT_EQ(after.last_step, before.last_step);
    EXPECT_EQ(after.displacement_rate, before.displacement_rate);
    EXPECT_EQ(after.velocity_rate, before.velocity_rate);
    EXPECT_EQ(after.temperature_rate, before.temperature_rate);
    EXPECT_EQ(simulation.norms(), norms_before);
    EXPECT_EQ(simulation.record(), record_before) << "the history's row of the state";
    EXPECT_EQ(simulation.totals().energy_residual, totals_before.energy_residual);
    EXPECT_EQ(simulation.totals().force_residual, totals_before.force_residual);
    EXPECT_EQ(simulation.totals().iterations, totals_before.iterations);
    for (const auto& [name, measures] : simulation.contact_measures()) {
        EXPECT_EQ(measures.normal_force, measures_before.at(name).normal_force);
        EXPECT_EQ(measures.max_penetration, measures_before.at(name).max_penetration);
        EXPECT_EQ(measures.heat_flow, measures_before.at(name).heat_flow);
    }
    // a second try starts from the same state; Newton's path may differ, for it keeps factors
    EXPECT_EQ(failure_of(simulation).substr(0, 40), message.substr(0, 40));
    EXPECT_EQ(simulation.state().velocity, before.velocity);
}

INSTANTIATE_TEST_SUITE_P(Laws, Failures, testing::ValuesIn(failing),
                         [](const auto& info) { return info.param.name; });

struct Singular {
    std::string name, text, equation, cure;
};

class SingularScenes : public testing::TestWithParam<Singular> {};

TEST_P(SingularScenes, AreRefusedBeforeTheFirstStep) {
    const scene::Scene scene =
        scene::read("mesh.cells = [3, 3]\ntime = {end = 1, steps = 2}\n" + GetParam().text);
    try {
        Simulation simulation(scene);
        FAIL() << "no exception";
    } catch (const NumericsError& error) {
        EXPECT_NE(std::string(error.what()).find(GetParam().equation), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("singular"), std::string::npos) << error.what();
    }
    const scene::Scene cured =
        scene::read("mesh.cells = [3, 3]\ntime = {end = 1, steps = 2}\n" + GetParam().text + GetParam().cure);
    EXPECT_NO_THROW(Simulation(cured).advance());
}

INSTANTIATE_TEST_SUITE_P(
    Bodies, SingularScenes,
    testing::Values(Singular{"loose_body", "material.elasticity = {young = 1, poisson = 0.1}\n",
                             "momentum balance", "material.density = 1\n"},
                    Singular{"body_on_a_roller",
                             "material.elasticity = {young = 1, poisson = 0.1}\n"
                             "boundary.top.displacement = [\"free\", 0]\n",
                             "momentum balance", "boundary.left.displacement = [0, \"free\"]\n"},
                    Singular{"insulated_body", "heat.conductivity = 1\n", "heat balance",
                             "heat.capacity = 1\n"}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace thermocontact::march
