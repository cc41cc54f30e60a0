#include "march/kept_factors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

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

/// Against a cache that keeps the latest ones, step by step.
TEST(KeptFactors, AreMadeAgainWhereFewAreKept) {
    const std::vector<double> used{1, 2, 1, 3, 2, 2, 4, 1, 3, 3, 2, 1, 5, 4, 1, 2};
    Recency recency;
    for (const double tau : used) {
        recency.note(tau);
    }
    for (std::size_t kept = 1; kept <= 6; ++kept) {
        std::vector<double> cache;
        int made = 0;
        for (const double tau : used) {
            made += std::erase(cache, tau) == 0 ? 1 : 0;
            cache.insert(cache.begin(), tau);
            cache.resize(std::min(cache.size(), kept));
        }
        EXPECT_EQ(recency.made(kept), made) << kept;
    }
    EXPECT_EQ(recency.made(12), 5);
    EXPECT_EQ(Recency().made(1), 0);
}

}  // namespace
}  // namespace thermocontact::march
