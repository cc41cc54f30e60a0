#include "march/vectors.h"

#include <gtest/gtest.h>

namespace thermocontact::march {
namespace {

/// Each component loses its own mean; what is left are the digits of the deformation.
TEST(Centre, TakesAwayTheMeanOfEachComponent) {
    std::vector<double> v{1e9 + 1, 5, 1e9 + 3, 8};
    centre(v, 2);
    EXPECT_EQ(v, (std::vector<double>{-1, -1.5, 1, 1.5}));
}

}  // namespace
}  // namespace thermocontact::march
