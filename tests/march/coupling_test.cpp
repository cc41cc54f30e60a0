#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "march/simulation.h"
#include "support/scenes.h"

namespace thermocontact::march {
namespace {

std::vector<double> temperature_with(double tolerance) {
    const scene::Scene scene = scene::read(
        "mesh.cells = [3, 3]\n[time]\nend = 1\nsteps = 4\ncoupling = \"iterated\"\ncoupling_tolerance = " +
        std::to_string(tolerance * 1e12) +
        "e-12\n[initial]\nvelocity = [\"x\", \"y\"]\ntemperature = \"1 + x\"\n"
        "[material]\ndensity = 1\nelasticity = {young = 2, poisson = 0.1}\n"
        "[heat]\ncapacity = 1\nconductivity = 1\nthermal_stress = 0.5\nstrain_heating = 0.5\n");
    Simulation simulation(scene);
    while (!simulation.finished()) {
        simulation.advance();
    }
    return simulation.state().temperature;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        largest = std::max(largest, std::abs(a[i] - b[i]));
    }
    return largest;
}

/// The coupling is iterated as far as its tolerance asks: temperatures of order 1 over four steps. The
/// iteration contracts at least by half, so that what is left is no more than the last change.
TEST(Coupling, IsIteratedToItsTolerance) {
    const std::vector<double> exact = temperature_with(1e-12);
    double before = 0;
    for (const double tolerance : {1e-9, 1e-6, 1e-3}) {
        const double error = largest_difference(temperature_with(tolerance), exact);
        EXPECT_GT(error, before) << tolerance << ": the tolerance makes no difference";
        EXPECT_LE(error, 4 * 4 * tolerance) << tolerance;
        before = error;
    }
}

/// Strain that grows with time in a body without conduction: c theta' = R e_xx, e_xx = t, R = 3, c = 2. The
/// midpoint rule integrates what is linear in t exactly after its first step, which is one of backward Euler
/// and is k^2/2 too large, if the heat balance takes the displacement of the same stage, just computed. The
/// paper's scheme takes that of the last state: k^2 times 0 + 1 + ... + (n - 1). A thermal stress along x, of
/// which the heating is a multiple, moves nothing.
TEST(Coupling, HeatTakesTheDisplacementOfItsScheme) {
    for (const std::string scheme : {"midpoint", "backward-euler"}) {
        for (const char* thermal_stress : {"", "thermal_stress = [[1, 0], [0, 0]]\n"}) {
            const scene::Scene scene =
                scene::read("mesh.cells = [3, 2]\n[time]\nend = 1\nsteps = 4\nscheme = \"" + scheme +
                            "\"\n[material]\nelasticity = {young = 2, poisson = 0}\n[heat]\ncapacity = 2\n" +
                            thermal_stress +
                            "strain_heating = [[3, 0], [0, 0]]\n[boundary.left]\ndisplacement = [0, 0]\n"
                            "[boundary.right]\ndisplacement = [\"t\", 0]\n");
            Simulation simulation(scene);
            while (!simulation.finished()) {
                simulation.advance();
                const State& state = simulation.state();
                const double t = state.time, k = 0.25;
                const double expected = 3.0 / 2 * (scheme == "midpoint" ? t * t + k * k : t * t - k * t) / 2;
                for (const double theta : state.temperature) {
                    EXPECT_NEAR(theta, expected, 1e-13) << scheme << " t = " << t << thermal_stress;
                }
            }
        }
    }
}

}  // namespace
}  // namespace thermocontact::march
