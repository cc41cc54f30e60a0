// A run that missed what was asked: what is offered in its place, and when it is gone on with.
#include "plan/achieved.h"

#include <gtest/gtest.h>

#include "support/scenes.h"

namespace thermocontact::plan {
namespace {

/// A plan whose models are told to be a hundred times too hopeful, so that its run errs by more than asked.
/// Of one kind of mesh and one stepping: among several, which is the cheapest depends on the machine and its
/// load.
class Missed : public testing::Test {
  protected:
    Missed() {
        plan = Planner(bench, {asked, {}, Quantity::norms}, false).make();
        plan.models.spaces.erase(plan.models.spaces.begin() + 1, plan.models.spaces.end());
        plan.models.times.erase(plan.models.times.begin() + 1, plan.models.times.end());
        const std::vector<double> hopeful(plan.components.size(), 0.01);
        for (SpaceModel& space : plan.models.spaces) {
            space.error.correct(hopeful);
        }
        for (TimeModel& time : plan.models.times) {
            time.error.correct(hopeful);
        }
        plan.chosen = cheapest(plan.models, aim_of_accuracy * asked, {1e9, 1e9});
        told = *achieved(plan, bench, *bench.run(plan.chosen->discretisation));
    }

    static constexpr double asked = 0.02;
    Bench bench{
        {std::filesystem::path(THERMOCONTACT_SCENES) / "heat-only.toml", {}}, Quantity::norms, nullptr, [] {
        }};
    Plan plan;
    Achieved told;
};

TEST_F(Missed, IsToldWithWhatMeetsIt) {
    ASSERT_GT(told.error, asked);
    ASSERT_TRUE(told.instead);
    EXPECT_LE(told.instead->error, aim_of_accuracy * asked);
    const Option &found = *told.instead, &before = *plan.chosen;
    EXPECT_TRUE(found.unknowns > before.unknowns ||
                found.discretisation.steps > before.discretisation.steps ||
                found.discretisation.tolerance < before.discretisation.tolerance)
        << "finer in space or in time: " << testing::PrintToString(told.settings) << " for "
        << testing::PrintToString(settings(bench.scene(), before.discretisation));
    EXPECT_FALSE(told.settings.empty());
}

TEST_F(Missed, IsGoneOnWithWhereThereIsTime) {
    ASSERT_TRUE(told.instead);
    EXPECT_FALSE(after_miss(plan, told, told.instead->seconds / 2));
    const auto next = after_miss(plan, told, 2 * told.instead->seconds);
    ASSERT_TRUE(next);
    EXPECT_EQ(next->settings, told.settings);
    EXPECT_EQ(next->chosen->error, told.instead->error);
    EXPECT_EQ(next->remarks.size(), 1u);
}

TEST_F(Missed, IsNotWhatWasMet) {
    told.instead.reset();
    EXPECT_FALSE(after_miss(plan, told, 1e9));
}

}  // namespace
}  // namespace thermocontact::plan
