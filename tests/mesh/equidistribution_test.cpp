#include "mesh/equidistribution.h"

#include <gtest/gtest.h>

#include <cmath>

namespace thermocontact::mesh {
namespace {

/// By its own model: what is left of the squares adds up to the aim, and each new cell has the same.
TEST(Equidistribution, LeavesTheAimInEqualShares) {
    for (const int dimension : {2, 3}) {
        for (const int degree : {1, 2}) {
            const std::vector<double> squares = {4.0, 1e-3, 0.25, 0.25, 1e-9};
            const double aim = 0.3;
            const auto wanted = bisections_wanted(squares, aim, degree, dimension);
            double left = 0;
            std::vector<double> shares;
            for (std::size_t i = 0; i < squares.size(); ++i) {
                const double rest = squares[i] * std::pow(2.0, -2.0 * degree * wanted[i] / dimension);
                left += rest;
                shares.push_back(rest / std::pow(2.0, wanted[i]));
            }
            EXPECT_NEAR(left, aim * aim, 1e-12);
            for (const double share : shares) {
                EXPECT_NEAR(share, shares.front(), 1e-12 * shares.front());
            }
        }
    }
}

TEST(Equidistribution, WantsNothingWhereThereIsNoError) {
    EXPECT_LT(bisections_wanted({1.0, 0.0}, 0.1, 1, 2)[1], -100);
    EXPECT_LT(bisections_wanted({0.0, 0.0}, 0.1, 1, 2)[1], -100);
}

}  // namespace
}  // namespace thermocontact::mesh
