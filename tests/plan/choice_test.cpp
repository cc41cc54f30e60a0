#include "plan/choice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/text.h"

namespace thermocontact::plan {
namespace {

/// 0.5 x^order from x = 1 to 1/16.
ErrorCurve falling(double order) {
    Ladder ladder;
    const auto error = [&](double x) { return 0.5 * std::pow(x, order); };
    for (double x = 1; x > 0.05; x /= 2) {
        ladder.knobs.push_back(x);
        if (x > 0.1) {
            ladder.steps.push_back({error(x) - error(x / 2)});
            ladder.from_the_finest.push_back({error(x) - error(1.0 / 16)});
        }
    }
    ladder.sizes = {1};
    return {ladder, {order}};
}

LogCurve power(double factor, double exponent) {
    return {{1.0, 2.0}, {factor, factor * std::pow(2.0, exponent)}, exponent};
}

LogCurve constant(double value) {
    return {{1.0}, {value}, 0};
}

Models models() {
    Models result;
    for (const int degree : {1, 2}) {
        result.spaces.push_back({degree,
                                 {},
                                 falling(degree),
                                 constant(0.1),
                                 constant(0.01),
                                 power(1e-3 * degree * degree, 2),
                                 power(100, 2),
                                 constant(0),
                                 constant(0)});
    }
    result.times.push_back(
        {{"bdf2", false}, falling(2), {{1.0, 0.5}, {1.0, 2.0}, -1}, {constant(2)}, constant(0)});
    result.times.push_back(
        {{"backward-euler", false}, falling(1), {{1.0, 0.5}, {1.0, 2.0}, -1}, {constant(2)}, constant(0)});
    return result;
}

constexpr Limits no_limits{1e9, 1e9};

TEST(Choice, MeetsTheAimWithTheCheapestOfAll) {
    const Models all = models();
    const auto best = cheapest(all, 1e-2, no_limits);
    ASSERT_TRUE(best);
    EXPECT_LE(best->error, 1e-2);
    EXPECT_GT(best->error, 0.5e-2);  // no accuracy that was not asked for
    EXPECT_EQ(best->discretisation.degree, 2);
    EXPECT_EQ(best->discretisation.stepping.scheme, "bdf2");
    EXPECT_EQ(best->discretisation.steps % instants, 0);
    for (int scale = 2; scale < 64; scale += 2) {
        for (int parts = 1; parts < 40; ++parts) {
            for (const int degree : {1, 2}) {
                Discretisation other = best->discretisation;
                other.degree = degree;
                other.scale = scale;
                other.steps = instants * parts;
                const Option option = assess(all, other);
                // counts are a tenth apart at least
                EXPECT_TRUE(option.error > 1e-2 || option.seconds > best->seconds / 1.5)
                    << degree << " " << scale << " " << parts;
            }
        }
    }
}

TEST(Choice, AccountsForItsErrorAndTime) {
    const Models all = models();
    const Option option = assess(all, {2, 4, {"bdf2", false}, 32, 0});
    EXPECT_NEAR(option.space[0], 0.5 / 16, 1e-12);
    EXPECT_NEAR(option.time[0], 0.5 / 1024, 1e-12);
    EXPECT_NEAR(option.error, std::hypot(option.space[0], option.time[0]), 1e-15);
    EXPECT_NEAR(option.seconds, 0.1 + 2 * 0.01 + 32 * 4e-3 * 16 + Writing{}.folder + 32 * seconds_of_row,
                1e-9);
    EXPECT_NEAR(option.unknowns, 1600, 1e-9);
}

/// Files take what they do where they go.
TEST(Choice, CountsWhatIsWritten) {
    Models all = models();
    all.frames = 4;
    all.writing = {0.5, 0.25};
    for (SpaceModel& space : all.spaces) {
        space.frame = constant(0.125);
    }
    Models silent = all;
    silent.frames = 0;
    const Discretisation choice{2, 4, {"bdf2", false}, 32, 0};
    const double outputs = 1 + 32 / output_every(32, 4);
    EXPECT_NEAR(assess(all, choice).seconds - assess(silent, choice).seconds,
                outputs * (0.25 + writing_per_forming * 0.125), 1e-9);
    silent.writing.folder = 0;
    EXPECT_NEAR(assess(all, choice).seconds - assess(silent, choice).seconds,
                0.5 + outputs * (0.25 + writing_per_forming * 0.125), 1e-9);
}

TEST(Choice, TellsMeshesByTheirGrading) {
    Models all = models();
    SpaceModel graded = all.spaces[1];
    graded.grading = {{4, 4}, {1, 16}};
    graded.error.correct({0.01});
    all.spaces.push_back(graded);
    const auto best = cheapest(all, 1e-2, no_limits);
    ASSERT_TRUE(best);
    EXPECT_EQ(steepest(best->discretisation.grading), 16);
    EXPECT_NEAR(assess(all, best->discretisation).space[0], best->space[0], 1e-15);
    Discretisation coarse = best->discretisation;
    coarse.steps /= 2;
    const std::vector<double> apart = difference(all, coarse, best->discretisation);
    EXPECT_NEAR(apart[0], assess(all, coarse).time[0] - best->time[0], 1e-12);  // falling() lies on a line
}

TEST(Choice, KeepsToItsLimits) {
    const Models all = models();
    EXPECT_FALSE(cheapest(all, 1e-2, {1e-3, 1e9}));
    const auto small = cheapest(all, 1e-2, {1e9, 2000});
    EXPECT_FALSE(small && small->unknowns > 2000);
    EXPECT_FALSE(cheapest(all, 1e-30, no_limits));
}

TEST(Choice, SpendsABudgetOnAccuracy) {
    const Models all = models();
    const auto poor = most_accurate(all, {1.0, 1e9}), rich = most_accurate(all, {10.0, 1e9});
    ASSERT_TRUE(poor && rich);
    EXPECT_LE(poor->seconds, 1.0);
    EXPECT_LE(rich->seconds, 10.0);
    EXPECT_GT(rich->seconds, 5.0);
    EXPECT_LT(rich->error, poor->error / 2);
    EXPECT_FALSE(most_accurate(all, {1e-3, 1e9}));
}

/// Where memory does not hold the factors of all step sizes in use, they are made again.
TEST(Choice, CountsFactorsMadeAgain) {
    Models all = models();
    std::vector<LogCurve> made(12, constant(10));
    made[2] = constant(50), made[1] = constant(90), made[0] = constant(100);
    all.times = {{{"bdf2", true}, falling(2.0 / 3), power(30, -0.5), made, constant(0)}};
    for (SpaceModel& space : all.spaces) {
        space.factor_bytes = power(1e6, 2);
    }
    const Discretisation choice{1, 10, {"bdf2", true}, adaptive_steps, 1e-3};  // a factor of 1e8 bytes
    const double kept_all = assess(all, choice).seconds;
    const auto more = [&](double memory) {
        all.memory = memory;
        return (assess(all, choice).seconds - kept_all) / 0.01;
    };
    EXPECT_NEAR(more(13.6e8), 0, 1e-9) << "room for eleven beside the one that is made";
    EXPECT_NEAR(more(4.6e8), 40, 1e-9) << "two beside it";
    EXPECT_NEAR(more(3.4e8), 80, 1e-9) << "the latest one beside it stays";
    all.memory = 2.4e8;
    const auto best = cheapest(all, 1e-12, {1e12, 1e12});
    EXPECT_FALSE(best && best->discretisation.scale >= 10) << "no room to make one";
    const auto poor = most_accurate(all, {1e12, 1e12});
    ASSERT_TRUE(poor);
    EXPECT_LT(poor->discretisation.scale, 10);
}

TEST(Choice, TakesTheWorstComponent) {
    EXPECT_DOUBLE_EQ(total_error({0.1, 0.2}, {0.3, 0.1}, Sum::plain), 0.4);
    EXPECT_DOUBLE_EQ(total_error({0.3, 0.1}, {0.4, 0.1}, Sum::squares), 0.5);
}

TEST(Choice, ChoosesATolerance) {
    Models all = models();
    all.times = {{{"bdf2", true}, falling(2.0 / 3), power(30, -0.5), {constant(8)}, constant(0)}};
    const auto best = cheapest(all, 1e-2, no_limits);
    ASSERT_TRUE(best);
    EXPECT_LE(best->error, 1e-2);
    EXPECT_EQ(best->discretisation.steps, adaptive_steps);
    EXPECT_GT(best->discretisation.tolerance, 0);
    EXPECT_LE(scene::number_text(best->discretisation.tolerance).size(), 7U);  // two digits, said and run
}

}  // namespace
}  // namespace thermocontact::plan
