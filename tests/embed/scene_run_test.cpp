#include "embed/scene_run.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "error.h"
#include "march/simulation.h"
#include "support/scenes.h"

namespace thermocontact::embed {
namespace {

namespace fs = std::filesystem;

const support::Overrides small{"mesh.cells=[8,8]", "time.steps=4"};

fs::path scene_file(const std::string& name) {
    return fs::path(THERMOCONTACT_SCENES) / (name + ".toml");
}

/// Rows are sums of some hundred numbers of order 1, whose last bits depend on where the numbers lie in
/// memory: that says how sums are cut. 1e2 x 4 x 2e-16 = 1e-13.
void expect_equal_rows(const Values& values, const march::Record& row) {
    ASSERT_EQ(values.size(), row.size());
    for (const auto& [name, value] : row) {
        EXPECT_NEAR(values.at(name), value, 1e-13) << name;
    }
}

TEST(SceneRun, IsTheSimulationStepByStep) {
    const scene::Scene scene = support::repository_scene("paper", small);
    march::Simulation simulation(scene);
    SceneRun run(scene_file("paper"), small);
    EXPECT_EQ(run.dimension(), 2);
    EXPECT_EQ(run.nodes().size(), 81u);
    while (!simulation.finished()) {
        EXPECT_FALSE(run.finished());
        simulation.advance();
        run.advance();
        EXPECT_EQ(run.step(), simulation.state().step);
        EXPECT_EQ(run.time(), simulation.state().time);
        EXPECT_EQ(run.displacement(), simulation.state().displacement);
        EXPECT_EQ(run.velocity(), simulation.state().velocity);
        EXPECT_EQ(run.temperature(), simulation.state().temperature);
        expect_equal_rows(run.history(), simulation.record());
        EXPECT_NEAR(run.contact("bottom").at("normal_force"),
                    simulation.contact_measures().at("bottom").normal_force, 1e-13);
    }
    EXPECT_TRUE(run.finished());
    EXPECT_THROW(run.advance(), std::logic_error);
    EXPECT_THROW(run.contact("top"), std::out_of_range);
}

class SceneRunResults : public testing::Test {
  protected:
    SceneRunResults() : folder(fs::temp_directory_path() / ("scene-run-" + std::to_string(getpid()))) {}
    ~SceneRunResults() override { fs::remove_all(folder); }
    nlohmann::json summary() const { return nlohmann::json::parse(std::ifstream(folder / "summary.json")); }

    fs::path folder;
};

TEST_F(SceneRunResults, OfARunThatIsComplete) {
    SceneRun run(scene_file("paper"), small, folder);
    while (!run.finished()) {
        run.advance();
    }
    run.close();
    EXPECT_EQ(summary()["status"], "completed");
    EXPECT_FALSE(summary().contains("reason"));
    for (const auto& [name, value] : run.contact("bottom")) {
        EXPECT_EQ(summary()["final"]["contact"]["bottom"][name], value) << name;
    }
    EXPECT_EQ(summary()["scene"]["solver"]["strategy"], "auto");
    EXPECT_TRUE(fs::exists(folder / "history.csv"));
    EXPECT_TRUE(fs::exists(folder / "fields" / "body_000004.vtu"));
    EXPECT_TRUE(fs::exists(folder / "checkpoint.h5"));
}

TEST_F(SceneRunResults, OfARunThatIsEndedEarly) {
    SceneRun run(scene_file("paper"), small, folder);
    run.advance();
    run.close("enough seen");
    EXPECT_EQ(summary()["status"], "interrupted");
    EXPECT_EQ(summary()["reason"], "enough seen");
    EXPECT_EQ(summary()["steps"], 1);
    EXPECT_TRUE(fs::exists(folder / "fields" / "body_000001.vtu"));
    EXPECT_THROW(run.advance(), std::logic_error);
}

TEST_F(SceneRunResults, OfAStepThatFails) {
    support::Overrides breaking = small;
    breaking.emplace_back(R"TOML(load.body_force=["0", "t < 0.6 ? -1 : 1/(t - t)"])TOML");
    SceneRun run(scene_file("paper"), breaking, folder);
    run.advance();
    run.advance();
    EXPECT_THROW(run.advance(), NumericsError);
    EXPECT_EQ(run.step(), 2);
    EXPECT_EQ(summary()["status"], "failed");
    EXPECT_EQ(summary()["steps"], 2);
}

TEST(SceneRun, RefusesWhatTheLibraryHasNot) {
    EXPECT_THROW(SceneRun(scene_file("paper"), {"mesh.cels=[8,8]"}), SceneError);
    EXPECT_THROW(SceneRun(scene_file("paper"), {"solver.strategy=\"newton-krylov\""}), SystemError);
}

}  // namespace
}  // namespace thermocontact::embed
