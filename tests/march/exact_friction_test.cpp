// Coulomb's law itself, friction.regularisation = 0.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "march/simulation.h"
#include "support/rows.h"
#include "support/scenes.h"

namespace thermocontact::march {
namespace {

const std::string exact = "boundary.bottom.contact.friction.regularisation=0";

using support::largest;
using support::value;

double distance(const std::vector<double>& a, const std::vector<double>& b) {
    double result = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        result = std::max(result, std::abs(a[i] - b[i]));
    }
    return result;
}

/// tan(alpha) < mu. Velocities are good to the solver's 1e-12 of what gravity would add in a step, g k.
TEST(ExactFriction, ABlockOnASlopeRests) {
    const scene::Scene scene = support::repository_scene("benchmarks/slope-creep", {exact});
    Simulation simulation(scene);
    while (!simulation.finished()) {
        simulation.advance();
    }
    const double gk = 9.81 * scene.time.end / scene.time.steps;
    EXPECT_LE(largest(simulation.state().velocity), 1e-12 * gk);
    const model::ContactMeasures measures = simulation.contact_measures().at("bottom");
    EXPECT_EQ(measures.slip_fraction, 0.0);
    const double weight = 2.0 * 9.81;  // density 2, area 1
    EXPECT_NEAR(measures.tangential_force, weight * std::sin(std::atan(0.2)), 1e-9 * weight);
}

/// No step leaves more than the solver's tolerance in any balance, and friction takes energy only. What holds
/// at every node: it is open, or it slips and the traction is mu p against the slip, or it does not move.
TEST(ExactFriction, TheLawHoldsAtEveryNode) {
    const scene::Scene scene =
        support::repository_scene("paper", {exact, "mesh.cells=[16,16]", "time.steps=16"});
    const double mu = scene.boundaries.at("bottom").contact->friction->law.constants.at("mu");
    Simulation simulation(scene);
    int sticking = 0, slipping = 0;
    while (!simulation.finished()) {
        simulation.advance();
        EXPECT_GE(value(simulation.record(), "friction_dissipation"), -1e-15);
        model::FacetFields fields = simulation.probe(0).fields();
        const double fastest = largest(simulation.state().velocity), most = largest(fields["pressure"]);
        for (std::size_t i = 0; i < fields["gap"].size(); ++i) {
            const double slip = fields["slip_velocity"][2 * i], traction = fields["traction"][2 * i];
            const double bound = mu * fields["pressure"][i];
            EXPECT_LE(std::abs(traction), bound + 1e-12 * most);
            if (fields["gap"][i] > 0) {
                EXPECT_EQ(traction, 0.0);
            } else if (fields["slips"][i] > 0) {
                EXPECT_NEAR(traction, std::copysign(bound, -slip), 1e-12 * most);
                ++slipping;
            } else {
                EXPECT_LE(std::abs(slip), 1e-12 * fastest);
                ++sticking;
            }
        }
    }
    EXPECT_GT(sticking, 0) << "the case tests nothing";
    EXPECT_GT(slipping, 0) << "the case tests nothing";
    EXPECT_LE(simulation.totals().energy_residual, 1e-10);
    EXPECT_LE(simulation.totals().force_residual, 1e-10);
}

/// The multiplier is the friction at the end of the step, by its bound at the displacement there: with one
/// point a facet, the value in its middle times its length adds up to the resultant.
TEST(ExactFriction, TheMultiplierIsTheFriction) {
    const scene::Scene scene = support::repository_scene(
        "paper", {exact, "mesh.cells=[8,8]", "time.steps=8", "boundary.bottom.contact.quadrature=1"});
    Simulation simulation(scene);
    while (!simulation.finished()) {
        simulation.advance();
        const std::vector<double>& multiplier = simulation.state().friction_multiplier;
        constexpr std::size_t nodes = 3, middle = 2, d = 2;  // of a facet, as of degree 2
        double sum = 0;
        for (std::size_t facet = 0; facet * nodes * d < multiplier.size(); ++facet) {
            sum += multiplier[(facet * nodes + middle) * d] / 8;
        }
        const double force = simulation.contact_measures().at("bottom").tangential_force;
        EXPECT_NEAR(std::abs(sum), force, 1e-10 * force);
        EXPECT_GT(force, 0.0) << "the case tests nothing";
    }
}

/// Friction regularised errs by the order 1 in epsilon where the body sticks.
TEST(ExactFriction, IsTheLimitOfRegularisedFriction) {
    const auto end = [](const std::string& epsilon) {
        const scene::Scene scene = support::repository_scene(
            "paper", {"mesh.cells=[8,8]", "time.steps=8",
                      "boundary.bottom.contact.friction.regularisation=" + epsilon});
        Simulation simulation(scene);
        while (!simulation.finished()) {
            simulation.advance();
        }
        return simulation.state().velocity;
    };
    const std::vector<double> limit = end("0");
    const double far = distance(end("1e-6"), limit), near = distance(end("1e-8"), limit);
    EXPECT_GT(far, 1e-9);
    EXPECT_NEAR(std::log10(far / near), 2.0, 0.1);
}

/// All cells, both degrees, all rules: solved, balanced.
class Exact : public testing::TestWithParam<support::Overrides> {};

TEST_P(Exact, Balances) {
    support::Overrides overrides = GetParam();
    const bool solid = overrides.front() == "box";
    overrides.front() = exact;
    overrides.push_back(solid ? "mesh.cells=[3,2,3]" : "mesh.cells=[5,4]");
    overrides.push_back("time.steps=5");
    const scene::Scene scene = support::repository_scene(solid ? "box" : "paper", overrides);
    Simulation simulation(scene);
    while (!simulation.finished()) {
        simulation.advance();
    }
    EXPECT_LE(simulation.totals().energy_residual, 1e-9);
    EXPECT_LE(simulation.totals().force_residual, 1e-9);
    EXPECT_GT(largest(simulation.state().friction_multiplier), 0.0);
}

const std::string rule = "boundary.bottom.contact.quadrature=";
INSTANTIATE_TEST_SUITE_P(
    Scenes, Exact,
    testing::Values(support::Overrides{"paper"}, support::Overrides{"paper", "space.degree=2"},
                    support::Overrides{"paper", "mesh.cell=\"tensor\"", rule + "\"vertex\""},
                    support::Overrides{"paper", "time.scheme=\"midpoint\"", rule + "2"},
                    support::Overrides{"box"},
                    support::Overrides{"box", "space.degree=2", rule + "\"vertex\""},
                    support::Overrides{"box", "mesh.cell=\"tensor\"", rule + "1"}));

}  // namespace
}  // namespace thermocontact::march
