// Bars, columns and falling bodies against the closed forms of their steps.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "march/simulation.h"
#include "support/rows.h"
#include "support/scenes.h"

namespace thermocontact::march {
namespace {

using support::value;

/// A body that nothing holds falls as the scheme has it: w_n = w_0 + n k g, u_n = w_0 t + g k^2 n (n + 1)/2,
/// without strain. Round-off of each step is amplified by the condition of rho M/k + k E, some 1000 here.
TEST(ClosedForm, FreeFall) {
    for (const int degree : {1, 2}) {
        const scene::Scene scene = scene::read(
            "mesh = {cells = [5, 4], upper = [2, 1]}\ntime = {end = 1, steps = 8}\nspace.degree = " +
            std::to_string(degree) +
            "\nmaterial.density = 2.5\nmaterial.elasticity = {young = 30, poisson = 0.3}\n"
            "material.viscosity = {trace = 1, shear = 2}\nload.body_force = [2.5, -25]\ninitial.velocity = "
            "[\"1\", \"3\"]\n");
        Simulation simulation(scene);
        const double k = 1.0 / 8, g[2] = {1, -10}, w_0[2] = {1, 3};
        while (!simulation.finished()) {
            simulation.advance();
            const int n = simulation.state().step;
            for (std::size_t i = 0; i < simulation.state().velocity.size(); ++i) {
                EXPECT_NEAR(simulation.state().velocity[i], w_0[i % 2] + n * k * g[i % 2], 1e-12);
                EXPECT_NEAR(simulation.state().displacement[i],
                            w_0[i % 2] * n * k + g[i % 2] * k * k * n * (n + 1) / 2, 1e-12);
            }
            // a square good to some 100 epsilon |u|^2, |u| < 5, then its root
            EXPECT_LE(value(simulation.norms(), "displacement_strain_l2"), 5 * std::sqrt(100 * 2.2e-16));
            // sqrt(area |w|^2), area 2
            const double speed = std::hypot(1 + n * k, 3 - 10 * n * k);
            EXPECT_NEAR(value(simulation.norms(), "velocity_l2"), std::sqrt(2.0) * speed, 1e-12 * 10);
        }
    }
}

/// Prescribed displacements are met to the last bit at every step, and the initial state is left as given.
TEST(ClosedForm, PrescribedDisplacementIsExact) {
    const scene::Scene scene = scene::read(R"(
mesh.cells = [4, 4]
time = {end = 0.7, steps = 7}
material.density = 1
material.elasticity = {young = 5, poisson = 0.3}
initial.displacement = ["0.125", "0.25"]
[boundary.top]
displacement = ["0.1*sin(20*t)*x", "free"]
[boundary.left]
displacement = ["free", "t*(1 - t)*y"]
)");
    Simulation simulation(scene);
    const auto& u = simulation.state().displacement;
    for (std::size_t i = 0; i < u.size(); ++i) {
        EXPECT_EQ(u[i], i % 2 == 0 ? 0.125 : 0.25);
    }
    while (!simulation.finished()) {
        simulation.advance();
        const double t = simulation.state().time;
        EXPECT_EQ(t, 0.7 * simulation.state().step / 7);
        for (std::size_t node = 0; node < simulation.space().nodes.size(); ++node) {
            const mesh::Point& x = simulation.space().nodes[node];
            if (x[1] == 1.0) {
                EXPECT_EQ(u[2 * node], (*scene.boundaries.at("top").displacement[0])(x, t));
            }
            if (x[0] == 0.0) {
                EXPECT_EQ(u[2 * node + 1], (*scene.boundaries.at("left").displacement[1])(x, t));
            }
        }
    }
    EXPECT_LE(simulation.totals().energy_residual, 1e-9);
    EXPECT_LE(simulation.totals().force_residual, 1e-9);
}

/// A bar pulled without inertia, its sides free to contract: sigma_yy = E d/H in plane stress, E/(1 - nu^2)
/// d/H in plane strain; lateral strain -nu d/H and -nu/(1 - nu) d/H. Velocities are (u_n - u_{n-1})/k.
TEST(ClosedForm, QuasiStaticBar) {
    const double young = 5, nu = 0.3, height = 2, width = 1;
    for (const bool strain : {false, true}) {
        const scene::Scene scene = scene::read(
            "mesh = {cells = [3, 5], upper = [1, 2], diagonal = \"crossed\"}\ntime = {end = 1, steps = 4}\n"
            "material.elasticity = {young = 5, poisson = 0.3, plane = \"" +
            std::string(strain ? "strain" : "stress") +
            "\"}\n"
            "boundary.bottom.displacement = [\"free\", 0]\nboundary.left.displacement = [0, \"free\"]\n"
            "boundary.top.displacement = [\"free\", \"0.1*t^2\"]\n");
        Simulation simulation(scene);
        double d_old = 0;
        while (!simulation.finished()) {
            simulation.advance();
            const double t = simulation.state().time, d = 0.1 * t * t, lateral = strain ? nu / (1 - nu) : nu;
            for (std::size_t node = 0; node < simulation.space().nodes.size(); ++node) {
                const mesh::Point& x = simulation.space().nodes[node];
                EXPECT_NEAR(simulation.state().displacement[2 * node], -lateral * d / height * x[0], 1e-14);
                EXPECT_NEAR(simulation.state().displacement[2 * node + 1], d / height * x[1], 1e-14);
                EXPECT_NEAR(simulation.state().velocity[2 * node + 1], (d - d_old) / 0.25 / height * x[1],
                            1e-13);
            }
            d_old = d;
            // strain energy: sigma_yy eps_yy / 2 over the area; reactions of bottom and top cancel
            const double stress = (strain ? young / (1 - nu * nu) : young) * d / height;
            EXPECT_NEAR(value(simulation.record(), "strain_energy"), stress * d / height / 2 * width * height,
                        1e-14);
            EXPECT_NEAR(value(simulation.record(), "reaction_force_y"), 0.0, 1e-13);
            EXPECT_EQ(value(simulation.record(), "kinetic_energy"), 0.0);
        }
        EXPECT_LE(simulation.totals().energy_residual, 1e-9);
        EXPECT_LE(simulation.totals().force_residual, 1e-9) << "also where the reactions cancel";
    }
}

/// Closed forms of the heat balance between y = 0 and y = 1, exact for linear elements.
struct Column {
    std::string name, text;
    double (*theta)(double y, double t);
};

const std::vector<Column> columns{
    {"adiabatic_source", "heat = {capacity = 2, conductivity = 3, source = \"5\"}\ninitial.temperature = 7\n",
     [](double, double t) { return 7 + 2.5 * t; }},
    {"adiabatic_flux_of_both_sides",
     "heat = {capacity = 2}\nboundary.left.heat_flux = 3\nboundary.right.heat_flux = -3\n",
     nullptr},  // its total only
    {"steady_between_two_temperatures",
     "heat.conductivity = 3\nboundary.bottom.temperature = 0\nboundary.top.temperature = \"1 + t\"\n",
     [](double y, double t) { return (1 + t) * y; }},
    {"steady_flux",
     "heat.conductivity = [[3, 0], [0, 2]]\nboundary.bottom.temperature = 1\nboundary.top.heat_flux = "
     "\"6*t\"\n",
     [](double y, double t) { return 1 + 3 * t * y; }},
    {"steady_conductance",
     "heat.conductivity = 2\nboundary.top.heat_flux = 6\n[boundary.bottom.contact]\ngap = -1\n"
     "conductance = {coefficient = 4, onset = 0.5, foundation_temperature = \"10*t\"}\n",
     [](double y, double t) { return 10 * t + 6.0 / 4 + 6.0 / 2 * y; }},
    {"conductance_half_closed",  // r = 0.25, half the onset: k_c = 2
     "heat.conductivity = 2\nboundary.top.heat_flux = 6\n[boundary.bottom.contact]\ngap = -0.25\n"
     "conductance = {coefficient = 4, onset = 0.5, foundation_temperature = \"10*t\"}\n",
     [](double y, double t) { return 10 * t + 6.0 / 2 + 6.0 / 2 * y; }},
    {"conductance_at_its_limit",  // k_c L = 8 W/m^2 flow in, whatever the foundation's temperature
     "heat.conductivity = 2\nboundary.top.temperature = 1\n[boundary.bottom.contact]\ngap = -1\n"
     "conductance = {coefficient = 4, onset = 0.5, foundation_temperature = 100, limit = 2}\n",
     [](double y, double) { return 1 + 4 * (1 - y); }},
    {"conductance_at_its_lower_limit",
     "heat.conductivity = 2\nboundary.top.temperature = 1\n[boundary.bottom.contact]\ngap = -1\n"
     "conductance = {coefficient = 4, onset = 0.5, foundation_temperature = -100, limit = 2}\n",
     [](double y, double) { return 1 - 4 * (1 - y); }},
    {"open_contact_is_insulation",
     "heat.conductivity = 2\nboundary.top.temperature = \"t\"\nboundary.bottom.heat_flux = "
     "3\n[boundary.bottom.contact]\ngap = 0.1\n"
     "conductance = {coefficient = 4, onset = 0.5, foundation_temperature = 100}\n",
     [](double y, double t) { return t + 1.5 * (1 - y); }}};

class HeatColumn : public testing::TestWithParam<Column> {};

TEST_P(HeatColumn, EqualsItsClosedForm) {
    const scene::Scene scene =
        scene::read("mesh.cells = [3, 4]\ntime = {end = 1, steps = 4}\n" + GetParam().text);
    Simulation simulation(scene);
    while (!simulation.finished()) {
        simulation.advance();
        const State& state = simulation.state();
        if (GetParam().theta == nullptr) {
            // as much flows in as out: what is stored stays zero, though not everywhere
            EXPECT_NEAR(value(simulation.record(), "heat_storage_rate"), 0.0, 1e-13);
            EXPECT_GT(value(simulation.record(), "temperature_l2"), 0.1);
            continue;
        }
        for (std::size_t node = 0; node < state.temperature.size(); ++node) {
            const double y = simulation.space().nodes[node][1];
            EXPECT_NEAR(state.temperature[node], GetParam().theta(y, state.time), 1e-11)
                << "y = " << y << " t = " << state.time;
        }
    }
    EXPECT_LE(simulation.totals().heat_residual, 1e-9) << "also where inflow and outflow cancel";
}

INSTANTIATE_TEST_SUITE_P(Laws, HeatColumn, testing::ValuesIn(columns),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace thermocontact::march
