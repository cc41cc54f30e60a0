#include "plan/discretisation.h"

#include <gtest/gtest.h>

#include "error.h"
#include "plan/duration.h"
#include "plan/quantity.h"
#include "support/scenes.h"

namespace thermocontact::plan {
namespace {

using Cells = std::vector<int>;

Cells coarsest(const Cells& cells, const std::string& shape = "rectangle") {
    scene::Scene scene = support::repository_scene(shape == "box" ? "box" : "paper");
    scene.mesh.cells = cells;
    return coarsest_cells(scene);
}

TEST(Discretisation, CoarsestMeshHasTheScenesProportions) {
    EXPECT_EQ(coarsest({32, 32}), (Cells{4, 4}));
    EXPECT_EQ(coarsest({16, 4}), (Cells{8, 2}));
    EXPECT_EQ(coarsest({1, 256}), (Cells{1, 8}));
    EXPECT_EQ(coarsest({31, 32}), (Cells{31, 32}));
    EXPECT_EQ(coarsest({3, 3, 2}, "box"), (Cells{3, 3, 2}));
    EXPECT_EQ(scaled_cells({1, 8}, {1, 256}, 4), (Cells{1, 32}));
    EXPECT_EQ(scaled_cells({8, 2}, {16, 4}, 2), (Cells{16, 4}));
}

TEST(Discretisation, CoarserHasTheLargestProperDivisor) {
    EXPECT_EQ(coarser(16), 8);
    EXPECT_EQ(coarser(15), 5);
    EXPECT_EQ(coarser(7), 1);
    EXPECT_EQ(coarser(1), 1);
}

TEST(Discretisation, FinerHasTwiceTheCellsAndSteps) {
    const Discretisation fine = finer({2, 3, {"bdf2", false}, 24, 0}, true);
    EXPECT_EQ(fine.scale, 6);
    EXPECT_EQ(fine.steps, 48);
    EXPECT_EQ(finer({2, 1, {"bdf2", true}, 16, 1e-3}, false).scale, 1);
    EXPECT_LT(finer({2, 1, {"bdf2", true}, 16, 1e-3}, false).tolerance, 1e-3 / 2);
}

TEST(Discretisation, MeshesOfOneKindDifferInScaleOnly) {
    const Discretisation choice{2, 6, {"bdf2", false}, 96, 0, {{4, 16}, {1, 64}}};
    EXPECT_EQ(kind_of_mesh(choice), kind_of_mesh(coarser_in_space(coarser_in_time(choice))));
    EXPECT_NE(kind_of_mesh(choice), kind_of_mesh({2, 6, {"bdf2", false}, 96, 0}));
    EXPECT_NE(kind_of_mesh(choice), kind_of_mesh({2, 6, {"bdf2", false}, 96, 0, {{4, 16}, {64, 1}}}));
    EXPECT_EQ(steepest(choice.grading), 64);
    EXPECT_EQ(steepest({}), 1);
}

TEST(Discretisation, AxesAreHalvedAlone) {
    const scene::Scene scene = support::repository_scene("paper");  // 4 x 4 at scale 1
    const auto cells = [&](const Discretisation& choice) {
        return scaled_cells(coarsest_cells(scene), scene.mesh.cells, choice.scale, choice.stretch);
    };
    const Discretisation begin{2, 6, {"bdf2", false}, 96, 0, {{4, 16}, {1, 64}}};
    const auto flat = halved_along(begin, 1, scene.mesh.cells);
    ASSERT_TRUE(flat);
    EXPECT_EQ(cells(*flat), (Cells{24, 12}));
    EXPECT_EQ(kind_of_mesh(*flat), "degree 2 graded 4 16 1 64 stretched 2 1");
    EXPECT_EQ(cells(finer_in_space(*flat)), (Cells{48, 24}));
    const auto small = halved_along(*flat, 0, scene.mesh.cells);
    ASSERT_TRUE(small);
    EXPECT_EQ(cells(*small), (Cells{12, 12}));
    EXPECT_EQ(kind_of_mesh(*small), kind_of_mesh(begin));    // proportions as before
    EXPECT_FALSE(halved_along(*flat, 1, scene.mesh.cells));  // 12, of three coarsest meshes
    EXPECT_FALSE(halved_along(begin, 1, {32, 1}));           // an axis with one cell
}

/// What --set is told makes the scene that the pilots had.
void expect_same(const std::string& name, const Discretisation& choice) {
    const scene::Scene scene = support::repository_scene(name);
    const scene::Scene again = support::repository_scene(name, settings(scene, choice));
    const scene::Scene made =
        discretised(support::repository_scene(name, settings(choice.stepping, choice.tolerance)), choice);
    EXPECT_EQ(again.mesh.cells, made.mesh.cells);
    EXPECT_EQ(again.mesh.cell, made.mesh.cell);
    EXPECT_EQ(kind_of_mesh(1, again.mesh.grading), kind_of_mesh(1, made.mesh.grading)) << name;
    EXPECT_EQ(again.degree, made.degree);
    EXPECT_EQ(again.time.steps, made.time.steps) << name << " " << choice.steps;
    EXPECT_EQ(again.time.steps, choice.steps);
    EXPECT_EQ(again.time.scheme, made.time.scheme);
    EXPECT_EQ(again.time.tolerance, made.time.tolerance);
    EXPECT_EQ(again.time.spectral_radius, made.time.spectral_radius);
    EXPECT_EQ(again.solver.strategy, made.solver.strategy);
    EXPECT_EQ(made.solver.strategy, scene.mesh.file ? "auto" : "condensed") << "whatever the steps";
}

TEST(Discretisation, SettingsMakeTheSameScene) {
    expect_same("paper", {2, 6, {"bdf2", false}, 96, 0});
    expect_same("paper", {1, 3, {"generalized-alpha", false}, 8, 0});
    expect_same("box", {2, 2, {"midpoint", false}, 16, 0});
    expect_same("press-fit", {1, 1, {"bdf2", true}, 16, 3.7e-5});
    expect_same("paper", {2, 6, {"bdf2", false}, 96, 0, {{4, 16}, {1, 64}}});
    expect_same("box", {2, 2, {"midpoint", false}, 16, 0, {{4, 16}, {1, 64}, {1, 256}}});
    for (const int steps : {24, 672, 1208, 99960}) {  // the scene says "step"
        expect_same("benchmarks/rod-impact", {1, 4, {"backward-euler", false}, steps, 0});
    }
}

TEST(Duration, IsReadAsPeopleWriteIt) {
    EXPECT_EQ(parse_duration("30s"), 30);
    EXPECT_EQ(parse_duration("12"), 12);
    EXPECT_EQ(parse_duration("5m"), 300);
    EXPECT_EQ(parse_duration("5min"), 300);
    EXPECT_EQ(parse_duration("1.5h"), 5400);
    EXPECT_EQ(parse_duration("2e-1s"), 0.2);
    for (const char* bad :
         {"", "s", "0", "0s", "-3s", "30 s", "30d", "1h30m", "nan", "inf", "1e400", "1e307h"}) {
        EXPECT_EQ(parse_duration(bad), std::nullopt) << bad;
    }
}

TEST(Duration, IsToldInTwoDigits) {
    EXPECT_EQ(duration_text(0.01234), "0.012 s");
    EXPECT_EQ(duration_text(59.4), "59 s");
    EXPECT_EQ(duration_text(301), "5 min");
    EXPECT_EQ(duration_text(3 * 3600), "3 h");
}

std::string refusal(const std::function<void()>& action) {
    try {
        action();
    } catch (const SceneError& error) {
        return error.what();
    }
    return {};
}

TEST(Quantity, IsNamedAndFound) {
    for (const std::string& word : quantity_names()) {
        EXPECT_EQ(name(quantity_of(word)), word);
    }
    EXPECT_EQ(refusal([] { quantity_of("peak-pressure"); }),
              "--of: expected \"norms\", \"peak_pressure\", \"contact_force\", \"temperature\" or "
              "\"contact_share\", "
              "found \"peak-pressure\"; did you mean \"peak_pressure\"?");
}

TEST(Quantity, IsRefusedWhereTheSceneHasNotGotIt) {
    using Names = std::vector<std::string>;
    EXPECT_EQ(components_of(Quantity::norms, support::repository_scene("paper")),
              (Names{"velocity", "strain", "temperature"}));
    EXPECT_EQ(components_of(Quantity::norms, support::repository_scene("quasi-static")),
              (Names{"strain", "temperature"}));
    EXPECT_EQ(components_of(Quantity::norms, support::repository_scene("heat-only")), (Names{"temperature"}));
    EXPECT_EQ(components_of(Quantity::contact_share, support::repository_scene("paper")),
              (Names{"contact_share"}));
    EXPECT_EQ(
        refusal([] { components_of(Quantity::contact_share, support::repository_scene("no-contact")); }),
        "--of contact_share: the scene has no contact");
    EXPECT_EQ(refusal([] { components_of(Quantity::temperature, support::repository_scene("isothermal")); }),
              "--of temperature: the scene has no heat");
}

}  // namespace
}  // namespace thermocontact::plan
