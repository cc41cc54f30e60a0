#include "march/kept_factors.h"

#include <gtest/gtest.h>

namespace thermocontact::march {
namespace {

/// Twelve factors of a large mesh do not fit, however much the first one did.
TEST(KeptFactors, LeaveRoomForAnother) {
    EXPECT_EQ(factors_beside_another(3, 4e9, 20e9), 3u) << "there is room";
    EXPECT_EQ(factors_beside_another(3, 4e9, 10e9), 3u) << "just";
    EXPECT_EQ(factors_beside_another(3, 4e9, 9e9), 2u);
    EXPECT_EQ(factors_beside_another(3, 4e9, 5e9), 1u);
    EXPECT_EQ(factors_beside_another(3, 4e9, 0), 1u) << "the latest one stays";
    EXPECT_EQ(factors_beside_another(0, 4e9, 0), 0u);
    EXPECT_EQ(factors_beside_another(12, 0, 0), 12u) << "a strategy without factors";
}

}  // namespace
}  // namespace thermocontact::march
