#include "march/subdivision.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace thermocontact::march {
namespace {

using Parts = std::vector<std::pair<double, double>>;  ///< begin and end, as shares of the step

/// Marches where a part fails if it holds `difficulty` and is longer than `longest`.
Parts march(double difficulty, double longest, Subdivision& parts) {
    Parts taken;
    while (!parts.done()) {
        const double begin = parts.end() - parts.length();
        if (begin < difficulty && difficulty <= parts.end() && parts.length() > longest) {
            if (!parts.fail()) {
                break;
            }
        } else {
            taken.emplace_back(begin, parts.end());
            parts.accept();
        }
    }
    return taken;
}

TEST(Subdivision, OfAnEasyStepIsTheStep) {
    Subdivision parts;
    EXPECT_EQ(march(0.5, 1.0, parts), (Parts{{0, 1}}));
    EXPECT_EQ(parts.failures(), 0);
    EXPECT_EQ(parts.smallest(), 1.0);
}

TEST(Subdivision, HalvesUntilItGetsByAndGrowsAgain) {
    Subdivision parts;
    EXPECT_EQ(march(0.3, 0.125, parts),
              (Parts{{0, 0.25}, {0.25, 0.375}, {0.375, 0.5}, {0.5, 0.75}, {0.75, 1}}))
        << "at most twice as long as the one before";
    EXPECT_EQ(parts.failures(), 3);
    EXPECT_EQ(parts.smallest(), 0.125);
}

/// Whatever happens the parts cover the step, and each begins at a multiple of its length.
TEST(Subdivision, PartsCoverTheStep) {
    for (int place = 1; place <= 64; ++place) {
        for (const double longest : {1.0, 0.5, 0.1, 0.02, 0.01}) {
            Subdivision parts;
            double reached = 0;
            for (const auto& [begin, end] : march(place / 64.0, longest, parts)) {
                EXPECT_EQ(begin, reached);
                const double number = begin / (end - begin);
                EXPECT_EQ(number, static_cast<int>(number));
                reached = end;
            }
            EXPECT_EQ(reached, 1.0);
            EXPECT_TRUE(parts.done());
        }
    }
}

TEST(Subdivision, BeginsShortAndLengthensWhenTold) {
    Subdivision parts(3);
    EXPECT_EQ(parts.length(), 0.125);
    parts.accept(0);
    parts.accept(0);
    EXPECT_EQ(parts.length(), 0.125);
    parts.accept(5);
    EXPECT_EQ(parts.length(), 0.125) << "at 3/8";
    parts.accept(5);
    EXPECT_EQ(parts.length(), 0.5) << "at 1/2, where two doublings fit";
    EXPECT_TRUE(parts.reject(2));
    EXPECT_EQ(parts.length(), 0.125);
    EXPECT_EQ(parts.end(), 0.625);
    for (int part = 0; part < 3; ++part) {
        parts.accept(0);
    }
    EXPECT_FALSE(parts.done());
    parts.accept(2);
    EXPECT_TRUE(parts.done());
    EXPECT_EQ(parts.halvings(), 1) << "of the next step, if it goes on as this one";
    EXPECT_EQ(parts.failures(), 0) << "a rejection is none";
    EXPECT_TRUE(parts.reject(100));
    EXPECT_EQ(parts.halvings(), Subdivision::most_halvings);
    EXPECT_FALSE(parts.reject(1)) << "there is nothing shorter";
}

TEST(Subdivision, GivesUp) {
    Subdivision parts;
    EXPECT_EQ(march(0.3, 0.0, parts).size(), 3U) << "[0, 1/4], and two shorter ones before 0.3";
    EXPECT_EQ(parts.smallest(), 1.0 / (1 << Subdivision::most_halvings));
    Subdivision often;
    int failures = 1;
    while (often.fail()) {
        ++failures;
        often.accept();
        often.accept();
    }
    EXPECT_LE(failures, Subdivision::most_failures);
}

}  // namespace
}  // namespace thermocontact::march
