/// Results of a restarted run: continued in the folder of the run, begun in another one.
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <set>
#include <sstream>

#include "output/earlier_results.h"
#include "output/results.h"
#include "stopwatch.h"
#include "support/scenes.h"

namespace thermocontact::output {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

void put(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

class Restart : public testing::Test {
  protected:
    ~Restart() override { fs::remove_all(root); }

    /// Up to `steps`, from `earlier` on.
    void run(const fs::path& folder, int steps, const std::optional<Checkpoint>& earlier = {}) {
        march::Simulation simulation(scene);
        if (earlier) {
            simulation.resume(earlier->snapshot);
        }
        Results results({folder, simulation.team()}, scene, simulation, earlier ? &*earlier : nullptr);
        while (simulation.state().step < steps) {
            simulation.advance();
            results.add_step();
            if (results.checkpoint_is_due()) {
                results.add_checkpoint();
            }
        }
    }
    Checkpoint checkpoint(const fs::path& folder) const {
        return read_checkpoint(folder / "checkpoint.h5", scene);
    }
    /// Step of each row.
    static std::vector<int> rows(const fs::path& folder) {
        std::istringstream lines(content(folder / "history.csv"));
        std::string line;
        std::getline(lines, line);
        EXPECT_TRUE(line.starts_with("step,"));
        std::vector<int> steps;
        while (std::getline(lines, line)) {
            steps.push_back(std::stoi(line));
        }
        return steps;
    }
    static std::set<std::string> fields(const fs::path& folder) {
        std::set<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder / "fields")) {
            names.insert(entry.path().filename().string());
        }
        return names;
    }
    static void expect_same_fields(const fs::path& a, const fs::path& b) {
        EXPECT_EQ(content(a / "fields.pvd"), content(b / "fields.pvd"));
        EXPECT_EQ(fields(a), fields(b));
        for (const std::string& name : fields(a)) {
            EXPECT_EQ(content(a / "fields" / name), content(b / "fields" / name)) << name;
        }
    }

    scene::Scene scene = support::repository_scene(
        "paper", {"mesh.cells=[4,4]", "time.steps=9", "output.every=2", "output.checkpoint_every=3"});
    const fs::path root =
        fs::path(testing::TempDir()) / ("thermocontact-restart-" + std::to_string(getpid()) + "-" +
                                        testing::UnitTest::GetInstance()->current_test_info()->name());
    const fs::path whole = root / "whole", cut = root / "cut", other = root / "other";
};

TEST_F(Restart, InTheSameFolderContinues) {
    run(whole, 9);
    for (const int steps : {0, 1, 3, 4, 5, 8, 9}) {
        run(cut, steps);
        const Checkpoint earlier = checkpoint(cut);
        EXPECT_EQ(earlier.snapshot.state.step, steps / 3 * 3);
        run(cut, 9, earlier);
        EXPECT_EQ(rows(cut), (std::vector<int>{1, 2, 3, 4, 5, 6, 7, 8, 9})) << steps;
        expect_same_fields(whole, cut);
    }
}

/// Where the fields are going is part of the state, and what the factor in words proved to be of the systems.
TEST_F(Restart, WithAFactorInSinglePrecision) {
    scene = support::repository_scene("paper", {"mesh.cells=[4,4]", "time.steps=9", "output.every=2",
                                                "output.checkpoint_every=3", "solver.factor=\"single\""});
    run(whole, 9);
    for (const int steps : {0, 1, 4, 8, 9}) {
        run(cut, steps);
        run(cut, 9, checkpoint(cut));
        expect_same_fields(whole, cut);
    }
}

TEST_F(Restart, InAnotherFolderStartsAtTheCheckpoint) {
    run(cut, 4);
    run(other, 6);  // of another run
    run(other, 9, checkpoint(cut));
    EXPECT_EQ(rows(other), (std::vector<int>{4, 5, 6, 7, 8, 9}));
    EXPECT_TRUE(fields(other).contains("body_000003.vtu")) << "the state that it starts from";
    EXPECT_FALSE(fields(other).contains("body_000002.vtu"));
    EXPECT_EQ(rows(cut).size(), 4U) << "the other folder stays";
}

