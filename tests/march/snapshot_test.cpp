#include "march/snapshot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "error.h"
#include "march/simulation.h"
#include "support/scenes.h"

namespace thermocontact::march {
namespace {

/// Time-dependent loads and gaps, slip with friction, heat: all that a state may hide.
const support::Overrides rubbing = {
    "mesh.cells=[8,8]",
    "time.steps=12",
    "time.end=0.375",
    "boundary.bottom.contact.gap=\"0.002*sin(9*t)\"",
    "boundary.left.traction=[\"1.4 + sin(5*t)\", 0.4]",
    "boundary.bottom.contact.conductance.foundation_temperature=\"10*min(4*t, 1)\"",
};

void march_to(Simulation& simulation, int step) {
    while (simulation.state().step < step) {
        simulation.advance();
    }
}

void expect_same(const State& a, const State& b, const std::string& what) {
    std::map<std::string, Nodal> fields;
    visit_members(a, [&](const std::string& name, const auto& member) {
        if constexpr (std::is_same_v<decltype(member), const Nodal&>) {
            fields[name] = member;
        } else {
            fields[name] = {static_cast<double>(member)};
        }
    });
    visit_members(b, [&](const std::string& name, const auto& member) {
        if constexpr (std::is_same_v<decltype(member), const Nodal&>) {
            EXPECT_TRUE(fields[name] == member) << what << ": " << name;
        } else {
            EXPECT_EQ(fields[name].front(), member) << what << ": " << name;
        }
    });
}

double value(const Record& record, const std::string& name) {
    return std::ranges::find(record, name, &Record::value_type::first)->second;
}

struct CutScene {
    std::string scene;
    support::Overrides more;
};

support::Overrides with(support::Overrides more) {
    more.insert(more.begin(), rubbing.begin(), rubbing.end());
    return more;
}

class Cut : public testing::TestWithParam<CutScene> {};

/// Cut at every step and gone on with in another simulation: every later state to the last bit.
TEST_P(Cut, AnywhereChangesNoBit) {
    const scene::Scene scene = support::repository_scene(GetParam().scene, GetParam().more);
    Simulation whole(scene);
    std::vector<Snapshot> snapshots{whole.snapshot()};
    std::vector<Record> records{{}};
    double slip = 0;
    while (!whole.finished()) {
        whole.advance();
        snapshots.push_back(whole.snapshot());
        records.push_back(whole.record());
        slip = std::max(slip, value(records.back(), "slip_fraction"));
    }
    EXPECT_GT(slip, 0) << "friction is active";
    for (std::size_t cut = 0; cut < snapshots.size(); ++cut) {
        Simulation rest(scene);
        rest.resume(snapshots[cut]);
        EXPECT_EQ(rest.first_step(), static_cast<int>(cut));
        expect_same(rest.state(), snapshots[cut].state, "taken up");
        while (!rest.finished()) {
            rest.advance();
            const auto step = static_cast<std::size_t>(rest.state().step);
            expect_same(rest.state(), snapshots[step].state,
                        "cut at " + std::to_string(cut) + ", step " + std::to_string(step));
            const Record row = rest.record();
            ASSERT_EQ(row.size(), records[step].size());
            for (std::size_t i = 0; i < row.size(); ++i) {
                // sums over nodes depend on where the numbers lie in memory; residuals are nothing but that
                EXPECT_EQ(row[i].first, records[step][i].first);
                EXPECT_NEAR(row[i].second, records[step][i].second,
                            1e-13 * std::max(1.0, std::abs(row[i].second)))
                    << row[i].first;
            }
        }
        EXPECT_EQ(rest.totals().iterations, whole.totals().iterations) << "carried over";
        EXPECT_EQ(rest.totals().max_iterations_in_a_step, whole.totals().max_iterations_in_a_step);
        EXPECT_NEAR(rest.totals().energy_residual, whole.totals().energy_residual, 1e-13);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, Cut,
    testing::Values(CutScene{"paper", rubbing}, CutScene{"paper", with({"time.scheme=\"bdf2\""})},
                    CutScene{"paper", with({"time.scheme=\"midpoint\"", "time.coupling=\"iterated\"",
                                            "time.coupling_tolerance=1e-12"})},
                    CutScene{"paper", with({"boundary.bottom.contact.friction.regularisation=0"})},
                    CutScene{"anisotropic", {"time.step=0.05", "time.end=0.6"}},
                    CutScene{"anisotropic",
                             {"time.step=0.05", "time.end=0.6", "boundary.bottom.contact.quadrature=4",
                              "boundary.bottom.contact.friction.regularisation=0",
                              "boundary.right.contact.friction={coefficient=0.3,regularisation=0}"}},
                    CutScene{"paper", with({"time.steps=4", "time.tolerance=2e-3"})},
                    CutScene{"paper",
                             with({"time.steps=4", "time.tolerance=2e-3", "time.scheme=\"bdf2\""})}));

/// The kept derivative is what makes it so: without it the last digits differ.
TEST(Snapshot, TheKeptDerivativeIsNeeded) {
    const scene::Scene scene = support::repository_scene("paper", rubbing);
    Simulation whole(scene);
    march_to(whole, 6);
    Snapshot snapshot = whole.snapshot();
    ASSERT_EQ(snapshot.kept.size(), 2U) << "momentum and heat";
    ASSERT_EQ(snapshot.kept.at("momentum").size(), 1U) << "one step size";
    EXPECT_FALSE(snapshot.kept.at("momentum").front().derivative.entries.empty());
    snapshot.kept.clear();
    Simulation rest(scene);
    rest.resume(snapshot);
    march_to(whole, 12);
    march_to(rest, 12);
    EXPECT_FALSE(rest.state().velocity == whole.state().velocity);
}

/// So is what the control of adaptive steps has kept: without it the steps are others.
TEST(Snapshot, TheMemoryOfAdaptiveStepsIsNeeded) {
    const scene::Scene scene = support::repository_scene(
        "paper", with({"time.steps=4", "time.tolerance=2e-3", "time.scheme=\"bdf2\""}));
    Simulation whole(scene);
    march_to(whole, 1);
    const Snapshot snapshot = whole.snapshot();
    whole.advance();
    const auto course = [](const Simulation& simulation) {
        std::vector<double> result;
        for (const Attempt& attempt : simulation.attempts()) {
            result.insert(result.end(), {attempt.size, attempt.error});
        }
        return result;
    };
    const std::vector<void (*)(State&)> forgetting{[](State& state) { state.halvings = 0; },
                                                   [](State& state) { state.since_change = -1000; },
                                                   [](State& state) { state.curvature_lag = 0; },
                                                   [](State& state) {
                                                       state.displacement_scale *= 50;
                                                       state.deformation_scale *= 50;
                                                       state.velocity_scale *= 50;
                                                       state.temperature_scale *= 50;
                                                   }};
    Simulation same(scene);
    same.resume(snapshot);
    same.advance();
    const auto differ = [&](const Simulation& a, const Simulation& b) {
        // sums over nodes depend on where the numbers lie in memory
        return !std::ranges::equal(course(a), course(b),
                                   [](double x, double y) { return std::abs(x - y) <= 1e-10; });
    };
    EXPECT_FALSE(differ(same, whole));
    for (std::size_t i = 0; i < forgetting.size(); ++i) {
        Snapshot changed = snapshot;
        forgetting[i](changed.state);
        Simulation rest(scene);
        rest.resume(changed);
        rest.advance();
        EXPECT_TRUE(differ(rest, whole)) << "number " << i;
    }
}

/// Nor would a state that lacks a field go unnoticed.
TEST(Snapshot, EveryFieldMatters) {
    const scene::Scene scene = support::repository_scene("paper", rubbing);
    Simulation whole(scene);
    march_to(whole, 6);
    const Snapshot snapshot = whole.snapshot();
    march_to(whole, 8);
    for (Nodal State::*field : {&State::displacement, &State::velocity, &State::temperature}) {
        Snapshot changed = snapshot;
        for (double& number : changed.state.*field) {
            number *= 1 + 1e-6;
        }
        Simulation rest(scene);
        rest.resume(changed);
        march_to(rest, 8);
        EXPECT_FALSE(rest.state().velocity == whole.state().velocity &&
                     rest.state().temperature == whole.state().temperature);
    }
}

TEST(Snapshot, OfAnotherMeshIsRefused) {
    const scene::Scene scene = support::repository_scene("paper", {"mesh.cells=[4,4]"}),
                       other = support::repository_scene("paper", {"mesh.cells=[4,5]"});
    Simulation simulation(scene), another(other);
    EXPECT_THROW(another.resume(simulation.snapshot()), SceneError);
}

}  // namespace
}  // namespace thermocontact::march
