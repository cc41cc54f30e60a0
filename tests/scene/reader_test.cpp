#include "scene/reader.h"

#include <cmath>
#include <sstream>

#include "scene_files.h"

namespace thermocontact::scene {
namespace {

const std::string heat_only = R"(
mesh.cells = [3, 2]
time = {end = 2, step = 0.1}
heat.conductivity = [[2, 1], [1, 2]]
)";

TEST(Reader, Defaults) {
    const Scene scene = read(base);
    EXPECT_EQ(scene.title, "");
    EXPECT_EQ(scene.dimension, 2);
    EXPECT_EQ(scene.degree, 1);
    EXPECT_EQ(scene.mesh.shape, "rectangle");
    EXPECT_EQ(scene.mesh.lower, (std::vector<double>{0, 0}));
    EXPECT_EQ(scene.mesh.upper, (std::vector<double>{1, 1}));
    EXPECT_EQ(scene.mesh.cells, (std::vector<int>{4, 4}));
    EXPECT_EQ(scene.mesh.diagonal, "right");
    EXPECT_EQ(scene.time.end, 1);
    EXPECT_EQ(scene.time.steps, 4);
    EXPECT_EQ(scene.time.scheme, "backward-euler");
    EXPECT_EQ(scene.solver.strategy, "auto");
    EXPECT_EQ(scene.solver.tolerance, 1e-12);
    EXPECT_EQ(scene.solver.max_iterations, 50);
    EXPECT_EQ(scene.output.every, 1);
    EXPECT_FALSE(scene.output.checkpoint_every);
    EXPECT_EQ(scene.output.fields, (std::vector<std::string>{"displacement", "velocity", "temperature",
                                                             "stress", "von_mises", "contact"}));
}

TEST(Reader, ACheckpointIntervalIsRead) {
    EXPECT_EQ(read(base, {"output.checkpoint_every=7"}).output.checkpoint_every, 7);
}

TEST(Reader, AbsentPhysicsIsAbsent) {
    const Scene scene = read(base);
    EXPECT_TRUE(scene.material->density);
    EXPECT_FALSE(scene.material->viscosity);
    EXPECT_FALSE(scene.heat->source);
    EXPECT_FALSE(scene.heat->thermal_stress);
    EXPECT_FALSE(scene.heat->strain_heating);
    EXPECT_TRUE(scene.body_force.empty());
    EXPECT_TRUE(scene.initial.displacement.empty());
    EXPECT_TRUE(scene.initial.velocity.empty());
    EXPECT_FALSE(scene.initial.temperature);
    EXPECT_EQ(scene.boundaries.size(), 2U);
    EXPECT_FALSE(scene.boundaries.at("top").contact);
    EXPECT_TRUE(scene.boundaries.at("top").traction.empty());
    EXPECT_TRUE(scene.boundaries.at("bottom").displacement.empty());
}

TEST(Reader, Contact) {
    const Contact contact = *read(base).boundaries.at("bottom").contact;
    EXPECT_TRUE(contact.gap.is_zero());
    EXPECT_EQ(contact.quadrature, 4);
    EXPECT_EQ(contact.compliance->constants.at("c_n"), 1e4);
    EXPECT_EQ(contact.compliance->constants.at("m"), 1);
    EXPECT_EQ(contact.friction->law.constants.at("mu"), 0.2);
    EXPECT_EQ(contact.friction->regularisation, 1e-3);
    EXPECT_EQ(contact.conductance->law.constants.at("k_c"), 1);
    EXPECT_EQ(contact.conductance->law.constants.at("eps_c"), 1e-5);
    EXPECT_EQ(contact.conductance->foundation_temperature({0, 0, 0}, 0), 10);
    EXPECT_TRUE(std::isinf(contact.conductance->law.constants.at("L")));
}

TEST(Reader, VertexQuadratureAndLimit) {
    const Scene scene = read(base, {"boundary.bottom.contact.quadrature=\"vertex\"",
                                    "boundary.bottom.contact.conductance.limit=5"});
    EXPECT_EQ(scene.boundaries.at("bottom").contact->quadrature, 0);
    EXPECT_EQ(scene.boundaries.at("bottom").contact->conductance->law.constants.at("L"), 5);
}

TEST(Reader, AnInfiniteLimitIsNone) {
    const Scene scene = read(base, {"boundary.bottom.contact.conductance.limit=inf"});
    EXPECT_TRUE(std::isinf(scene.boundaries.at("bottom").contact->conductance->law.constants.at("L")));
    EXPECT_FALSE(scene.resolved["boundary"]["bottom"]["contact"]["conductance"].contains("limit"));
}

TEST(Reader, HeatOnlyAndStepLength) {
    const Scene scene = read(heat_only);
    EXPECT_FALSE(scene.material);
    EXPECT_FALSE(scene.heat->capacity);
    EXPECT_EQ(scene.heat->conductivity->matrix, (std::vector<double>{2, 1, 1, 2}));
    EXPECT_EQ(scene.time.steps, 20);
    EXPECT_EQ(scene.output.fields, (std::vector<std::string>{"temperature"}));
    EXPECT_FALSE(scene.resolved["time"].contains("steps"));
}

TEST(Reader, StepLengthsDivideTheEndUpToRoundOff) {
    for (const int steps : {3, 7, 49, 1000, 999999}) {
        const double step = 1.0 / steps;
        std::ostringstream text;
        text.precision(17);
        text << "mesh.cells = [1, 1]\nheat.capacity = 1\ntime.end = 1\ntime.step = " << step << "\n";
        EXPECT_EQ(read(text.str()).time.steps, steps);
    }
}

TEST(Reader, MechanicsOnlyQuasiStatic) {
    const Scene scene = read(
        "mesh.cells = [1, 1]\ntime.end = 1\ntime.steps = 1\n"
        "material.viscosity = {trace = 1, shear = 2}\n");
    EXPECT_FALSE(scene.heat);
    EXPECT_FALSE(scene.material->density);
    EXPECT_FALSE(scene.material->elasticity);
    EXPECT_EQ(scene.material->viscosity->matrix, (std::vector<double>{3, 1, 0, 1, 3, 0, 0, 0, 1}));
}

TEST(Reader, ScalarTensorsMeanTheIdentity) {
    const Scene scene = read(base, {"heat.thermal_stress=-2", "heat.strain_heating=[[1,2],[2,1]]"});
    EXPECT_EQ(scene.heat->conductivity->matrix, (std::vector<double>{1, 0, 0, 1}));
    EXPECT_EQ(scene.heat->thermal_stress->matrix, (std::vector<double>{-2, 0, 0, -2}));
    EXPECT_EQ(scene.heat->strain_heating->matrix, (std::vector<double>{1, 2, 2, 1}));
}

TEST(Reader, StressAcrossThePlaneInPlaneStrainOnly) {
    const std::string scalar = "heat.thermal_stress=3", matrix = "heat.thermal_stress=[[3,0],[0,3]]";
    const std::string strain = "material.elasticity.plane=\"strain\"",
                      viscosity = "material.viscosity={trace=5,shear=1}";
    const Scene both = read(base, {scalar, strain, viscosity});
    EXPECT_EQ(both.heat->thermal_stress->out_of_plane, 3);
    EXPECT_EQ(both.material->viscosity->out_of_plane[0], 5);
    EXPECT_GT(both.material->elasticity->out_of_plane[0], 0);
    EXPECT_EQ(read(base, {matrix, strain}).heat->thermal_stress->out_of_plane, 0);
    const Scene stress = read(base, {scalar, viscosity});
    EXPECT_EQ(stress.heat->thermal_stress->out_of_plane, 0);
    EXPECT_EQ(stress.material->viscosity->out_of_plane[0], 0);
}

TEST(Reader, VoigtTensors) {
    const Scene scene = read(base, {"material.elasticity={tensor=[[4,1,0],[1,3,0.5],[0,0.5,2]]}"});
    EXPECT_EQ(scene.material->elasticity->matrix, (std::vector<double>{4, 1, 0, 1, 3, 0.5, 0, 0.5, 2}));
    EXPECT_EQ(scene.material->elasticity->out_of_plane, (std::vector<double>{0, 0, 0}));
    EXPECT_FALSE(scene.resolved["material"]["elasticity"].contains("plane"));
}

TEST(Reader, SingularTensorsAreAllowed) {
    EXPECT_EQ(message(base, {"heat.conductivity=[[1,1],[1,1]]"}), "");
    EXPECT_EQ(message(base, {"heat.conductivity=[[0.1,0.3],[0.3,0.9]]"}), "");
    EXPECT_EQ(message(base, {"material.viscosity={trace=-1,shear=2}"}), "");
}

TEST(Reader, FreeComponents) {
    const auto top = read(base, {"boundary.top.displacement=[\"free\",\"-0.1*t\"]"}).boundaries.at("top");
    EXPECT_FALSE(top.displacement[0]);
    EXPECT_EQ((*top.displacement[1])({0, 0, 0}, 2), -0.2);
}

TEST(Reader, TractionOnFreeComponentsAndZeros) {
    EXPECT_EQ(message(base, {"boundary.top.displacement=[\"free\",0]", "boundary.top.traction=[\"x\",0]"}),
              "");
    EXPECT_EQ(message(base, {"boundary.top.traction=[0,\"0\"]"}), "");
    EXPECT_EQ(
        message(base, {"boundary.bottom.traction=[1,\"x\"]", "boundary.bottom.heat_flux=1",
                       "boundary.bottom.displacement=[0,\"free\"]", "boundary.bottom.traction=[0,\"x\"]"}),
        "");
}

TEST(Reader, ExpressionsAreKeptAsWritten) {
    const Scene scene = read(base, {"heat.source=\"1.4*min(t/0.1,1)\"", "load.body_force=[0,\"-y\"]"});
    EXPECT_EQ(scene.resolved["heat"]["source"], "1.4*min(t/0.1,1)");
    EXPECT_EQ(scene.resolved["load"]["body_force"][1], "-y");
    EXPECT_EQ(scene.body_force[1]({0, 3, 0}, 0), -3);
}

/// "dotted.key = value" of every leaf.
std::vector<std::string> leaves(const nlohmann::ordered_json& table, const std::string& prefix) {
    std::vector<std::string> lines;
    for (const auto& [name, value] : table.items()) {
        if (!value.is_object()) {
            lines.push_back(prefix + name + " = " + value.dump());
            continue;
        }
        for (const std::string& line : leaves(value, prefix + name + ".")) {
            lines.push_back(line);
        }
    }
    return lines;
}

TEST(Reader, ResolvedIsASceneAgain) {
    const Scene scene = read(base, {"time.steps=8"});
    std::string text;
    for (const std::string& line : leaves(scene.resolved, "")) {
        text += line + "\n";
    }
    EXPECT_EQ(read(text).resolved, scene.resolved);
}

TEST(Reader, ByteOrderMarkAndWindowsLineEndings) {
    std::string text = "\xef\xbb\xbf";
    for (const char c : base) {
        text += c == '\n' ? "\r\n" : std::string(1, c);
    }
    EXPECT_EQ(message(text), "");
    EXPECT_EQ(message(text + "foo = 1\r\n").substr(0, 14), "scene.toml:26:");
}

}  // namespace
}  // namespace thermocontact::scene
