/// Meshes of other proportions and gradings, found near a choice.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "plan/models.h"
#include "plan/orders.h"
#include "plan/proportions.h"
#include "plan/shapes_near.h"
#include "plan/time_study.h"

namespace thermocontact::plan {
namespace {

/// Heat, led along x so well that hardly anything changes there.
Bench bench_along_y() {
    return {{std::filesystem::path(THERMOCONTACT_SCENES) / "heat-only.toml",
             {"heat.conductivity=[[200.0,0.0],[0.0,0.5]]", "heat.source=1.0",
              "boundary.bottom.contact.gap=-1e-3"}},
            Quantity::norms,
            nullptr,
            [] {}};
}

double knob(const Discretisation& choice) {
    return 1.0 / choice.scale;
}

/// A study with one kind of mesh, of degree 2 and graded, and its ladder.
struct Near {
    Bench bench = bench_along_y();
    Study study = begin_study(bench, {0.01, {}, Quantity::norms}, 0.25);
    std::vector<const Pilot*> pilots;

    Near() {
        study_time(study);
        for (const int scale : {1, 2, 4}) {
            pilots.push_back(bench.run({2, scale, {"bdf2", false}, 16, 0, {{4, 4}, {4, 4}}}));
        }
        take_near(
            study, pilots,
            error_of(pilots, study.comparison, knob, highest_in_space(study.comparison.components(), 2)));
    }
};

TEST(Proportions, LeaveOutCellsThatMatterLittle) {
    Near near;
    const std::vector<double> before = near.study.models.spaces[0].error.at(1.0 / 4);
    const Pilot& kept = learn_proportions(near.study, near.pilots, 100);
    const std::vector<int>& stretch = kept.discretisation.stretch;
    ASSERT_EQ(stretch.size(), 2U);
    EXPECT_EQ(stretch[0], 1);
    EXPECT_EQ(stretch[1], 4);  // cells stay along y; along x only those of the coarsest mesh are left
    ASSERT_EQ(near.study.models.spaces.size(), 2U);
    const SpaceModel& found = near.study.models.spaces[1];
    EXPECT_EQ(found.stretch, stretch);
    EXPECT_EQ(found.near, 1.0 / kept.discretisation.scale);
    const double after = found.error.at(found.near)[0];
    EXPECT_GE(after, before[0]);  // nothing is gained by fewer cells
    const double halvings = std::log2(stretch[1]);
    EXPECT_LE(after, before[0] * std::pow(2, halvings * found.error.orders()[0] / 2));
    // as many cells along y, and the same there when finer
    EXPECT_NEAR(found.error.at(found.near / 2)[0] / after,
                near.study.models.spaces[0].error.at(1.0 / 8)[0] / before[0], 1e-9);
    EXPECT_LT(found.unknowns.at(kept.discretisation.scale), 0.3 * near.study.models.spaces[0].unknowns.at(4));
}

TEST(Proportions, TakeNoTimeThatIsNotThere) {
    Near near;
    const int runs = near.bench.runs();
    EXPECT_EQ(&learn_proportions(near.study, near.pilots, 0), near.pilots.back());
    learn_gradings(near.study, *near.pilots.back(), 0);
    EXPECT_EQ(near.bench.runs(), runs);
    EXPECT_EQ(near.study.models.spaces.size(), 1U);
}

TEST(Gradings, AreTriedAsFineAsTheChoice) {
    Near near;
    learn_gradings(near.study, *near.pilots.back(), 100);
    ASSERT_GT(near.study.models.spaces.size(), 1U);
    for (const SpaceModel& space : near.study.models.spaces) {
        EXPECT_EQ(space.near, 1.0 / 4);
        EXPECT_GE(steepest(space.grading), 4);
    }
}

TEST(Writing, IsMeasuredWhereResultsGo) {
    const auto folder = std::filesystem::temp_directory_path() / "thermocontact-writing-test";
    std::filesystem::remove_all(folder);
    std::filesystem::create_directory(folder);
    const Writing found = measured_writing(folder / "not" / "there");
    EXPECT_GT(found.files, 0);
    EXPECT_NE(found.files, Writing{}.files);
    EXPECT_GT(found.folder, 3e-3);
    EXPECT_LT(found.folder, 5);
    EXPECT_TRUE(std::filesystem::is_empty(folder));  // nothing is left
    std::filesystem::remove_all(folder);
    EXPECT_EQ(measured_writing("/proc/none/results").files, Writing{}.files);
}

}  // namespace
}  // namespace thermocontact::plan
