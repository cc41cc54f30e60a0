#include "march/simulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "error.h"
#include "support/scenes.h"

namespace thermocontact::march {
namespace {

using support::Overrides;
using support::repository_scene;

double value(const Record& record, const std::string& name) {
    const auto entry = std::ranges::find(record, name, &Record::value_type::first);
    EXPECT_NE(entry, record.end()) << name;
    return entry == record.end() ? std::nan("") : entry->second;
}

bool has(const Record& record, const std::string& name) {
    return std::ranges::find(record, name, &Record::value_type::first) != record.end();
}

std::string failure_of(Simulation& simulation) {
    try {
        simulation.advance();
        return "";
    } catch (const NumericsError& error) {
        return error.what();
    }
}

struct Presence {
    std::string scene;
    bool mechanics, heat;
    std::int64_t
        contact_unknowns;  ///< on 17 nodes (paper: 33, heat-only: 25); the corners' temperature is prescribed
};

class EveryScene : public testing::TestWithParam<Presence> {};

TEST_P(EveryScene, AbsentPhysicsHasNoUnknowns) {
    const Presence& scene = GetParam();
    const scene::Scene data = repository_scene(scene.scene);
    Simulation simulation(data);
    const std::size_t nodes = simulation.space().nodes.size();
    simulation.advance();
    const State& state = simulation.state();
    EXPECT_EQ(state.displacement.size(), scene.mechanics ? 2 * nodes : 0);
    EXPECT_EQ(state.velocity.size(), state.displacement.size());
    EXPECT_EQ(state.temperature.size(), scene.heat ? nodes : 0);
    EXPECT_EQ(simulation.contact_unknowns(), scene.contact_unknowns);
    const Record record = simulation.record();
    EXPECT_EQ(has(record, "energy_residual"), scene.mechanics);
    EXPECT_EQ(has(record, "force_residual"), scene.mechanics);
    EXPECT_EQ(has(record, "heat_residual"), scene.heat);
    EXPECT_EQ(has(record, "contact_fraction"), scene.contact_unknowns > 0);
    if (!scene.mechanics) {
        EXPECT_EQ(value(simulation.norms(), "velocity_l2"), 0.0);
        EXPECT_EQ(value(record, "newton_iterations"), 0.0);
    }
    if (scene.contact_unknowns == 0) {
        EXPECT_EQ(simulation.totals().iterations, 0) << "a linear scene never enters Newton";
    }
}

/// The issue asks for 1e-9 at every step of every scene.
TEST_P(EveryScene, AuditsAreSmallAndTermsFinite) {
    const scene::Scene data = repository_scene(GetParam().scene);
    Simulation simulation(data);
    const std::size_t columns = [&] {
        simulation.advance();
        return simulation.record().size();
    }();
    while (!simulation.finished()) {
        simulation.advance();
        const Record record = simulation.record();
        EXPECT_EQ(record.size(), columns);
        for (const auto& [name, number] : record) {
            EXPECT_TRUE(std::isfinite(number)) << name;
        }
        if (GetParam().mechanics) {
            // the second law: neither viscosity nor friction nor the scheme gives energy away
            for (const char* name :
                 {"viscous_dissipation", "friction_dissipation", "kinetic_numerical_dissipation",
                  "strain_numerical_dissipation", "kinetic_energy", "strain_energy"}) {
                EXPECT_GE(value(record, name), 0.0) << name;
            }
        }
    }
    EXPECT_EQ(simulation.state().time, data.time.end);
    EXPECT_LE(simulation.totals().energy_residual, 1e-9);
    EXPECT_LE(simulation.totals().heat_residual, 1e-9);
    EXPECT_LE(simulation.totals().force_residual, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Scenes, EveryScene,
                         testing::Values(Presence{"paper", true, true, 3 * 33 - 2},
                                         Presence{"elastic", true, true, 3 * 17 - 2},
                                         Presence{"frictionless", true, true, 3 * 17 - 2},
                                         Presence{"isothermal", true, false, 2 * 17},
                                         Presence{"quasi-static", true, true, 3 * 17 - 2},
                                         Presence{"no-contact", true, true, 0},
                                         Presence{"heat-only", false, true, 25}),
                         [](const auto& info) {
                             std::string name = info.param.scene;
                             std::ranges::replace(name, '-', '_');
                             return name;
                         });

/// Friction regularised at 1e-12, far below round-off of the velocities' products: only the ladder gets
/// there.
class SharpFriction : public testing::TestWithParam<std::string> {};

TEST_P(SharpFriction, CompletesWithSmallAudits) {
    const scene::Scene scene =
        repository_scene(GetParam(), {"boundary.bottom.contact.friction.regularisation=1e-12"});
    ASSERT_EQ(scene.mesh.cells, (std::vector<int>{32, 32}));
    Simulation simulation(scene);
    while (!simulation.finished()) {
        ASSERT_EQ(failure_of(simulation), "");
    }
    EXPECT_EQ(simulation.state().step, 32);
    EXPECT_GT(simulation.totals().retries, 0) << "continuation was not needed: the case tests nothing";
    EXPECT_LE(simulation.totals().energy_residual, 1e-9);
    EXPECT_LE(simulation.totals().heat_residual, 1e-9);
    EXPECT_LE(simulation.totals().force_residual, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Scenes, SharpFriction, testing::Values("paper", "paper-isotropic"),
                         [](const auto& info) {
                             return std::string(info.param == "paper" ? "literal" : "isotropic");
                         });

/// A body that nothing holds falls as the scheme has it: w_n = w_0 + n k g, u_n = w_0 t + g k^2 n (n + 1)/2,
/// without strain. Round-off of each step is amplified by the condition of rho M/k + k E, some 1000 here.
TEST(Simulation, FreeFall) {
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
TEST(Simulation, PrescribedDisplacementIsExact) {
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
TEST(Simulation, QuasiStaticBar) {
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

/// The time integrated against linear shape functions, as FFCx would compile t * q * dx.
void add_time(double* A, const double*, const double* c, const double* x, const int*, const std::uint8_t*) {
    const double area = std::abs((x[3] - x[0]) * (x[7] - x[1]) - (x[6] - x[0]) * (x[4] - x[1])) / 2;
    for (int i = 0; i < 3; ++i) {
        A[i] += c[0] * area / 3;
    }
}

/// Loads that no scene states, over the cells with the time and on one side without it.
TEST(Simulation, CompiledSourcesActAsLoads) {
    const std::string text =
        "mesh.cells = [3, 4]\ntime = {end = 2, steps = 5}\nheat = {capacity = 2, conductivity = 3";
    const scene::Scene stated = scene::read(text + ", source = \"t\"}\nboundary.left.heat_flux = 1\n");
    const scene::Scene bare = scene::read(text + "}\n");
    const fem::Kernel over_cells{"time", 1, {}, {"t"}, {{-1, add_time}}, {}};
    const fem::Kernel on_side = fem::find_kernel("kinematics.node_area", "triangle", 1);
    Simulation expected(stated), found(bare, {{}, {{over_cells, ""}, {on_side, "left"}}});
    while (!expected.finished()) {
        expected.advance();
        found.advance();
        for (std::size_t i = 0; i < expected.state().temperature.size(); ++i) {
            EXPECT_NEAR(found.state().temperature[i], expected.state().temperature[i], 1e-13);
        }
    }
    EXPECT_GT(value(found.record(), "temperature_l2"), 0.1);
    EXPECT_LE(found.totals().heat_residual, 1e-9);
}

/// Loose tolerances leave steps unsolved, which every audit must see. What a solve leaves of its residual is
/// at most the tolerance of the terms' sizes; round-off would be below 1e-12. The totals are those of the
/// worst step.
TEST(Simulation, AuditsSeeWhatASolveLeaves) {
    const scene::Scene scene = repository_scene("paper", {"solver.tolerance=1e-2"});
    Simulation simulation(scene);
    std::map<std::string, double> largest;
    double last = 0;
    while (!simulation.finished()) {
        simulation.advance();
        for (const char* name : {"energy_residual", "force_residual", "heat_residual"}) {
            last = value(simulation.record(), name);
            largest[name] = std::max(largest[name], last);
        }
    }
    for (const auto& [name, residual] : largest) {
        EXPECT_GT(residual, 1e-6) << name;
        EXPECT_LT(residual, 1e-2) << name;
        EXPECT_LT(value(simulation.record(), name), residual) << name << ": the last step is not the worst";
    }
    EXPECT_EQ(simulation.totals().energy_residual, largest["energy_residual"]);
    EXPECT_EQ(simulation.totals().force_residual, largest["force_residual"]);
    EXPECT_EQ(simulation.totals().heat_residual, largest["heat_residual"]);
}

/// Iterations and retries of the totals are those of the history; the largest of a step is not the last.
TEST(Simulation, TotalsCountTheHistory) {
    const scene::Scene scene =
        repository_scene("paper", {"boundary.bottom.contact.friction.regularisation=1e-12"});
    Simulation simulation(scene);
    int iterations = 0, most = 0, last = 0, retries = 0;
    while (!simulation.finished()) {
        simulation.advance();
        const Record record = simulation.record();
        last = static_cast<int>(value(record, "newton_iterations") + value(record, "heat_iterations"));
        most = std::max(most, last);
        iterations += last;
        retries += static_cast<int>(value(record, "retries"));
    }
    EXPECT_EQ(simulation.totals().iterations, iterations);
    EXPECT_EQ(simulation.totals().max_iterations_in_a_step, most);
    EXPECT_EQ(simulation.totals().retries, retries);
    EXPECT_GT(retries, 0) << "continuation was not needed: the case tests nothing";
    EXPECT_LT(last, most);
}

/// The terms of the heat balance in the history: storage + outflow = inflow of prescribed sides, loads and
/// strain. Each is there, and they balance to the audit's 1e-9 of their magnitudes, in a step that is solved.
TEST(Simulation, HeatTermsBalance) {
    const scene::Scene scene = repository_scene(
        "anisotropic",
        {"mesh.cells=[5,4]", "boundary.bottom.contact.friction.heat_share=0.8",
         "boundary.bottom.contact.foundation_velocity=[1.0,0.0]", "heat.strain_rate_heating=0.5",
         "boundary.left.convection.coefficient=2.5", "boundary.left.convection.ambient_temperature=4.0"});
    Simulation simulation(scene);
    const std::map<std::string, double> signs{
        {"heat_storage_rate", 1},     {"contact_heat_outflow", 1},   {"prescribed_temperature_inflow", -1},
        {"load_heat_inflow", -1},     {"strain_heat_inflow", -1},    {"strain_rate_heat_inflow", -1},
        {"friction_heat_inflow", -1}, {"convection_heat_outflow", 1}};
    std::map<std::string, double> largest;
    while (!simulation.finished()) {
        simulation.advance();
        double sum = 0, scale = 0;
        for (const auto& [name, sign] : signs) {
            const double term = value(simulation.record(), name);
            sum += sign * term;
            scale += std::abs(term);
            largest[name] = std::max(largest[name], std::abs(term));
        }
        EXPECT_LE(std::abs(sum), 1e-9 * scale) << "step " << simulation.state().step;
    }
    for (const auto& [name, term] : largest) {
        EXPECT_GT(term, 1e-3) << name << " is not in play";
    }
    double outflow = 0;
    for (const auto& [name, measures] : simulation.contact_measures()) {
        outflow += measures.heat_flow;
    }
    EXPECT_NEAR(value(simulation.record(), "contact_heat_outflow"), outflow, 1e-9 * std::abs(outflow));
}

/// Shares of the history are of the area of all contact boundaries.
TEST(Simulation, SurfacesCountByTheirArea) {
    const scene::Scene scene = scene::read(R"(
mesh = {cells = [4, 4], upper = [4, 1]}
time = {end = 1, steps = 1}
material = {density = 1, viscosity = {trace = 1, shear = 1}}
initial.velocity = [0.5, 0]
[boundary.bottom.contact]
gap = "x < 1.5 ? -1e-3 : 1"
compliance.stiffness = 1e-3
friction = {coefficient = 0.1, regularisation = 1e-3}
[boundary.left.contact]
gap = 1
compliance.stiffness = 1e-3
)");
    Simulation simulation(scene);
    simulation.advance();
    const auto measures = simulation.contact_measures();
    ASSERT_EQ(measures.size(), 2U);
    const auto& bottom = measures.at("bottom");
    ASSERT_GT(bottom.contact_fraction, 0.1);
    ASSERT_GT(bottom.slip_fraction, 0.1);
    ASSERT_EQ(measures.at("left").contact_fraction, 0.0);
    EXPECT_DOUBLE_EQ(bottom.area, 4.0);
    EXPECT_DOUBLE_EQ(value(simulation.record(), "contact_fraction"), bottom.contact_fraction * 4 / 5);
    EXPECT_DOUBLE_EQ(value(simulation.record(), "slip_fraction"), bottom.slip_fraction * 4 / 5);
    EXPECT_EQ(value(simulation.record(), "max_penetration"), bottom.max_penetration);
}

/// The same scene twice gives the same bits: nothing depends on addresses, threads or what ran before.
TEST(Simulation, IsReproducible) {
    const scene::Scene scene = repository_scene("paper", {"mesh.cells=[8,8]"});
    Simulation first(scene), second(scene);
    for (int step = 0; step < 3; ++step) {
        first.advance();
    }
    for (int step = 0; step < 3; ++step) {
        second.advance();
    }
    EXPECT_EQ(first.state().velocity, second.state().velocity);
    EXPECT_EQ(first.state().temperature, second.state().temperature);
}

}  // namespace
}  // namespace thermocontact::march
