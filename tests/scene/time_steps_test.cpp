#include "scene/time_steps.h"

#include <gtest/gtest.h>

namespace thermocontact::scene {
namespace {

TEST(StepsOf, CountsStepsThatDivideTheEnd) {
    EXPECT_EQ(steps_of(1, 0.1), 10);
    EXPECT_EQ(steps_of(1, 1.0 / 3), 3);
    EXPECT_EQ(steps_of(2.5, 2.5), 1);
    EXPECT_EQ(steps_of(1, 0.1 * (1 + 0.9e-9)), 10) << "round-off of a decimal";
}

TEST(StepsOf, IsZeroWhereStepsDoNotDivideTheEnd) {
    EXPECT_EQ(steps_of(1, 0.3), 0);
    EXPECT_EQ(steps_of(1, 0.332), 0) << "three steps end at 0.996";
    EXPECT_EQ(steps_of(1, 0.1 * (1 + 1.1e-9)), 0);
    EXPECT_EQ(steps_of(1, 3), 0);
    EXPECT_EQ(steps_of(1, 1e-10), 0) << "more than most_steps";
}

}  // namespace
}  // namespace thermocontact::scene
