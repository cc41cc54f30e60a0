#include "output/checkpoint.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "error.h"
#include "output/hdf5.h"
#include "output/same_scene.h"
#include "output/seal.h"
#include "output/summary.h"
#include "support/scenes.h"

namespace thermocontact::output {
namespace {

namespace fs = std::filesystem;

class CheckpointFile : public testing::Test {
  protected:
    ~CheckpointFile() override { fs::remove_all(file); }

    static scene::Scene paper(const support::Overrides& more = {}) {
        support::Overrides overrides = {"mesh.cells=[2,2]", "time.steps=8"};
        overrides.insert(overrides.end(), more.begin(), more.end());
        return support::repository_scene("paper", overrides);
    }
    void put(std::string_view bytes) const {
        std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    }
    /// Why it is refused under `scene`; empty: it is not.
    std::string refusal(const scene::Scene& scene) const {
        try {
            read_checkpoint(file, scene);
            return {};
        } catch (const SceneError& error) {
            const std::string start = "--restart " + file.string() + ": ", text = error.what();
            EXPECT_TRUE(text.starts_with(start)) << text;
            return text.substr(std::min(start.size(), text.size()));
        }
    }

    static Checkpoint example() {
        Checkpoint checkpoint{"a run", {}};
        checkpoint.snapshot.state = {5,
                                     0.625,
                                     {1, 0.1, -0.0},
                                     {1e-300, 2, 3},
                                     {4},
                                     {0.3, -7},
                                     0.125,
                                     {5},
                                     {6, 7},
                                     {8},
                                     0.25,
                                     2,
                                     {march::Nodal{17}, march::Nodal{21}, march::Nodal{22}},
                                     {march::Nodal{18}, march::Nodal{23}, march::Nodal{24}},
                                     3,
                                     -4,
                                     0.2,
                                     {9, 10},
                                     {11},
                                     {12},
                                     13,
                                     14,
                                     15,
                                     16,
                                     19,
                                     20};
        checkpoint.snapshot.totals = {17, 4,  2,     5,  6,   7,     0.25,  8,    9,
                                      10, 11, 4e-10, 12, 0.5, 1e-14, 2e-14, 3e-14};
        checkpoint.snapshot.kept = {{"momentum", {{0.125, {2, {0, 3}, {0.1, -7}}}, {0.5, {2, {1}, {3}}}}},
                                    {"heat", {{0.125, {1, {}, {}}}}}};
        return checkpoint;
    }

