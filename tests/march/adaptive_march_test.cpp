#include "march/adaptive_march.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "error.h"
#include "support/scenes.h"

namespace thermocontact::march {
namespace {

double value(const Record& record, const std::string& name) {
    const auto entry = std::ranges::find(record, name, &Record::value_type::first);
    EXPECT_NE(entry, record.end()) << name;
    return entry == record.end() ? std::nan("") : entry->second;
}

/// A viscoelastic block pressed and rubbed on a hot foundation, its load moving from left to right: the mesh
/// has to be finer there now, here then.
std::string rubbed(const std::string& refinement, const std::string& more = "") {
    return "mesh = {cells = [4, 4]" + (refinement.empty() ? "" : ", refinement = {" + refinement + "}") +
           "}\ntime = {end = 1, steps = 8" + more +
           "}\nmaterial = {density = 1, elasticity = {young = 2, poisson = 0.1}, "
           "viscosity = {trace = 0.05, shear = 0.05}}\n"
           "heat = {capacity = 1, conductivity = 1, thermal_stress = 0.1, strain_heating = 0.1}\n"
           "load.body_force = [0.5, \"-8*exp(-40*(x - t)^2)\"]\ninitial.temperature = \"x*y\"\n"
           "[boundary.top]\ndisplacement = [0, \"-0.02*t*x*x\"]\ntemperature = \"t*x*x\"\n"
           "[boundary.bottom.contact]\ngap = \"0.01*x\"\ncompliance = {stiffness = 1e2}\n"
           "friction = {coefficient = 0.3, regularisation = 1e-3}\n"
           "conductance = {coefficient = 10, onset = 1e-3, foundation_temperature = \"5*x\"}\n";
}

const char* const often = "tolerance = 0.2, every = 1";

struct Course {
    std::vector<Record> rows;
    std::vector<State> states;
    std::vector<Snapshot> snapshots;
    Totals totals;
};

Course run(AdaptiveMarch& march) {
    Course result;
    while (!march.simulation().finished()) {
        march.advance();
        result.rows.push_back(march.simulation().record());
        result.snapshots.push_back(march.simulation().snapshot());
    }
    result.totals = march.simulation().totals();
    return result;
}

class EveryScheme : public testing::TestWithParam<std::string> {};

/// Meshes change, tolerances are met, audits are closed, and a row's energy follows from that of the row
/// before only with the terms of remeshing. The change and its terms are sums of thousands of numbers of the
/// energy's size; 1e-11 of what is summed is their round-off.
TEST_P(EveryScheme, RowsFollowFromEachOtherAcrossMeshes) {
    const scene::Scene scene = scene::read(rubbed(often, GetParam()));
    AdaptiveMarch march(scene);
    const Course one = run(march);
    EXPECT_GT(one.totals.most_cells, one.totals.fewest_cells);
    EXPECT_GT(one.totals.repeated_steps, 0);
    EXPECT_EQ(one.totals.beyond_mesh_tolerance, 0);
    EXPECT_LE(one.totals.error_in_space, 0.2);
    EXPECT_EQ(one.totals.looks, 8 + one.totals.repeated_steps);
    EXPECT_LT(one.totals.energy_residual, 1e-11);
    EXPECT_LT(one.totals.heat_residual, 1e-11);
    EXPECT_LT(one.totals.force_residual, 1e-11);
    double largest_jump = 0;
    for (std::size_t i = 1; i < one.rows.size(); ++i) {
        const Record &before = one.rows[i - 1], &row = one.rows[i];
        double sum = 0, scale = 0;
        const auto add = [&](double term) {
            sum += term;
            scale += std::abs(term);
        };
        for (const char* stored : {"kinetic_energy", "strain_energy"}) {
            add(value(row, stored));
            add(-value(before, stored));
            add(-value(row, std::string(stored) + "_of_remeshing"));
            largest_jump =
                std::max(largest_jump,
                         std::abs(value(row, std::string(stored) + "_of_remeshing")) / value(before, stored));
        }
        for (const char* spent : {"kinetic_numerical_dissipation", "strain_numerical_dissipation",
                                  "viscous_dissipation", "compliance_work", "friction_dissipation"}) {
            add(value(row, spent));
        }
        for (const char* given : {"load_work", "thermal_work", "reaction_work"}) {
            add(-value(row, given));
        }
        EXPECT_LT(std::abs(sum), 1e-11 * scale) << "row " << i;
    }
    EXPECT_GT(largest_jump, 1e-6) << "without the terms the rows would not follow";
}

INSTANTIATE_TEST_SUITE_P(Schemes, EveryScheme,
                         testing::Values("", ", scheme = \"bdf2\"", ", scheme = \"midpoint\"",
                                         ", scheme = \"generalized-alpha\", coupling = \"iterated\"",
                                         ", tolerance = 1e-2"));

/// From any snapshot the rest is the same to the last bit: state, meshes, totals.
TEST(AdaptiveMarch, GoesOnFromASnapshotToTheLastBit) {
    for (const char* more : {"", ", scheme = \"bdf2\"", ", tolerance = 1e-2"}) {
        const scene::Scene scene = scene::read(rubbed("tolerance = 0.2, every = 2", more));
        AdaptiveMarch whole(scene);
        const Course unbroken = run(whole);
        for (const std::size_t cut : {std::size_t{0}, std::size_t{1}, std::size_t{4}, std::size_t{6}}) {
            AdaptiveMarch rest(scene, {}, nullptr, &unbroken.snapshots[cut]);
            while (!rest.simulation().finished()) {
                rest.advance();
                const auto step = static_cast<std::size_t>(rest.simulation().state().step) - 1;
                const Snapshot now = rest.simulation().snapshot();
                EXPECT_EQ(now.bisections, unbroken.snapshots[step].bisections);
                EXPECT_EQ(now.state.displacement, unbroken.snapshots[step].state.displacement);
                EXPECT_EQ(now.state.velocity_rate, unbroken.snapshots[step].state.velocity_rate);
                EXPECT_EQ(now.state.temperature, unbroken.snapshots[step].state.temperature);
                const Record row = rest.simulation().record();
                ASSERT_EQ(row.size(), unbroken.rows[step].size());
                for (std::size_t i = 0; i < row.size(); ++i) {  // sums depend on where in memory numbers lie
                    EXPECT_NEAR(row[i].second, unbroken.rows[step][i].second,
                                1e-12 * std::max(1.0, std::abs(row[i].second)))
                        << row[i].first << more << cut << " " << step;
                }
            }
            EXPECT_EQ(rest.simulation().totals().looks, unbroken.totals.looks);
            EXPECT_EQ(rest.simulation().totals().repeated_steps, unbroken.totals.repeated_steps);
            EXPECT_EQ(rest.simulation().totals().error_in_space, unbroken.totals.error_in_space);
        }
    }
}

/// Where the tolerance is met from the start, the run is that of the scene without refinement.
TEST(AdaptiveMarch, ChangesNothingWhereTheMeshDoes) {
    const scene::Scene loose = scene::read(rubbed("tolerance = 0.99")), plain = scene::read(rubbed(""));
    AdaptiveMarch adaptive(loose), fixed(plain);
    run(adaptive);
    run(fixed);
    EXPECT_EQ(adaptive.mesh_number(), 0);
    EXPECT_EQ(adaptive.simulation().state().displacement, fixed.simulation().state().displacement);
    EXPECT_EQ(adaptive.simulation().state().temperature, fixed.simulation().state().temperature);
}

/// A sudden load: the first step is repeated until it is solved well enough, from the initial values on the
/// nodes of each mesh, and prescribed values hold on the nodes that are new.
TEST(AdaptiveMarch, BeginsAnewOnAFinerMesh) {
    const scene::Scene scene = scene::read(rubbed("tolerance = 0.15, every = 100"));
    AdaptiveMarch march(scene);
    march.advance();
    Simulation& simulation = march.simulation();
    EXPECT_GT(march.mesh_number(), 0);
    EXPECT_LE(simulation.totals().last_error_in_space, 0.15);
    const mesh::Mesh mesh = simulation.mesh();
    Simulation again(scene, {}, nullptr, &mesh);
    again.advance();
    EXPECT_EQ(again.state().displacement, simulation.state().displacement);
    EXPECT_EQ(again.state().temperature, simulation.state().temperature);
    EXPECT_EQ(value(simulation.record(), "heat_of_remeshing"), 0);
}

/// A dent that moves along the top, where nodes appear before it.
TEST(AdaptiveMarch, PrescribesOnNewNodes) {
    std::string text = rubbed(often);
    const std::string prescribed = "-0.02*t*x*x";
    text.replace(text.find(prescribed), prescribed.size(), "-0.4*t*exp(-60*(x - t)^2)");
    const scene::Scene scene = scene::read(text);
    AdaptiveMarch march(scene);
    int appeared = 0;
    std::set<double> before;
    while (!march.simulation().finished()) {
        march.advance();
        const State& state = march.simulation().state();
        std::set<double> now;
        for (const std::int32_t node : march.simulation().space().boundary_nodes[3]) {  // top
            const auto i = static_cast<std::size_t>(node);
            const double x = march.simulation().space().nodes[i][0];
            const auto motion = [x](double t) { return -0.4 * t * std::exp(-60 * (x - t) * (x - t)); };
            EXPECT_NEAR(state.displacement[2 * i + 1], motion(state.time), 1e-15);
            // backward Euler: the velocity that the prescribed motion has
            const double velocity = 8 * (motion(state.time) - motion(state.time - 0.125));
            EXPECT_NEAR(state.velocity[2 * i + 1], velocity, 1e-13);
            now.insert(x);
            appeared += state.step > 1 && !before.contains(x) ? 1 : 0;
        }
        before = now;
    }
    EXPECT_GT(appeared, 0);
}

/// A uniform temperature has gradients of round-off, which no mesh makes smaller.
TEST(AdaptiveMarch, RefinesNothingForRoundOff) {
    const scene::Scene scene = scene::read(
        "mesh = {cells = [5, 3], upper = [1, 0.7], refinement = {tolerance = 0.1}}\n"
        "time = {end = 1, steps = 2}\nheat = {capacity = 1, conductivity = 3}\n"
        "initial.temperature = 293.15\n[boundary.left]\ntemperature = 293.15\n");
    AdaptiveMarch march(scene);
    run(march);
    EXPECT_EQ(march.mesh_number(), 0);
    EXPECT_LT(march.simulation().totals().error_in_space, 1e-3);
}

TEST(AdaptiveMarch, StopsRefiningAtItsLimits) {
    for (const char* limit :
         {"tolerance = 0.01, every = 2, max_cells = 300", "tolerance = 0.01, every = 2, max_level = 2",
          "tolerance = 0.01, max_level = 0"}) {
        const scene::Scene scene = scene::read(rubbed(limit));
        AdaptiveMarch march(scene);
        const Course one = run(march);
        EXPECT_EQ(one.totals.beyond_mesh_tolerance, one.totals.looks - one.totals.repeated_steps) << limit;
        EXPECT_GT(one.totals.error_in_space, 0.01);
        EXPECT_LE(one.totals.most_cells, scene.mesh.refinement->max_cells);
        if (scene.mesh.refinement->max_level <= 2) {
            EXPECT_LE(one.totals.most_cells, 32 * 8) << "two bisections, and the closure";
        }
    }
}

/// A step that fails leaves state and mesh as they were before it.
TEST(AdaptiveMarch, PutsBackWhatAFailedStepHadBegun) {
    scene::Scene scene = scene::read(rubbed(often));
    AdaptiveMarch march(scene);
    march.advance();
    march.advance();
    const Snapshot before = march.simulation().snapshot();
    scene.solver.max_iterations = 1;  // Balance has its copy: only what is made anew fails, a finer mesh's
    scene.body_force[1] = scene::Expression("-80*exp(-40*(x - t)^2)", 2);
    bool failed = false;
    for (int step = 0; step < 4 && !failed; ++step) {
        const Snapshot last = march.simulation().snapshot();
        try {
            march.advance();
        } catch (const NumericsError&) {
            failed = true;
            const Snapshot after = march.simulation().snapshot();
            EXPECT_EQ(after.bisections, last.bisections);
            EXPECT_EQ(after.state.step, last.state.step);
            EXPECT_EQ(after.state.displacement, last.state.displacement);
            EXPECT_EQ(after.totals.looks, last.totals.looks);
        }
    }
    EXPECT_TRUE(failed);
}

TEST(AdaptiveMarch, AdaptsTetrahedraOfBothDegrees) {
    for (const char* degree : {"1", "2"}) {
        const scene::Scene scene = scene::read(
            "mesh = {shape = \"box\", cells = [2, 2, 2], refinement = {tolerance = 0.3, every = 1, "
            "max_cells = 3000}}\nspace.degree = " +
            std::string(degree) +
            "\ntime = {end = 1, steps = 2}\n"
            "material = {density = 1, elasticity = {young = 2, poisson = 0.1}}\n"
            "load.body_force = [0, 0, \"-exp(-20*((x - t)^2 + y^2))\"]\n"
            "[boundary.bottom]\ndisplacement = [0, 0, 0]\n"
            "[boundary.top.contact]\ngap = 0.01\ncompliance = {stiffness = 100}\n");
        AdaptiveMarch march(scene);
        const Course one = run(march);
        EXPECT_GT(march.mesh_number(), 0);
        EXPECT_TRUE(one.totals.error_in_space <= 0.3 || one.totals.beyond_mesh_tolerance > 0);
        EXPECT_LE(one.totals.most_cells, 3000);
        EXPECT_LT(one.totals.energy_residual, 1e-11);
    }
}

/// Exact friction: multipliers begin at zero on a new mesh, and the steps are solved all the same.
TEST(AdaptiveMarch, SolvesExactFriction) {
    std::string text = rubbed(often);
    text.replace(text.find("regularisation = 1e-3"), 21, "regularisation = 0");
    const scene::Scene scene = scene::read(text);
    AdaptiveMarch march(scene);
    const Course one = run(march);
    EXPECT_GT(march.mesh_number(), 1);
    EXPECT_LT(one.totals.energy_residual, 1e-9);
}

}  // namespace
}  // namespace thermocontact::march
