// Heat given to the surroundings, and heat of strain rates.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "error.h"
#include "march/simulation.h"
#include "support/scenes.h"

namespace thermocontact::march {
namespace {

double value(const Record& record, const std::string& name) {
    return std::ranges::find(record, name, &Record::value_type::first)->second;
}

/// A slab, linear from theta_a + q/h at the bottom to the given temperature on top (scenes/benchmarks).
TEST(Convection, OfASlabIsExact) {
    for (const char* degree : {"space.degree=1", "space.degree=2"}) {
        const scene::Scene scene = support::repository_scene("benchmarks/convection-slab", {degree});
        Simulation simulation(scene);
        simulation.advance();
        const double q = 60 / (0.5 / 2.5 + 1 / 40.0);
        for (std::size_t i = 0; i < simulation.space().nodes.size(); ++i) {
            const double y = simulation.space().nodes[i][1];
            EXPECT_NEAR(simulation.state().temperature[i], 20 + q / 40 + q * y / 2.5, 1e-9);
        }
        EXPECT_NEAR(value(simulation.record(), "convection_heat_outflow"), 0.6 * q, 1e-9 * q);
        EXPECT_NEAR(value(simulation.record(), "prescribed_temperature_inflow"), 0.6 * q, 1e-9 * q);
        EXPECT_LE(simulation.totals().heat_residual, 1e-12);
    }
}

const std::string body = R"(
mesh.cells = [3, 4]
time = {end = 1, steps = 2}
heat.conductivity = 2
boundary.left.heat_flux = 1.5
[boundary.right.convection]
ambient_temperature = 7
)";

/// Without capacity and prescribed temperature it is the air that holds the temperature: 7 + 1.5/3 at the
/// right side, and what conduction adds.
TEST(Convection, HoldsABodyWithoutCapacity) {
    const scene::Scene scene = scene::read(body + "coefficient = 3\n");
    Simulation simulation(scene);
    simulation.advance();
    for (std::size_t i = 0; i < simulation.space().nodes.size(); ++i) {
        const double x = simulation.space().nodes[i][0];
        EXPECT_NEAR(simulation.state().temperature[i], 7.5 + 1.5 / 2 * (1 - x), 1e-11);
    }
}

TEST(Convection, ThatExchangesNothingHoldsNothing) {
    const scene::Scene scene = scene::read(body + "coefficient = 0\n");
    try {
        const Simulation simulation(scene);
        ADD_FAILURE() << "a singular system was taken for a regular one";
    } catch (const NumericsError& error) {
        EXPECT_NE(std::string(error.what()).find("singular"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("convection"), std::string::npos) << error.what();
    }
}

/// The surroundings are taken at the stage, where the balance holds.
TEST(Convection, TakesTheAirAtTheStage) {
    const scene::Scene scene = scene::read(R"(
mesh.cells = [2, 2]
time = {end = 1, steps = 4, scheme = "midpoint"}
heat = {capacity = 1, conductivity = 1}
[boundary.right.convection]
coefficient = 0.5
ambient_temperature = "t"
)");
    Simulation simulation(scene);
    simulation.advance();
    simulation.advance();
    double sum = 0;  // of h (theta - theta_a) over the right side of length 1, by the trapezoid rule
    const Simulation& now = simulation;
    for (std::size_t i = 0; i < now.space().nodes.size(); ++i) {
        const mesh::Point& x = now.space().nodes[i];
        sum += x[0] == 1 ? (x[1] == 0 || x[1] == 1 ? 0.25 : 0.5) * now.state().temperature[i] : 0;
    }
    const double after = 0.5 * (sum - 0.5);
    EXPECT_LT(value(simulation.record(), "convection_heat_outflow"), 0.0);
    EXPECT_GT(value(simulation.record(), "convection_heat_outflow"), after)
        << "the air of the end of the step";
    EXPECT_LE(simulation.totals().heat_residual, 1e-12);
}

/// c theta' = R' : eps(w): exactly R' : eps(u)/c whatever the scheme, one step late where lagged.
struct Stretch {
    std::string name;
    support::Overrides overrides;
    int late;
};

class StretchedBar : public testing::TestWithParam<Stretch> {};

TEST_P(StretchedBar, CoolsByItsStrain) {
    const scene::Scene scene = support::repository_scene("benchmarks/stretched-bar", GetParam().overrides);
    Simulation simulation(scene);
    while (!simulation.finished()) {
        simulation.advance();
        const double strain = 0.002 * (simulation.state().time - 0.1 * GetParam().late);
        const double exact = -40 * (1 - 0.3) * strain / 2.5;
        for (const double theta : simulation.state().temperature) {
            EXPECT_NEAR(theta, exact, 1e-12);
        }
    }
    EXPECT_LE(simulation.totals().energy_residual, 1e-9);
    EXPECT_LE(simulation.totals().heat_residual, 1e-9);
    const double inflow = value(simulation.record(), "strain_rate_heat_inflow");
    EXPECT_NEAR(inflow, -40 * (1 - 0.3) * 0.002, 1e-11) << "over an area of 1";
}

INSTANTIATE_TEST_SUITE_P(
    Schemes, StretchedBar,
    testing::Values(Stretch{"iterated", {}, 0}, Stretch{"lagged", {"time.coupling=\"lagged\""}, 1},
                    Stretch{"bdf2", {"time.scheme=\"bdf2\"", "time.coupling=\"lagged\""}, 0},
                    Stretch{"midpoint", {"time.scheme=\"midpoint\""}, 0},
                    Stretch{"quadratic", {"space.degree=2"}, 0}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace thermocontact::march
