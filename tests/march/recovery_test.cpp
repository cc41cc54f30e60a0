// Steps that fail as a whole, for want of Newton iterations, and what becomes of them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "error.h"
#include "march/simulation.h"
#include "support/scenes.h"

namespace thermocontact::march {
namespace {

double value(const Record& record, const std::string& name) {
    const auto entry = std::ranges::find(record, name, &Record::value_type::first);
    EXPECT_NE(entry, record.end()) << name;
    return entry == record.end() ? std::nan("") : entry->second;
}

/// A soft block thrown onto a hard foundation, friction and heat with it.
std::string thrown(int iterations, const std::string& more = "") {
    return "mesh.cells = [4, 4]\ntime = {end = 1, steps = 4" + more +
           "}\nsolver.max_iterations = " + std::to_string(iterations) +
           "\nload.body_force = [0.5, -1]\ninitial.velocity = [0.3, \"-0.5\"]\n"
           "material = {density = 1, elasticity = {young = 20, poisson = 0.1}}\n"
           "heat = {capacity = 1, conductivity = 1, thermal_stress = 0.1, strain_heating = 0.1}\n"
           "[boundary.bottom.contact]\ngap = \"0.1 + 0.05*x\"\n"
           "compliance = {stiffness = 1e4, exponent = 2}\n"
           "friction = {coefficient = 0.5, regularisation = 1e-3}\n"
           "conductance = {coefficient = 10, onset = 1e-3, foundation_temperature = 5}\n";
}

void expect_small_audits(const Simulation& simulation) {
    EXPECT_LE(simulation.totals().energy_residual, 1e-11);
    EXPECT_LE(simulation.totals().force_residual, 1e-11);
    EXPECT_LE(simulation.totals().heat_residual, 1e-11);
}

class Recovery : public testing::TestWithParam<std::string> {};

/// With too few iterations for whole steps the run completes by smaller ones, at the same output times; the
/// audits, summed over the parts, stay identities.
TEST_P(Recovery, TakesSmallerSteps) {
    const scene::Scene scene = scene::read(thrown(8, GetParam()));
    Simulation simulation(scene);
    int divided = 0;
    while (!simulation.finished()) {
        const State before = simulation.state();
        simulation.advance();
        const Record record = simulation.record();
        EXPECT_EQ(simulation.state().time, scene.time.end * simulation.state().step / scene.time.steps);
        EXPECT_EQ(simulation.state().step, before.step + 1);
        const double parts = value(record, "substeps");
        EXPECT_EQ(parts > 1, value(record, "failed_attempts") > 0);
        divided += parts > 1 ? 1 : 0;
        for (const auto& [name, number] : record) {
            EXPECT_TRUE(std::isfinite(number)) << name;
        }
    }
    EXPECT_GT(divided, 0) << "no step failed: the case tests nothing";
    EXPECT_EQ(simulation.totals().divided_steps, divided);
    EXPECT_GT(simulation.totals().parts, divided);
    EXPECT_LT(simulation.totals().smallest_step, 0.25);
    expect_small_audits(simulation);
}

INSTANTIATE_TEST_SUITE_P(Schemes, Recovery,
                         testing::Values("", ", scheme = \"bdf2\"", ", scheme = \"generalized-alpha\"",
                                         ", coupling = \"iterated\""),
                         [](const auto& info) { return "case_" + std::to_string(info.index); });

/// A block thrown to the side onto a stiff foundation: the first step's contact states recur.
constexpr const char* recurring =
    "mesh.cells = [2, 2]\ntime = {end = 1, steps = 2}\nload.body_force = [-3, -3]\n"
    "initial.velocity = [2, -2]\nmaterial = {density = 1, elasticity = {young = 100, poisson = 0.0}}\n"
    "[boundary.bottom.contact]\ncompliance = {stiffness = 1e6}\n"
    "friction = {coefficient = 0.8, regularisation = 1e-4}\n";

/// The iteration that cycles ends long before the most that it may take, continuation solves the step, and
/// history and totals say so.
TEST(Recovery, AnswersCyclesByContinuation) {
    const scene::Scene scene = scene::read("solver.max_iterations = 100000\n" + std::string(recurring));
    Simulation simulation(scene);
    double cycles = 0;
    while (!simulation.finished()) {
        simulation.advance();
        const Record record = simulation.record();
        cycles += value(record, "cycles");
        EXPECT_EQ(value(record, "cycles") > 0, value(record, "retries") > 0);
    }
    EXPECT_EQ(cycles, 1);
    EXPECT_EQ(simulation.totals().cycles, cycles);
    EXPECT_EQ(simulation.totals().failed_attempts, 0);
    EXPECT_LT(simulation.totals().iterations, 200);
    expect_small_audits(simulation);
}

/// Where even the smallest step fails, the state before the whole step is back, to the last bit.
TEST(Recovery, GivesUpAndRestores) {
    for (const char* scheme : {"backward-euler", "bdf2", "generalized-alpha"}) {
        const scene::Scene scene = scene::read(thrown(1, ", scheme = \"" + std::string(scheme) + "\""));
        Simulation simulation(scene);
        State before;
        Record norms;
        std::string message;
        while (message.empty() && !simulation.finished()) {
            before = simulation.state();
            norms = simulation.norms();
            try {
                simulation.advance();
            } catch (const NumericsError& error) {
                message = error.what();
            }
        }
        ASSERT_FALSE(message.empty()) << "nothing failed: the case tests nothing";
        for (const char* word : {"balance: Newton stopped", "; tried ", " of the step", "time.steps"}) {
            EXPECT_NE(message.find(word), std::string::npos) << message;
        }
        const State& after = simulation.state();
        EXPECT_EQ(after.step, before.step);
        EXPECT_EQ(after.time, before.time);
        EXPECT_EQ(after.last_step, before.last_step);
        EXPECT_EQ(after.displacement, before.displacement);
        EXPECT_EQ(after.velocity, before.velocity);
        EXPECT_EQ(after.temperature, before.temperature);
        EXPECT_EQ(after.displacement_rate, before.displacement_rate);
        EXPECT_EQ(after.velocity_rate, before.velocity_rate);
        EXPECT_EQ(after.temperature_rate, before.temperature_rate);
        EXPECT_EQ(simulation.norms(), norms);
    }
}

}  // namespace
}  // namespace thermocontact::march
