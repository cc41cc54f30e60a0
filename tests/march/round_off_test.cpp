// Contact so stiff that the last bit of an unknown is worth more than the tolerance.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "march/simulation.h"
#include "support/scenes.h"

namespace thermocontact::march {
namespace {

double value(const Record& record, const std::string& name) {
    const auto entry = std::ranges::find(record, name, &Record::value_type::first);
    EXPECT_NE(entry, record.end()) << name;
    return entry == record.end() ? std::nan("") : entry->second;
}

/// A square that is heated by 2 y W/m^2, 1 W/m in all, on a foundation that conducts.
std::string heated(const std::string& more, const std::string& conductance) {
    return "mesh.cells = [4, 4]\ntime = {end = 1, steps = 2}\nheat = {conductivity = 1, source = \"2*y\"" +
           more +
           "}\n"
           "[boundary.bottom.contact]\ngap = -1\nconductance = {onset = 1e-3, " +
           conductance + "}\n";
}

/// theta - theta_F = 1e-12 K, less than an ulp of theta: what stands between is found as a difference.
TEST(HeatAtRoundOff, IsSolvedForTheDifferenceToTheFoundation) {
    const scene::Scene scene = scene::read(heated("", "coefficient = 1e12, foundation_temperature = 10"));
    Simulation simulation(scene);
    while (!simulation.finished()) {
        simulation.advance();
        EXPECT_GT(value(simulation.record(), "retries"), 0) << "was not needed: the case tests nothing";
        EXPECT_NEAR(value(simulation.record(), "contact_heat_outflow"), 1.0, 1e-11);
    }
    EXPECT_EQ(simulation.totals().at_round_off, 0);
    EXPECT_LE(simulation.totals().heat_residual, 1e-11);
    for (std::size_t node = 0; node < simulation.space().nodes.size(); ++node) {
        if (simulation.space().nodes[node][1] == 0) {
            EXPECT_NEAR(simulation.state().temperature[node], 10, 1e-11);
        }
    }
}

/// Beyond the limit Newton sees nothing of the foundation, and steps across to beyond the other one: a wider
/// limit is tightened, in fewer iterations a solve than Newton alone takes (19), to the same solution.
TEST(HeatBeyondItsLimit, IsFoundByContinuation) {
    const std::string text =
        heated(", capacity = 1", "coefficient = 1e4, foundation_temperature = -1e4, limit = 1");
    const scene::Scene many = scene::read(text), few = scene::read(text + "[solver]\nmax_iterations = 6\n");
    Simulation alone(many), by_continuation(few);
    for (Simulation* simulation : {&alone, &by_continuation}) {
        simulation->advance();
        simulation->advance();
    }
    EXPECT_EQ(alone.totals().retries, 0);
    EXPECT_GT(by_continuation.totals().retries, 1) << "was not needed: the case tests nothing";
    EXPECT_EQ(by_continuation.totals().failed_attempts, 0);
    const std::vector<double>&expected = alone.state().temperature,
          &found = by_continuation.state().temperature;
    for (std::size_t node = 0; node < expected.size(); ++node) {
        EXPECT_NEAR(found[node], expected[node], 1e-12 * 1e4);
    }
}

/// Friction of stiffness mu p / epsilon: each solve that ends at round-off is counted, and none leaves more
/// than the audits allow.
TEST(FrictionAtRoundOff, IsCounted) {
    const scene::Scene scene = support::repository_scene(
        "paper-isotropic",
        {"mesh.cells=[8,8]", "time.steps=8", "boundary.bottom.contact.friction.regularisation=1e-14"});
    Simulation simulation(scene);
    double counted = 0;
    while (!simulation.finished()) {
        simulation.advance();
        counted += value(simulation.record(), "solves_at_round_off");
    }
    const Totals& totals = simulation.totals();
    EXPECT_GT(counted, 0) << "no solve ended at round-off: the case tests nothing";
    EXPECT_EQ(totals.at_round_off, counted);
    EXPECT_GT(totals.round_off_residual, scene.solver.tolerance);
    EXPECT_LE(totals.round_off_residual, 1e-8);
    EXPECT_LE(std::max({totals.force_residual, totals.energy_residual, totals.heat_residual}), 1e-8);
}

}  // namespace
}  // namespace thermocontact::march
