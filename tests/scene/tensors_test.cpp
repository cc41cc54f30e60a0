#include "scene/tensors.h"

#include <gtest/gtest.h>

namespace thermocontact::scene {
namespace {

TEST(Tensors, PlaneStress) {
    const auto tensor = isotropic_elasticity(2, 0.1, false);
    const double lambda = 2 * 0.1 / (1 - 0.1 * 0.1), two_g = 2 / 1.1;
    const std::vector<double> expected = {lambda + two_g, lambda, 0, lambda, lambda + two_g, 0, 0, 0,
                                          two_g / 2};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_DOUBLE_EQ(tensor.matrix[i], expected[i]);
    }
    EXPECT_EQ(tensor.out_of_plane, (std::vector<double>{0, 0, 0}));
}

// Under a stress along x alone, plane stress stretches by s/E; plane strain is stiffer by 1/(1-nu^2).
TEST(Tensors, UniaxialStress) {
    const double young = 3, poisson = 0.25;
    for (const bool strain : {false, true}) {
        const auto c = isotropic_elasticity(young, poisson, strain).matrix;
        const double modulus = c[0] - c[1] * c[3] / c[4];
        EXPECT_NEAR(modulus, strain ? young / (1 - poisson * poisson) : young, 1e-14);
    }
}

TEST(Tensors, PlaneStrain) {
    const double young = 3, poisson = 0.25;
    const auto tensor = isotropic_elasticity(young, poisson, true);
    const double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
    EXPECT_DOUBLE_EQ(tensor.matrix[1], lambda);
    EXPECT_DOUBLE_EQ(tensor.out_of_plane[0], lambda);
    EXPECT_DOUBLE_EQ(tensor.out_of_plane[1], lambda);
    EXPECT_EQ(tensor.out_of_plane[2], 0);
}

TEST(Tensors, Viscosity) {
    const auto tensor = isotropic_viscosity(10, 4, false);
    EXPECT_EQ(tensor.matrix, (std::vector<double>{14, 10, 0, 10, 14, 0, 0, 0, 2}));
    EXPECT_EQ(tensor.out_of_plane, (std::vector<double>{0, 0, 0}));
    EXPECT_EQ(isotropic_viscosity(10, 4, true).out_of_plane, (std::vector<double>{10, 10, 0}));
}

TEST(Tensors, Symmetry) {
    EXPECT_TRUE(is_symmetric({1, 2, 2, 1}, 2));
    EXPECT_TRUE(is_symmetric({1e6, 2 + 1e-9, 2, 1}, 2));
    EXPECT_FALSE(is_symmetric({1, 2, 2.001, 1}, 2));
    EXPECT_TRUE(is_symmetric({0, 0, 0, 0}, 2));
}

TEST(Tensors, SmallestEigenvalue) {
    EXPECT_NEAR(smallest_eigenvalue({2, 1, 1, 2}, 2), 1, 1e-14);
    EXPECT_EQ(smallest_eigenvalue({1, 1, 1, 1}, 2), 0);
    EXPECT_EQ(smallest_eigenvalue({0.1, 0.1, 0.1, 0.1}, 2), 0);
    EXPECT_NEAR(smallest_eigenvalue({1, 2, 2, 1}, 2), -1, 1e-14);
    EXPECT_LT(smallest_eigenvalue({1, 0, 0, -1e-6}, 2), 0);
}

}  // namespace
}  // namespace thermocontact::scene
