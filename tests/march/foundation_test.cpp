// Foundations that move: friction acts against the velocity over them; what they do is work, what is lost
// heat.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "march/simulation.h"
#include "support/rows.h"
#include "support/scenes.h"

namespace thermocontact::march {
namespace {

const std::string contact = "boundary.bottom.contact.";

using support::largest;
using support::value;

struct Variant {
    std::string name;
    support::Overrides overrides;
};

const std::vector<Variant> variants{
    {"regularised", {}},
    {"exact", {contact + "friction.regularisation=0"}},
    {"midpoint", {"time.scheme=\"midpoint\""}},
    {"bdf2_exact", {"time.scheme=\"bdf2\"", contact + "friction.regularisation=0"}},
    {"generalized_alpha_iterated", {"time.scheme=\"generalized-alpha\"", "time.coupling=\"iterated\""}},
    {"quadratic_vertex", {"space.degree=2", contact + "quadrature=\"vertex\""}}};

/// The paper's body on a belt that changes its velocity from place to place and in time.
scene::Scene on_a_belt(const support::Overrides& more) {
    support::Overrides overrides{"mesh.cells=[6,5]", "time.steps=6",
                                 contact + "foundation_velocity=[\"0.4 - x*t\",0.3]",
                                 contact + "friction.heat_share=0.6"};
    overrides.insert(overrides.end(), more.begin(), more.end());
    return support::repository_scene("paper-isotropic", overrides);
}

std::string name_of(const testing::TestParamInfo<Variant>& info) {
    return info.param.name;
}

class Belt : public testing::TestWithParam<Variant> {};

/// Each balance closes to the audit's 1e-9 of its terms; friction only takes, but for what a sum of as many
/// rounded products as there are nodes leaves of the work done.
TEST_P(Belt, BalancesCloseAndFrictionTakes) {
    const scene::Scene scene = on_a_belt(GetParam().overrides);
    Simulation simulation(scene);
    double work = 0;
    while (!simulation.finished()) {
        simulation.advance();
        const double of_step = value(simulation.record(), "foundation_work");
        EXPECT_GE(value(simulation.record(), "friction_dissipation"), -1e-13 * std::abs(of_step));
        work = std::max(work, std::abs(of_step));
    }
    EXPECT_GT(work, 1e-3) << "the belt does nothing";
    EXPECT_LE(simulation.totals().energy_residual, 1e-9);
    EXPECT_LE(simulation.totals().force_residual, 1e-9);
    EXPECT_LE(simulation.totals().heat_residual, 1e-9);
}

/// What the heat balance receives is the share of what the momentum balance loses: both are the same
/// integral, summed over other functions, and the displacement in it is rounded otherwise (1e-16 of it over
/// penetrations some 1e-4 of it).
TEST_P(Belt, HeatIsTheShareOfTheDissipation) {
    const scene::Scene scene = on_a_belt(GetParam().overrides);
    Simulation simulation(scene);
    double lost = 0;
    while (!simulation.finished()) {
        simulation.advance();
        const double k = scene.time.end / scene.time.steps;
        lost = value(simulation.record(), "friction_dissipation") / k;
        EXPECT_NEAR(value(simulation.record(), "friction_heat_inflow"), 0.6 * lost, 1e-11 * lost);
    }
    EXPECT_GT(lost, 1e-3) << "nothing rubs";
}

/// In a frame that moves with V everything that forces depend on is the same: boundary values, gap and belt
/// move with it. Displacements of 1 m beside penetrations of 1e-4 m leave 1e-12 of the pressure.
TEST_P(Belt, IsInvariantUnderAChangeOfTheFrame) {
    const scene::Scene at_rest = on_a_belt(GetParam().overrides);
    support::Overrides moving = GetParam().overrides;
    moving.insert(moving.end(),
                  {"initial.velocity=[0.7,0.2]", "boundary.top.displacement=[\"0.7*t\",\"0.2*t\"]",
                   contact + "gap=\"-0.2*t\"", contact + "foundation_velocity=[\"1.1 - x*t\",0.5]"});
    const scene::Scene in_motion = on_a_belt(moving);
    Simulation here(at_rest), there(in_motion);
    while (!here.finished()) {
        here.advance();
        there.advance();
        std::vector<double> difference;
        for (std::size_t i = 0; i < here.state().velocity.size(); ++i) {
            difference.push_back(there.state().velocity[i] - here.state().velocity[i] -
                                 (i % 2 == 0 ? 0.7 : 0.2));
        }
        EXPECT_LE(largest(difference), 1e-10) << "step " << here.state().step;
        for (const char* name : {"friction_dissipation", "strain_energy", "contact_force_x",
                                 "contact_force_y", "friction_heat_inflow"}) {
            EXPECT_NEAR(value(there.record(), name), value(here.record(), name), 1e-10) << name;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Variants, Belt, testing::ValuesIn(variants), name_of);

/// A block that sticks to a belt is carried along: its slip is relative, and so is what is said to stick.
TEST(Foundation, WhatItCarriesSticks) {
    const scene::Scene scene = support::repository_scene(
        "benchmarks/belt-block", {contact + "friction.regularisation=0", "time.steps=60"});
    Simulation simulation(scene);
    while (!simulation.finished()) {
        simulation.advance();
    }
    const model::ContactMeasures measures = simulation.contact_measures().at("bottom");
    EXPECT_EQ(measures.slip_fraction, 0.0);
    EXPECT_EQ(measures.contact_fraction, 1.0);
    model::FacetFields fields = simulation.probe(0).fields();
    EXPECT_LE(largest(fields["slip_velocity"]), 1e-12 * 2.88);
    EXPECT_EQ(largest(fields["slips"]), 0.0);
    EXPECT_NEAR(largest(simulation.state().velocity), 2.88, 1e-5);
}

/// Its normal part counts for nothing, and only on its own surface.
TEST(Foundation, OnlyItsTangentialPartCounts) {
    const auto end = [](const std::string& velocity) {
        const scene::Scene scene = on_a_belt({contact + "foundation_velocity=" + velocity});
        Simulation simulation(scene);
        simulation.advance();
        return simulation.state().velocity;
    };
    EXPECT_EQ(end("[0.4,0.0]"), end("[0.4,-5.0]"));
    EXPECT_NE(end("[0.4,0.0]"), end("[0.5,0.0]"));
}

}  // namespace
}  // namespace thermocontact::march
