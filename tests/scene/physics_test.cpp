// Keys that make no sense without others, and files that are no scenes.

#include "scene_files.h"

namespace thermocontact::scene {
namespace {

const std::string frame = "mesh.cells = [1, 1]\ntime = {end = 1, steps = 1}\n";
const std::string heat = frame + "heat.capacity = 1\n";
const std::string mechanics = frame + "material.elasticity = {young = 1, poisson = 0}\n";

TEST(Physics, ASceneNeedsSome) {
    EXPECT_EQ(message(frame), "scene.toml: material: missing; a scene needs [material] or [heat] or both");
    EXPECT_EQ(message(frame + "material.density = 1"),
              "scene.toml:3: material: needs [material.elasticity] or [material.viscosity] or both");
    EXPECT_EQ(message(frame + "heat.source = 1"),
              "scene.toml:3: heat: needs capacity or conductivity or both");
    EXPECT_EQ(message(frame + "[heat]"), "scene.toml:3: heat: needs capacity or conductivity or both");
    EXPECT_EQ(message(heat), "");
    EXPECT_EQ(message(mechanics), "");
}

TEST(Physics, MechanicsIsNeeded) {
    const std::string lacking = ": needs material, which the scene lacks";
    for (const std::string key :
         {"load.body_force = [0, 0]", "initial.displacement = [0, 0]", "boundary.top.displacement = [0, 0]",
          "boundary.top.traction = [0, 0]", "boundary.top.spring.stiffness = 1",
          "boundary.top.contact.compliance.stiffness = 1", "heat.thermal_stress = 1",
          "heat.strain_heating = 1"}) {
        EXPECT_EQ(message(heat + key), "scene.toml:4: " + key.substr(0, key.find(' ')) + lacking);
    }
}

TEST(Physics, HeatIsNeeded) {
    const std::string lacking = ": needs heat, which the scene lacks";
    for (const std::string key :
         {"initial.temperature = 0", "boundary.top.temperature = 0", "boundary.top.heat_flux = 0",
          "boundary.top.contact.conductance.onset = 1"}) {
        EXPECT_EQ(message(mechanics + key), "scene.toml:4: " + key.substr(0, key.find(' ')) + lacking);
    }
}

TEST(Physics, AnInitialVelocityNeedsInertia) {
    EXPECT_EQ(message(mechanics + "initial.velocity = [0, 0]"),
              "scene.toml:4: initial.velocity: needs material.density, which the scene lacks");
    EXPECT_EQ(message(mechanics + "initial.velocity = [0, 0]\nmaterial.density = 1"), "");
}

TEST(Physics, FieldsThatTheSceneLacks) {
    EXPECT_EQ(
        message(mechanics + "output.fields = [\"stress\", \"temperature\"]"),
        "scene.toml:4: output.fields: \"temperature\" is no field of this scene, which has \"displacement\", "
        "\"velocity\", \"stress\" or \"von_mises\"");
    EXPECT_EQ(
        message(heat + "output.fields = [\"contact\"]"),
        "scene.toml:4: output.fields: \"contact\" is no field of this scene, which has \"temperature\"");
    EXPECT_EQ(message(heat + "output.fields = []"), "");
}

TEST(Physics, TheElasticityTensorMustBeFinite) {
    EXPECT_EQ(message(frame + "material.elasticity = {young = 1e308, poisson = 0.4999, plane = \"strain\"}"),
              "scene.toml:3: material.elasticity.young: the elasticity tensor overflows, found 1e+308");
}

TEST(Files, SyntaxErrors) {
    EXPECT_EQ(message("[mesh]\ncells = [4, 4\n[time]\n").substr(0, 33), "scene.toml:3: not valid TOML: Err");
    EXPECT_EQ(message("[mesh]\ncells = \n").substr(0, 30), "scene.toml:2: not valid TOML: ");
    EXPECT_EQ(message("[mesh]\nshape = rectangle\n").substr(0, 30), "scene.toml:2: not valid TOML: ");
    EXPECT_EQ(message("[mesh]\n[mesh]\n"),
              "scene.toml:2: not valid TOML: Error while parsing table header: cannot redefine existing "
              "table 'mesh' "
              "(column 1)");
    EXPECT_EQ(message("a = 1\na = 2\n").substr(0, 30), "scene.toml:2: not valid TOML: ");
}

TEST(Files, AreOneLineOfMessage) {
    for (const char* text : {"title = \"\"\"a\nb\"\"\"\ntitel = 1", "mesh.cells = \"\"\"\n4\n4\"\"\"",
                             "mesh.cells = [\n1,\n2,\n3]", "heat.source = \"\"\"\n1+\n*\"\"\""}) {
        EXPECT_EQ(message(text).find('\n'), std::string::npos);
        EXPECT_NE(message(text), "");
    }
}

TEST(Files, NotText) {
    EXPECT_EQ(message("title = \"\xff\xfe\"\n").substr(0, 30), "scene.toml:1: not valid TOML: ");
    EXPECT_EQ(message(std::string("title = \"a\0b\"\n", 14)).substr(0, 30), "scene.toml:1: not valid TOML: ");
    EXPECT_EQ(message(std::string(5 << 20, ' ')), "scene.toml: larger than 4 MiB, hence no scene file");
    EXPECT_EQ(message(""),
              "scene.toml: mesh.cells: missing; add cells = [8, 4], or file = \"part.msh\" to [mesh]");
}

TEST(Files, NestingWithoutEnd) {
    std::string deep = "a";
    for (int i = 0; i < 100'000; ++i) {
        deep += ".a";
    }
    EXPECT_EQ(message("[mesh]\n" + deep + " = 1\n"), "scene.toml:2: more than 100 dots in one line");
    EXPECT_EQ(message("a = " + std::string(100'000, '[')).substr(0, 13), "scene.toml:1:");
    std::string headers = "[" + deep.substr(0, 161) + "]\n" + deep.substr(0, 161) + " = 1\n";
    EXPECT_EQ(message(headers).substr(0, 14), "scene.toml:2: ");
    EXPECT_NE(message(headers).find("tables nested too deeply"), std::string::npos);
    std::string arrays = "a = ";
    for (int i = 0; i < 300; ++i) {
        arrays += "[{" + deep.substr(0, 199) + " = \n";
    }
    EXPECT_NE(message(arrays), "");
    EXPECT_EQ(message("# " + std::string(200, '.') + "\n" + heat), "");
}

TEST(Files, Unreadable) {
    const SceneFile file(base);
    const auto what = [](const std::filesystem::path& path) -> std::string {
        try {
            read_scene(path);
            return {};
        } catch (const SceneError& error) {
            return error.what();
        }
    };
    EXPECT_EQ(what(file.directory()), file.directory().string() + ": is a directory, expected a scene file");
    const auto missing = file.directory() / "missing.toml";
    EXPECT_EQ(what(missing), missing.string() + ": no such file");
    EXPECT_EQ(what(file.path()), "");
}

}  // namespace
}  // namespace thermocontact::scene
