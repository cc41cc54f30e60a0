// `--set KEY=VALUE`.

#include "scene_files.h"

namespace thermocontact::scene {
namespace {

TEST(Override, BeatsTheFile) {
    const Scene scene = read(base, {"mesh.cells=[32,16]", " time.end = 2 ", "title='a=b'"});
    EXPECT_EQ(scene.mesh.cells, (std::vector<int>{32, 16}));
    EXPECT_EQ(scene.time.end, 2);
    EXPECT_EQ(scene.title, "a=b");
    EXPECT_EQ(scene.resolved["time"]["end"], 2.0);
}

TEST(Override, TheLastOneCounts) {
    EXPECT_EQ(read(base, {"time.steps=8", "time.steps=16"}).time.steps, 16);
    EXPECT_EQ(read(base, {"time.steps=0", "time.steps=16"}).time.steps, 16);
}

TEST(Override, MakesTablesAsNeeded) {
    const Scene scene = read(base, {"boundary.left.contact.compliance.stiffness=5"});
    EXPECT_EQ(scene.boundaries.at("left").contact->compliance->constants.at("c_n"), 5);
    EXPECT_EQ(scene.boundaries.at("left").contact->quadrature, 4);
}

TEST(Override, ReplacesWholeTables) {
    const Scene scene = read(base, {"boundary.bottom.contact={compliance={stiffness=5}}"});
    EXPECT_EQ(scene.boundaries.at("bottom").contact->compliance->constants.at("c_n"), 5);
    EXPECT_FALSE(scene.boundaries.at("bottom").contact->friction);
    EXPECT_EQ(read(base, {"time={end=3,step=1}"}).time.steps, 3);
    EXPECT_EQ(message(base, {"boundary.bottom={}"}), "");
}

TEST(Override, LiftsMistakesOfTheFile) {
    EXPECT_NE(message(with_line(5, "steps = 0")), "");
    EXPECT_EQ(message(with_line(5, "steps = 0"), {"time.steps=3"}), "");
}

TEST(Override, MistakesNameTheArgument) {
    EXPECT_EQ(message(base, {"time.end=1", "material.density=-1"}),
              "--set material.density=-1: material.density: expected a number > 0 (kg/m^3), found -1");
    EXPECT_EQ(message(base, {"boundary.bottom.contact.friction.coefficent=1"}),
              "--set boundary.bottom.contact.friction.coefficent=1: "
              "boundary.bottom.contact.friction.coefficent: unknown key; did you mean \"coefficient\"?");
    EXPECT_EQ(
        message(base, {"heat.source=\"sinn(x)\""}),
        "--set heat.source=\"sinn(x)\": heat.source: bad expression \"sinn(x)\": unknown name \"sinn\" at "
        "character 1; did you mean \"sin\"?");
    EXPECT_EQ(
        message(base, {"boundary.left.contact.compliance={}"}),
        "--set boundary.left.contact.compliance={}: boundary.left.contact.compliance.stiffness: missing; "
        "add stiffness = 10000.0 to [boundary.left.contact.compliance]");
}

TEST(Override, ConflictsNameBothPlaces) {
    EXPECT_EQ(
        message(base, {"time.step=0.25"}),
        "--set time.step=0.25: time.step: cannot stand beside time.steps (line 5); give one of the two");
    EXPECT_EQ(message(base, {"boundary.left.temperature=1", "boundary.left.heat_flux=1"}),
              "--set boundary.left.heat_flux=1: boundary.left.heat_flux: cannot stand beside "
              "boundary.left.temperature (--set boundary.left.temperature=1); give one of the two");
}

TEST(Override, Syntax) {
    EXPECT_EQ(message(base, {"time.scheme=backward-euler"}),
              "--set time.scheme=backward-euler: time.scheme: the value is not valid TOML; "
              "a string needs quotes: --set 'time.scheme=\"backward-euler\"'");
    EXPECT_EQ(message(base, {"load.body_force=[0,-t]"}),
              "--set load.body_force=[0,-t]: load.body_force: the value is not valid TOML; strings in it "
              "need quotes");
    EXPECT_EQ(message(base, {"mesh.cells"}),
              "--set mesh.cells: expected KEY=VALUE, for instance --set mesh.cells=[32,32]");
    EXPECT_EQ(message(base, {"time.end="}), "--set time.end=: time.end: the value is not valid TOML");
    EXPECT_EQ(message(base, {"=3"}),
              "--set =3: expected a dotted key such as mesh.cells before \"=\", found \"\"");
    for (const char* bad : {"", "mesh..cells=1", ".mesh=1", "mesh.=1", "mesh cells=1", "\"mesh\".cells=1",
                            "a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a=1"}) {
        EXPECT_NE(message(base, {bad}), "") << bad;
    }
}

TEST(Override, IsOneValue) {
    EXPECT_EQ(message(base, {"time.end=1\ntime.steps=2"}),
              "--set time.end=1\\ntime.steps=2: time.end: one value expected");
    EXPECT_EQ(message(base, {"time.end=1\n[mesh]\ncells=[1,1]"}),
              "--set time.end=1\\n[mesh]\\ncells=[1,1]: time.end: one value expected");
    EXPECT_EQ(message(base, {"time.end=1 # as before"}), "");
}

TEST(Override, ThroughAValue) {
    EXPECT_EQ(message(base, {"mesh.cells.x=3"}),
              "--set mesh.cells.x=3: mesh.cells: is no table but [4, 4] (scene.toml:2)");
    EXPECT_EQ(message(base, {"material=5"}), "--set material=5: material: expected a table, found 5");
}

}  // namespace
}  // namespace thermocontact::scene
