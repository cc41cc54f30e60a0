/// Models of time from pilots whose costs are known, and what pilots near a choice correct.
#include "plan/models.h"

#include <gtest/gtest.h>

#include <cmath>

#include "plan/correction.h"
#include "plan/space_study.h"
#include "plan/time_study.h"

namespace thermocontact::plan {
namespace {

const Stepping bdf2{"bdf2", false};

Bench bench_of(const std::string& name) {
    return {
        {std::filesystem::path(THERMOCONTACT_SCENES) / (name + ".toml"), {}}, Quantity::norms, nullptr, [] {
        }};
}

/// Of degree 1; a step takes `step` seconds.
Pilot pilot(int scale, int steps, double step) {
    Costs costs;
    costs.setup = 1e-3 * scale * scale;
    costs.factor = 4e-3 * scale * scale;
    costs.factorisations = 2;
    costs.attempts = steps;
    costs.steps = steps * step;
    costs.unknowns = 100.0 * scale * scale;
    return {{1, scale, bdf2, steps, 0}, {}, costs};
}

TEST(SpaceModel, CostsOnePartOfARun) {
    const Pilot coarse = pilot(1, 8, 1e-3), fine = pilot(2, 8, 4e-3);
    const SpaceModel model = space_model(2, {&coarse, &fine}, ErrorCurve(1));
    EXPECT_NEAR(model.step.at(2), 4e-3, 1e-15);
    EXPECT_NEAR(model.factor.at(2), 8e-3, 1e-15);  // one of two
    EXPECT_NEAR(model.unknowns.at(4), 1600, 1e-9);
    EXPECT_NEAR(model.setup.at(4), 16e-3, 1e-15);
}

/// Pilots so small that nothing of theirs grows are followed by steps that read a factor beyond the caches;
/// what seems to grow faster than a factor's entries or operations does not go on so.
TEST(SpaceModel, GrowsAsFactorsDo) {
    const Pilot coarse = pilot(1, 8, 1e-3), level = pilot(2, 8, 1e-3), steep = pilot(2, 8, 1);
    EXPECT_NEAR(space_model(2, {&coarse, &level}, ErrorCurve(1)).step.at(4), 1e-3 * std::pow(2, 2.3), 1e-15);
    EXPECT_NEAR(space_model(3, {&coarse, &level}, ErrorCurve(1)).step.at(4), 1e-3 * std::pow(2, 3.5), 1e-15);
    EXPECT_NEAR(space_model(1, {&coarse, &level}, ErrorCurve(1)).step.at(4), 2e-3, 1e-15);  // a bar
    EXPECT_NEAR(space_model(2, {&coarse, &steep}, ErrorCurve(1)).step.at(4), std::pow(2, 2.4), 1e-12);
    EXPECT_NEAR(space_model(3, {&coarse, &steep}, ErrorCurve(1)).step.at(4), 16, 1e-12);
}

/// Of pilots of one scale the fastest: what else a machine does only adds.
TEST(Models, LearnFromTheFastestPilots) {
    const Pilot coarse = pilot(1, 8, 1e-3), busy = pilot(2, 16, 9e-3), idle = pilot(2, 8, 3e-3);
    Models models;
    models.spaces.push_back(space_model(2, {&coarse, &busy}, ErrorCurve(1)));
    EXPECT_NEAR(models.spaces[0].step.at(2), 9e-3, 1e-15);
    learn_costs(models, {&coarse, &busy, &idle}, 2);
    EXPECT_NEAR(models.spaces[0].step.at(2), 3e-3, 1e-15);
    const Pilot other = [] {
        Pilot result = pilot(2, 8, 1e-6);
        result.discretisation.degree = 2;
        return result;
    }();
    learn_costs(models, {&other}, 2);  // of another kind of mesh
    EXPECT_NEAR(models.spaces[0].step.at(2), 3e-3, 1e-15);
}

TEST(TimeModel, HasAsManyStepsAsItsKnobSays) {
    const Pilot coarse = pilot(1, 8, 1e-3), fine = pilot(1, 16, 1e-3);
    const TimeModel equal = time_model(bdf2, {{&coarse, &fine}, ErrorCurve(1)});
    EXPECT_NEAR(equal.attempts.at(1.0 / 64), 64, 1e-9);
    Pilot loose = coarse, tight = coarse;
    loose.discretisation.tolerance = 1e-2, loose.costs.attempts = 20;
    tight.discretisation.tolerance = 1e-3, tight.costs.attempts = 40;
    for (Pilot* adaptive : {&loose, &tight}) {
        adaptive->discretisation.stepping.adaptive = true;
    }
    const TimeModel adaptive = time_model({"bdf2", true}, {{&loose, &tight}, ErrorCurve(1)});
    EXPECT_NEAR(adaptive.attempts.at(1e-4), 80, 1e-9);
    EXPECT_NEAR(adaptive.factorisations.at(1e-4), 2, 1e-12);
}

TEST(SpaceModel, GrowsAlongAxesWithCells) {
    const auto axes = [](const std::string& name) { return refined_axes(bench_of(name).scene()); };
    EXPECT_EQ(axes("paper"), 2);
    EXPECT_EQ(axes("box"), 3);
    EXPECT_EQ(axes("benchmarks/rod-impact"), 1);
    EXPECT_EQ(axes("press-fit"), 2);  // of a file
}

/// Models that are wrong by a factor are put right by pilots near the choice.
TEST(Correction, FindsWhatModelsAreOffBy) {
    Bench bench = bench_of("heat-only");
    Study study = begin_study(bench, {0.1, {}, Quantity::norms}, 0.25);
    study_time(study);
    study_space(study);
    const auto option = cheapest(study.models, 0.06, {100, 1e6});
    ASSERT_TRUE(option && correct_near(study, *option, 100));
    const Option right = assess(study.models, option->discretisation);
    space_of(study.models, option->discretisation).error.correct({3});
    time_of(study.models, option->discretisation).error.correct({0.5});
    ASSERT_TRUE(correct_near(study, *option, 100));
    const Option now = assess(study.models, option->discretisation);
    EXPECT_NEAR(now.space[0], right.space[0], 1e-9);
    EXPECT_NEAR(now.time[0], right.time[0], 1e-9);
    EXPECT_FALSE(
        correct_near(study, cheapest(study.models, 1e-3, {1e9, 1e9}).value(), 1e-9));  // no time for it
}

/// A block that slides faster and faster has far more energy than its vibrations, which are lost to long
/// steps all the same.
TEST(Pilot, IsNotTakenInByARigidMotion) {
    Bench bench = bench_of("benchmarks/slope-slide");
    const Pilot* damped = bench.run({1, 2, {"backward-euler", false}, 128, 0});
    ASSERT_NE(damped, nullptr);
    EXPECT_GT(damped->damped, 0.5);
    const Pilot* kept = bench.run({1, 2, {"midpoint", false}, 1024, 0});
    ASSERT_NE(kept, nullptr);
    EXPECT_LT(kept->damped, 1e-2);  // its first step is one of backward Euler
}

}  // namespace
}  // namespace thermocontact::plan