    const fs::path file = fs::path(testing::TempDir()) / ("checkpoint-" + std::to_string(getpid()) + ".h5");
};

TEST_F(CheckpointFile, ThereAndBack) {
    const Checkpoint written = example();
    put(to_bytes(written, paper()));
    const Checkpoint read = read_checkpoint(file, paper());
    EXPECT_EQ(read.run, "a run");
    EXPECT_EQ(run_of(file), "a run");
    EXPECT_EQ(read.snapshot.state.step, 5);
    EXPECT_EQ(read.snapshot.state.time, 0.625);
    EXPECT_EQ(read.snapshot.state.displacement, written.snapshot.state.displacement);
    EXPECT_TRUE(std::signbit(read.snapshot.state.displacement[2]));
    EXPECT_EQ(read.snapshot.state.velocity, written.snapshot.state.velocity);
    EXPECT_EQ(read.snapshot.state.temperature, written.snapshot.state.temperature);
    EXPECT_EQ(read.snapshot.state.last_step, 0.125);
    EXPECT_EQ(read.snapshot.state.displacement_rate, std::vector<double>{5});
    EXPECT_EQ(read.snapshot.state.velocity_rate, (std::vector<double>{6, 7}));
    EXPECT_EQ(read.snapshot.state.temperature_rate, std::vector<double>{8});
    EXPECT_EQ(read.snapshot.state.halvings, 3);
    EXPECT_EQ(read.snapshot.state.since_change, -4);
    EXPECT_EQ(read.snapshot.state.curvature_lag, 0.2);
    EXPECT_EQ(read.snapshot.state.displacement_curvature, (std::vector<double>{9, 10}));
    EXPECT_EQ(read.snapshot.state.velocity_curvature, std::vector<double>{11});
    EXPECT_EQ(read.snapshot.state.temperature_curvature, std::vector<double>{12});
    EXPECT_EQ(read.snapshot.state.displacement_scale, 13);
    EXPECT_EQ(read.snapshot.state.deformation_scale, 14);
    EXPECT_EQ(read.snapshot.state.velocity_scale, 15);
    EXPECT_EQ(read.snapshot.state.temperature_scale, 16);
    const march::Totals& totals = read.snapshot.totals;
    EXPECT_EQ(totals.iterations, 17);
    EXPECT_EQ(totals.max_iterations_in_a_step, 4);
    EXPECT_EQ(totals.retries, 2);
    EXPECT_EQ(totals.divided_steps, 5);
    EXPECT_EQ(totals.parts, 6);
    EXPECT_EQ(totals.failed_attempts, 7);
    EXPECT_EQ(totals.smallest_step, 0.25);
    EXPECT_EQ(totals.accepted, 8);
    EXPECT_EQ(totals.rejected, 9);
    EXPECT_EQ(totals.beyond_tolerance, 10);
    EXPECT_EQ(totals.at_round_off, 11);
    EXPECT_EQ(totals.round_off_residual, 4e-10);
    EXPECT_EQ(totals.cycles, 12);
    EXPECT_EQ(totals.error_sum, 0.5);
    EXPECT_EQ(totals.energy_residual, 1e-14);
    EXPECT_EQ(totals.heat_residual, 2e-14);
    EXPECT_EQ(totals.force_residual, 3e-14);
    ASSERT_EQ(read.snapshot.kept.size(), 2U);
    const std::vector<march::KeptSystem>& kept = read.snapshot.kept.at("momentum");
    ASSERT_EQ(kept.size(), 2U);
    EXPECT_EQ(kept[0].tau, 0.125);
    EXPECT_EQ(kept[0].derivative.unknowns, 2);
    EXPECT_EQ(kept[0].derivative.entries, (std::vector<std::int64_t>{0, 3}));
    EXPECT_EQ(kept[0].derivative.values, (std::vector<double>{0.1, -7}));
    EXPECT_EQ(kept[1].tau, 0.5);
    ASSERT_EQ(read.snapshot.kept.at("heat").size(), 1U);
    EXPECT_EQ(read.snapshot.kept.at("heat")[0].derivative.unknowns, 1);
}

/// A scene without mechanics has empty fields.
TEST_F(CheckpointFile, EmptyFields) {
    Checkpoint checkpoint;
    checkpoint.snapshot.state.step = 1;
    checkpoint.snapshot.state.temperature = {7};
    put(to_bytes(checkpoint, paper()));
    const Checkpoint read = read_checkpoint(file, paper());
    EXPECT_TRUE(read.snapshot.state.displacement.empty());
    EXPECT_EQ(read.snapshot.state.temperature, std::vector<double>{7});
    EXPECT_EQ(read.run, "");
}

/// Every bit in turn of the seal, and one bit of every 7th byte behind it.
TEST_F(CheckpointFile, DamageAnywhereIsNoticed) {
    const std::string whole = to_bytes(example(), paper());
    ASSERT_GT(whole.size(), 4000U);
    for (std::size_t i = 0; i < whole.size(); i += i < 512 ? 1 : 7) {
        for (const int bit : {0, 3, 7}) {
            std::string damaged = whole;
            damaged[i] = static_cast<char>(damaged[i] ^ (1 << bit));
            EXPECT_THROW(unseal(damaged), SceneError) << "byte " << i << ", bit " << bit;
        }
    }
    std::string damaged = whole;
    damaged[whole.size() / 2] = static_cast<char>(damaged[whole.size() / 2] ^ 1);
    put(damaged);
    EXPECT_EQ(refusal(paper()),
              "the file is cut short or damaged: its length or checksum is not what it states");
    EXPECT_FALSE(run_of(file));
}

TEST_F(CheckpointFile, CutShortAnywhereIsNoticed) {
    const std::string whole = to_bytes(example(), paper());
    for (std::size_t length = 0; length < whole.size(); length += length < 600 ? 1 : 61) {
        EXPECT_THROW(unseal(std::string_view(whole).substr(0, length)), SceneError) << length;
    }
    EXPECT_THROW(unseal(whole + '\0'), SceneError) << "longer";
    EXPECT_NO_THROW(unseal(whole));
    put(std::string_view(whole).substr(0, 100));
    EXPECT_EQ(refusal(paper()), "the file is cut short or damaged");
    put("");
    EXPECT_EQ(refusal(paper()), "this is not a checkpoint of thermocontact");
}

TEST_F(CheckpointFile, OtherFilesAreRefused) {
    EXPECT_EQ(refusal(paper()), "cannot read it: No such file or directory");
    put("\x89HDF\r\n\x1a\n and so on");
    EXPECT_EQ(refusal(paper()), "this is not a checkpoint of thermocontact");
    put(seal("no HDF5 at all"));
    EXPECT_EQ(refusal(paper()), "HDF5 cannot read this as one of its files");
    Hdf5Writer other;
    other.write("/version", version_text());
    put(seal(other.bytes()));
    EXPECT_EQ(refusal(paper()), "HDF5 cannot find /scene");
}

/// The folder of results instead of the file in it.
TEST_F(CheckpointFile, FoldersAreRefused) {
    fs::create_directory(file);
    EXPECT_EQ(refusal(paper()), "expected a checkpoint file, found a folder without a checkpoint.h5 in it");
    const fs::path inside = file / "checkpoint.h5";
    fs::create_directory(inside);
    EXPECT_EQ(refusal(paper()), "expected a checkpoint file, found a folder without a checkpoint.h5 in it");
    fs::remove(inside);
    std::ofstream(inside) << "whatever it holds";
    EXPECT_EQ(refusal(paper()),
              "expected a checkpoint file, found a folder; did you mean " + inside.string() + "?");
    EXPECT_FALSE(run_of(file));
}

TEST_F(CheckpointFile, OtherFormatsAndVersionsAreRefused) {
    std::string sealed = to_bytes(example(), paper());
    sealed.replace(sealed.find("format 1") + 7, 1, "7");
    put(sealed);
    EXPECT_EQ(refusal(paper()), "its format is 7, this program reads format 1");
    Hdf5Writer other;
    other.write("/version", std::string("0.0.9 (other forms)"));
    put(seal(other.bytes()));
    EXPECT_EQ(refusal(paper()),
              "it was written by thermocontact 0.0.9 (other forms), this is " + version_text());
}

TEST_F(CheckpointFile, OtherScenesAreRefusedByKey) {
    put(to_bytes(example(), paper()));
    EXPECT_EQ(refusal(paper({"material.density=2.0", "boundary.right.traction=[0.0, 0.4]"})),
              "it is of another scene: boundary.right.traction is [0.0,0.4] here and [-0.8,0.4] there; "
              "material.density is 2.0 here and 1.0 there");
    EXPECT_EQ(refusal(paper({"heat.source=2.0", "heat.capacity=2.0", "mesh.cells=[3,3]", "time.steps=9",
                             "initial.temperature=1.0", "material.density=3.0", "space.degree=2"})),
              "it is of another scene: heat.capacity is 2.0 here and 1.0 there; heat.source is 2.0 here and "
              "1.0 there; initial.temperature is 1.0 here and absent there; material.density is 3.0 here and "
              "1.0 there; mesh.cells is [3,3] here and [2,2] there; and 2 more");
}

TEST_F(CheckpointFile, WhatMayDiffer) {
    put(to_bytes(example(), paper()));
    EXPECT_EQ(refusal(paper({"title='longer'", "time.end=3.0", "time.steps=24"})), "")
        << "goes on for longer";
    EXPECT_EQ(refusal(paper({"output.every=3", "output.fields=[]", "output.checkpoint_every=2",
                             "solver.tolerance=1e-10", "solver.max_iterations=7"})),
              "");
    EXPECT_EQ(refusal(paper({"time.end=0.5", "time.steps=4"})),
              "it is at step 5, beyond the scene's last step 4");
    EXPECT_EQ(refusal(paper({"time.end=2.0"})),
              "it is of another scene: the time step is 0.25 here and 0.125 there");
}

/// A mesh file counts by what it says, not by its name.
TEST_F(CheckpointFile, MeshFiles) {
    scene::Scene scene = support::repository_scene("press-fit");
    put(to_bytes(example(), scene));
    EXPECT_EQ(refusal(scene), "");
    scene.resolved["mesh"]["file"] = "elsewhere.msh";
    EXPECT_EQ(refusal(scene), "");
    auto changed = std::make_shared<mesh::Mesh>(*scene.mesh.file);
    changed->points[3][0] += 1e-12;
    scene.mesh.file = changed;
    EXPECT_EQ(refusal(scene), "it is of another scene: the mesh file has other vertices, cells or names");
}

TEST(Runs, HaveNamesOfTheirOwn) {
    EXPECT_EQ(new_run().size(), 32U);
    EXPECT_NE(new_run(), new_run());
}

}  // namespace
}  // namespace thermocontact::output
