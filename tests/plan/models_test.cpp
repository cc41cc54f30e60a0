/// Models of time from pilots whose costs are known, and what pilots near a choice correct.
#include "plan/models.h"

#include <gtest/gtest.h>

#include <cmath>

#include "march/kept_factors.h"
#include "plan/climb.h"
#include "plan/near_choice.h"
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
    costs.factorisations_keeping.assign(march::adaptive_factors, 2);
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
    EXPECT_NEAR(adaptive.factorisations.back().at(1e-4), 2, 1e-12);
}

TEST(SpaceModel, GrowsAlongAxesWithCells) {
    const auto axes = [](const std::string& name) { return refined_axes(bench_of(name).scene()); };
    EXPECT_EQ(axes("paper"), 2);
    EXPECT_EQ(axes("box"), 3);
    EXPECT_EQ(axes("benchmarks/rod-impact"), 1);
    EXPECT_EQ(axes("press-fit"), 2);  // of a file
}

/// Models that are wrong are put right by ladders near the choice; of a rod that nothing damps, too, whose
/// errors in time are differences to another scheme.
TEST(NearChoice, FindsWhatModelsAreOffBy) {
    for (const char* name : {"heat-only", "benchmarks/rod-impact"}) {
        Bench bench = bench_of(name);
        Study study = begin_study(bench, {0.1, {}, Quantity::norms}, 0.25);
        study_time(study);
        study_space(study);
        const auto option = cheapest(study.models, 0.06, {100, 1e6});
        ASSERT_TRUE(option);
        EXPECT_FALSE(is_near(study.models, option->discretisation));
        ASSERT_TRUE(learn_near(study, *option, 100));
        EXPECT_TRUE(is_near(study.models, option->discretisation));
        const Option right = assess(study.models, option->discretisation);
        const std::size_t components = right.space.size();
        space_of(study.models, option->discretisation).error.correct(std::vector<double>(components, 3));
        time_of(study.models, option->discretisation).error.correct(std::vector<double>(components, 0.5));
        EXPECT_FALSE(learn_near(study, *option, 100));  // nothing new was run
        const Option now = assess(study.models, option->discretisation);
        for (std::size_t c = 0; c < components; ++c) {
            EXPECT_NEAR(now.space[c], right.space[c], 1e-9) << name;
            EXPECT_NEAR(now.time[c], right.time[c], 1e-9) << name;
        }
        const auto finer_one = cheapest(study.models, 1e-3, {1e9, 1e9});
        EXPECT_FALSE(learn_near(study, finer_one.value(), 1e-9));  // no time for it
    }
}

/// A ladder that ends in a pilot too large for memory would be run in vain.
TEST(NearChoice, ClimbsNoLadderThatMemoryDoesNotHold) {
    Bench bench = bench_of("heat-only");
    Study study = begin_study(bench, {0.1, {}, Quantity::norms}, 0.25);
    study_time(study);
    study_space(study);
    auto option = cheapest(study.models, 0.06, {100, 1e6});
    ASSERT_TRUE(option);
    option->discretisation.scale = 1 << 14;
    EXPECT_FALSE(bench.fits(option->discretisation));
    EXPECT_FALSE(learn_near(study, *option, 1e30));
    EXPECT_TRUE(bench.fits({1, 2, bdf2, 8, 0}));
}

/// Of a choice much finer than the finest pilot of its kind nothing is known; of kinds that were not looked
/// at, nothing either.
TEST(NearChoice, IsWhereLaddersReach) {
    const Pilot coarse = pilot(1, 8, 1e-3), fine = pilot(2, 16, 4e-3);
    Models models;
    models.spaces.push_back(space_model(2, {&coarse, &fine}, ErrorCurve(1)));
    models.spaces.push_back(models.spaces[0]);
    models.spaces[1].degree = 2;
    models.times.push_back(time_model(bdf2, {{&coarse, &fine}, ErrorCurve(1)}));
    EXPECT_FALSE(is_near(models, {1, 2, bdf2, 16, 0}));
    EXPECT_EQ(near_only(models).spaces.size(), 2U);
    models.spaces[0].near = 1.0 / 4, models.times[0].near = 1.0 / 64;
    EXPECT_TRUE(is_near(models, {1, 6, bdf2, 96, 0}));
    EXPECT_TRUE(is_near(models, {1, 2, bdf2, 8, 0}));
    EXPECT_FALSE(is_near(models, {1, 8, bdf2, 96, 0}));
    EXPECT_FALSE(is_near(models, {1, 6, bdf2, 128, 0}));
    EXPECT_FALSE(is_near(models, {2, 2, bdf2, 16, 0}));
    EXPECT_EQ(near_only(models).spaces.size(), 1U);
}

/// Where pilots fail, finer ones are not tried without end.
TEST(Climb, EndsWherePilotsFail) {
    Bench bench(
        {std::filesystem::path(THERMOCONTACT_SCENES) / "paper-isotropic.toml", {"solver.max_iterations=1"}},
        Quantity::norms, nullptr, [] {});
    Comparison comparison(bench.scene(), Quantity::norms);
    const auto level = [](int number) {
        return number < 5 ? std::optional(Discretisation{1, 1 << number, bdf2, 8, 0}) : std::nullopt;
    };
    const auto knob = [](const Discretisation& choice) { return 1.0 / choice.scale; };
    EXPECT_TRUE(climb(bench, comparison, {level, knob, {2, 1, 2}, 4, 0, 1e-9}).pilots.empty());
    EXPECT_EQ(bench.runs(), 1);
    EXPECT_FALSE(bench.failure().empty());
}

TEST(Bench, FillsNoMemoryWithPilots) {
    Bench bench = bench_of("paper-isotropic");
    EXPECT_EQ(bench.run({2, 1 << 14, bdf2, 8, 0}), nullptr);
    EXPECT_NE(bench.failure().find("memory"), std::string::npos) << bench.failure();
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
