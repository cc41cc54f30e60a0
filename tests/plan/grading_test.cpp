/// Which sides are graded, and the search for how steeply.
#include "plan/grading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "plan/discretisation.h"
#include "plan/grading_search.h"
#include "support/scenes.h"

namespace thermocontact::plan {
namespace {

std::vector<double> ratios(const std::vector<scene::Grading>& grading) {
    std::vector<double> result;
    for (const scene::Grading& axis : grading) {
        result.push_back(axis.lower);
        result.push_back(axis.upper);
    }
    return result;
}

using Ratios = std::vector<double>;

TEST(Grading, IsTowardCornersWhereConditionsChange) {
    const auto of = [](const std::string& name) {
        return ratios(graded(support::repository_scene(name), 4));
    };
    EXPECT_EQ(of("paper"), (Ratios{4, 4, 4, 4}));      // held above, touched below
    EXPECT_EQ(of("impact"), (Ratios{4, 4, 4, 1}));     // nothing changes at the upper corners
    EXPECT_EQ(of("box"), (Ratios{4, 4, 4, 4, 1, 4}));  // the front is a plane of symmetry
    EXPECT_EQ(of("benchmarks/rod-impact"), Ratios{});  // between rollers
    EXPECT_EQ(of("press-fit"), Ratios{});              // no shape
}

/// The price falls down to ratios of 1, 64, 4 and 16 at the four sides of `paper`.
TEST(GradingSearch, FindsTheSteepnessOfEachSide) {
    const Ratios ideal{1, 64, 4, 16};
    Ratios best;
    double least = 1e9;
    search_grading(
        graded(support::repository_scene("paper"), gentle_grading),
        [&](const std::vector<scene::Grading>& grading) {
            double price = 1;
            for (std::size_t side = 0; side < ideal.size(); ++side) {
                price += std::abs(std::log2(ratios(grading)[side] / ideal[side]));
            }
            if (price < least) {
                least = price, best = ratios(grading);
            }
            return price;
        },
        [] { return false; });
    EXPECT_EQ(best, (Ratios{4, 64, 4, 16}));  // it begins at 4
}

TEST(GradingSearch, EndsWhenToldTo) {
    int tried = 0;
    const auto price = [&](const std::vector<scene::Grading>&) { return 1.0 / ++tried; };
    search_grading(graded(support::repository_scene("paper"), gentle_grading), price,
                   [&] { return tried >= 3; });
    EXPECT_EQ(tried, 3);
    search_grading(graded(support::repository_scene("paper"), gentle_grading), price, [] { return false; });
    EXPECT_LT(tried, 100);  // always cheaper: to the steepest there is
    search_grading(
        {}, [](const auto&) -> double { throw std::logic_error("tried"); }, [] { return false; });
}

}  // namespace
}  // namespace thermocontact::plan
