/// Whole plans on small requests: what is promised is kept, what cannot be promised is refused.
#include "plan/planner.h"

#include <gtest/gtest.h>

#include "plan/achieved.h"
#include "plan/report.h"
#include "support/scenes.h"

namespace thermocontact::plan {
namespace {

Bench bench_of(const std::string& name, Quantity quantity = Quantity::norms) {
    return {{std::filesystem::path(THERMOCONTACT_SCENES) / (name + ".toml"), {}}, quantity, nullptr, [] {}};
}

/// The largest relative error of a run against one of four times its cells, degree 2 and four times its
/// steps, whose own is less than a quarter of it for orders of at least 1.
double true_error(Bench& bench, const Pilot& run, Quantity quantity) {
    Discretisation finer = run.discretisation;
    finer.scale *= 4;
    finer.steps *= 4;
    finer.tolerance /= 64;
    const Pilot* reference = bench.run(finer);
    Comparison comparison(bench.scene(), quantity);
    const auto apart = comparison.difference(run, *reference), size = comparison.size(*reference);
    double largest = 0;
    for (std::size_t c = 0; c < size.size(); ++c) {
        largest = std::max(largest, apart[c] / size[c]);
    }
    return largest;
}

TEST(Planner, KeepsWhatItPromises) {
    for (const char* name : {"heat-only", "paper-isotropic"}) {
        constexpr double asked = 0.2;
        Bench bench = bench_of(name);
        const Plan plan = Planner(bench, {asked, {}, Quantity::norms}, false).make();
        ASSERT_TRUE(plan.chosen) << name << plan.refusal;
        EXPECT_LE(plan.chosen->error, aim_of_accuracy * asked);
        const Pilot* run = bench.run(plan.chosen->discretisation);
        ASSERT_NE(run, nullptr);
        const double error = true_error(bench, *run, Quantity::norms);
        EXPECT_LE(error, asked) << name;
        EXPECT_GE(error, asked / 10) << name;  // at large errors models are rough, but not blind
        const auto told = achieved(plan, bench, *run);
        ASSERT_TRUE(told);
        EXPECT_LE(told->error, 3 * error) << name;
        EXPECT_GE(told->error, error / 3) << name;
        EXPECT_NE(text(plan, "scene.toml").find("thermocontact run scene.toml --set mesh.cells="),
                  std::string::npos);
        const auto json = to_json(plan, 1.5, told);
        EXPECT_EQ(json["achieved"]["error"], told->error);
        EXPECT_EQ(json["achieved"]["seconds"], 1.5);
        EXPECT_EQ(json["predicted"]["error"], plan.chosen->error);
    }
}

TEST(Planner, RefusesWhatItCannotPromise) {
    Bench bench = bench_of("paper");
    const Plan plan = Planner(bench, {1e-7, 1.0, Quantity::norms}, false).make();
    EXPECT_FALSE(plan.chosen);
    EXPECT_NE(plan.refusal.find("cannot be promised"), std::string::npos) << plan.refusal;
    ASSERT_TRUE(plan.best);
    EXPECT_GT(plan.best->error, 1e-7);
}

TEST(Planner, SpendsNoMoreThanItsBudget) {
    Bench bench = bench_of("paper-isotropic");
    const Plan plan = Planner(bench, {{}, 2.0, Quantity::norms}, false).make();
    ASSERT_TRUE(plan.chosen);
    EXPECT_LE(plan.chosen->seconds, 2.0);
    ASSERT_TRUE(plan.cheaper);
    EXPECT_LT(plan.cheaper->seconds,
              plan.chosen->seconds / 2);  // the next offer is half a digit of time away
    EXPECT_GT(plan.cheaper->error, plan.chosen->error);
    EXPECT_LT(plan.chosen->error, 0.2);
}

TEST(Planner, LeavesTheMeshOfAFileAlone) {
    Bench bench = bench_of("press-fit", Quantity::temperature);
    const Plan plan = Planner(bench, {0.1, {}, Quantity::temperature}, false).make();
    ASSERT_TRUE(plan.chosen) << plan.refusal;
    for (const std::string& setting : plan.settings) {
        EXPECT_FALSE(setting.starts_with("mesh.")) << setting;
    }
    EXPECT_NE(text(plan, "s").find("error of space is not controlled"), std::string::npos);
}

}  // namespace
}  // namespace thermocontact::plan