/// steps.csv is cut back to the checkpoint, and goes on as it did.
TEST_F(Restart, AdaptiveStepsContinue) {
    scene = support::repository_scene("paper", {"mesh.cells=[4,4]", "time.steps=6", "time.tolerance=3e-3",
                                                "output.every=2", "output.checkpoint_every=2"});
    run(whole, 6);
    const std::string steps = content(whole / "steps.csv");
    EXPECT_NE(steps.find(",rejected\n"), std::string::npos) << "nothing was rejected: the case tests little";
    for (const int stop : {0, 1, 3, 6}) {
        run(cut, stop);
        put(cut / "steps.csv", content(cut / "steps.csv") + std::to_string(stop + 1) + ",0.1");
        run(cut, 6, checkpoint(cut));
        EXPECT_EQ(content(cut / "steps.csv"), steps) << "stopped at " << stop;
        EXPECT_EQ(rows(cut), (std::vector<int>{1, 2, 3, 4, 5, 6}));
        expect_same_fields(whole, cut);
    }
    run(other, 6, checkpoint(cut));
    EXPECT_EQ(content(other / "steps.csv"), "") << "gone on with from the end";
    scene.time.tolerance.reset();
    run(cut, 6);
    EXPECT_FALSE(fs::exists(cut / "steps.csv")) << "of the run before";
}

/// A copy of the checkpoint elsewhere still belongs to the run; later results go, and its place is taken at
/// once, so that a kill right after leaves a folder that agrees with itself.
TEST_F(Restart, FromACopyOfAnEarlierCheckpoint) {
    run(whole, 9);
    run(cut, 3);
    const Checkpoint earlier = checkpoint(cut);
    run(cut, 9, earlier);
    EXPECT_EQ(checkpoint(cut).snapshot.state.step, 9);
    run(cut, 3, earlier);
    EXPECT_EQ(checkpoint(cut).snapshot.state.step, 3);
    EXPECT_EQ(rows(cut), (std::vector<int>{1, 2, 3}));
    run(cut, 9, earlier);
    expect_same_fields(whole, cut);
}

/// What a kill may leave: a row cut short, rows and fields beyond the checkpoint, a file being written,
/// fields that no collection names.
TEST_F(Restart, AfterAKillInTheMiddleOfWriting) {
    run(whole, 9);
    run(cut, 5);
    put(cut / "history.csv", content(cut / "history.csv") + "6,0.6");
    put(cut / "fields/body_000006.vtu", "half");
    put(cut / "fields/body_000004.vtu.part", "half");
    put(cut / "fields/contact_000008_p1.vtu", "of another number of processes");
    put(cut / "checkpoint.h5.part", "half");
    put(cut / "summary.json", "of before");
    put(cut / "fields/notes.txt", "mine");
    const Checkpoint earlier = checkpoint(cut);
    run(cut, 3, earlier);
    EXPECT_EQ(rows(cut), (std::vector<int>{1, 2, 3}));
    EXPECT_EQ(fields(cut), (std::set<std::string>{"body_000000.vtu", "body_000002.vtu", "contact_000000.vtu",
                                                  "contact_000002.vtu", "notes.txt"}));
    EXPECT_FALSE(fs::exists(cut / "summary.json"));
    run(cut, 9, earlier);
    fs::remove(cut / "fields/notes.txt");
    expect_same_fields(whole, cut);
}

/// No header yet, a header cut short, no file: the history starts anew.
TEST_F(Restart, HistoriesWithoutAHeader) {
    run(cut, 0);
    for (const char* left : {"", "step,ti", "step,time"}) {
        put(cut / "history.csv", left);
        EXPECT_FALSE(keep_rows(cut / "history.csv", 5)) << left;
    }
    fs::remove(cut / "history.csv");
    run(cut, 3, checkpoint(cut));
    EXPECT_EQ(rows(cut), (std::vector<int>{1, 2, 3}));
}

/// A new run removes the checkpoint of the one before: it would be one of another run's.
TEST_F(Restart, ANewRunHasACheckpointOfItsOwn) {
    run(cut, 9);
    const std::string before = checkpoint(cut).run;
    run(cut, 1);
    EXPECT_EQ(checkpoint(cut).snapshot.state.step, 0);
    EXPECT_NE(checkpoint(cut).run, before);
}

/// Without output.checkpoint_every one is due when it is cheap: not right after the last, but after a while.
TEST_F(Restart, CheckpointsThatNobodyAskedFor) {
    scene.output.checkpoint_every.reset();
    march::Simulation simulation(scene);
    fs::create_directories(cut);
    Checkpoints checkpoints(cut, scene, simulation, "run");
    checkpoints.write(Sync::no);
    EXPECT_FALSE(checkpoints.due());
    const Stopwatch stopwatch;  // fifty times what writing takes, which a busy machine may stretch
    while (!checkpoints.due() && stopwatch.seconds() < 60) {
        usleep(100'000);
    }
    EXPECT_TRUE(checkpoints.due());
    EXPECT_GT(stopwatch.seconds(), 0.5) << "not at once: one that waits for the disk takes a while";
}

}  // namespace
}  // namespace thermocontact::output
