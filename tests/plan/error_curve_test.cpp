#include "plan/error_curve.h"

#include <gtest/gtest.h>

#include <cmath>

namespace thermocontact::plan {
namespace {

/// Runs whose error is `constant` * x^order in one component, refined `levels` times from x = 1; the runs lie
/// on a line, as those of one dominant term do.
Ladder power_law(double constant, double order, int levels, double size = 1) {
    Ladder ladder;
    const auto error = [&](int level) { return constant * std::pow(0.5, order * level); };
    for (int level = 0; level < levels; ++level) {
        ladder.knobs.push_back(std::pow(0.5, level));
        if (level + 1 < levels) {
            ladder.steps.push_back({error(level) - error(level + 1)});
            ladder.from_the_finest.push_back({error(level) - error(levels - 1)});
        }
    }
    ladder.sizes = {size};
    return ladder;
}

TEST(LogCurve, GoesThroughItsPointsAndOn) {
    const LogCurve falling({1.0, 0.5, 0.25}, {8.0, 4.0, 1.0}, 3);
    EXPECT_DOUBLE_EQ(falling.at(0.5), 4);
    EXPECT_DOUBLE_EQ(falling.at(0.25), 1);
    EXPECT_DOUBLE_EQ(falling.at(0.125), 1.0 / 8);
    EXPECT_NEAR(falling.at(std::sqrt(0.125)), 2, 1e-12);
    EXPECT_NEAR(falling.at(2.0), 16, 1e-12);
    const LogCurve rising({1.0, 2.0}, {1.0, 4.0}, 1.5);
    EXPECT_NEAR(rising.at(std::sqrt(2.0)), 2, 1e-12);
    EXPECT_NEAR(rising.at(8.0), 4 * 8, 1e-12);
    EXPECT_DOUBLE_EQ(LogCurve({2.0}, {5.0}, 0).at(7.0), 5);
    EXPECT_DOUBLE_EQ(LogCurve::last_slope({1.0, 2.0}, {1.0, 4.0}, 9), 2);
    EXPECT_DOUBLE_EQ(LogCurve::last_slope({1.0}, {1.0}, 9), 9);
}

TEST(ErrorCurve, FindsAnOrderBelowTheorysAndTheErrorLeft) {
    for (const double order : {0.4, 0.73, 1.3}) {
        const ErrorCurve curve(power_law(0.3, order, 5, 2.0), {2.0});
        EXPECT_NEAR(curve.orders()[0], order, 1e-12);
        for (const double knob : {1.0, 0.25, 0.0625, 0.01}) {  // the last one beyond the finest
            EXPECT_NEAR(curve.at(knob)[0], 0.15 * std::pow(knob, order), 1e-12) << order << " " << knob;
        }
    }
}

/// Runs whose error is x^order, each refinement taking off another part of it: differences are orthogonal.
Ladder projections(double order, int levels) {
    Ladder ladder = power_law(1, order, levels);
    const auto square = [&](int level) { return std::pow(0.25, order * level); };
    for (int level = 0; level + 1 < levels; ++level) {
        const auto at = static_cast<std::size_t>(level);
        ladder.steps[at] = {std::sqrt(square(level) - square(level + 1))};
        ladder.from_the_finest[at] = {std::sqrt(square(level) - square(levels - 1))};
    }
    return ladder;
}

TEST(ErrorCurve, SeesThatProjectionsDifferByMoreThanTheirErrors) {
    for (const double order : {0.5, 1.0, 1.7}) {
        const ErrorCurve curve(projections(order, 4), {2.0});
        EXPECT_NEAR(curve.orders()[0], order, 1e-12);
        for (const double knob : {1.0, 0.5, 0.125, 0.01}) {
            EXPECT_NEAR(curve.at(knob)[0], std::pow(knob, order), 1e-12) << order << " " << knob;
        }
        EXPECT_NEAR(curve.between(0.5, 0.25)[0], projections(order, 4).steps[1][0], 1e-12) << order;
    }
    const ErrorCurve straight(power_law(1, 1, 4), {2.0});
    EXPECT_NEAR(straight.between(0.5, 0.25)[0], 0.25, 1e-12);
}

TEST(ErrorCurve, AddsErrorsAndDifferencesAsSidesOfATriangle) {
    EXPECT_DOUBLE_EQ(error_beside(3, 4, 0), 5);
    EXPECT_DOUBLE_EQ(error_beside(3, 4, 1), 7);
    EXPECT_DOUBLE_EQ(difference_between(5, 3, 0), 4);
    EXPECT_DOUBLE_EQ(difference_between(7, 3, 1), 4);
    EXPECT_DOUBLE_EQ(difference_between(error_beside(3, 4, 0.3), 3, 0.3), 4);
    EXPECT_DOUBLE_EQ(difference_between(3, 5, 0.5), 0);  // a coarser run that errs less: nothing is foreseen
}

TEST(ErrorCurve, TrustsNoOrderAboveTheorys) {
    const ErrorCurve curve(power_law(1, 3, 4), {1.0});
    EXPECT_DOUBLE_EQ(curve.orders()[0], 1);
    EXPECT_GT(curve.at(0.125)[0], std::pow(0.125, 3));
}

/// Errors that fall as stairs do: the order is that of the way down, not of one stair.
TEST(ErrorCurve, LooksAtMoreThanOneStair) {
    Ladder ladder = power_law(1, 1, 4);
    ladder.steps = {{1.0}, {0.25}, {0.25}};
    EXPECT_NEAR(ErrorCurve(ladder, {3.0}).orders()[0], 1, 1e-12);
    Ladder longer = power_law(1, 1, 5);
    longer.steps = {{1.0}, {0.5}, {0.5}, {0.125}};
    EXPECT_NEAR(ErrorCurve(longer, {3.0}).orders()[0], 1, 1e-12);
}

/// One difference that is small by chance must not promise that little is left.
TEST(ErrorCurve, IsNotTakenInByALuckyDifference) {
    Ladder ladder = power_law(1, 1, 5);
    const double honest = ErrorCurve(ladder, {2.0}).at(ladder.knobs.back())[0];
    ladder.steps.back()[0] /= 10;
    EXPECT_GT(ErrorCurve(ladder, {2.0}).at(ladder.knobs.back())[0], honest / 5);
}

TEST(ErrorCurve, PromisesNothingWhereDifferencesDoNotFall) {
    Ladder ladder = power_law(1, 1, 4);
    for (auto& difference : ladder.steps) {
        difference = {0.2};
    }
    const ErrorCurve curve(ladder, {2.0});
    EXPECT_DOUBLE_EQ(curve.orders()[0], lowest_order);
    EXPECT_GT(curve.at(ladder.knobs.back())[0], 10 * 0.2);
}

TEST(ErrorCurve, TakesNoOrderBelowWhatIsKnown) {
    const Ladder ladder = power_law(1, 0.3, 4);
    EXPECT_NEAR(ErrorCurve(ladder, {2.0}, {0.5}).orders()[0], 0.5, 1e-12);
    EXPECT_NEAR(ErrorCurve(ladder, {2.0}, {0.01}).orders()[0], 0.3, 1e-12);
    EXPECT_NEAR(ErrorCurve(ladder, {0.2}, {0.01}).orders()[0], 0.2, 1e-12);
}

TEST(ErrorCurve, TakesAnotherRunForTheTruth) {
    Ladder ladder = power_law(1, 1, 3);
    ladder.from_reference = {{0.9}, {0.8}, {0.7}};
    ladder.left_in_reference = {0.05};
    const ErrorCurve curve(ladder, {1.0});
    EXPECT_DOUBLE_EQ(curve.at(0.25)[0], 0.75);
    EXPECT_DOUBLE_EQ(curve.at(1.0)[0], 0.95);
}

TEST(ErrorCurve, WhereNothingDiffersNothingIsLeft) {
    Ladder ladder = power_law(0, 1, 4);
    EXPECT_EQ(ErrorCurve(ladder, {2.0}).largest_at(0.3), 0);
    EXPECT_EQ(ErrorCurve(3).largest_at(0.3), 0);
}

TEST(ErrorCurve, IsCorrected) {
    ErrorCurve curve(power_law(1, 1, 4), {1.0});
    curve.correct({2.0});
    EXPECT_NEAR(curve.at(0.1)[0], 0.2, 1e-12);
}

}  // namespace
}  // namespace thermocontact::plan
