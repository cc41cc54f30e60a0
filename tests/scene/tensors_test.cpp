#include "scene/tensors.h"

#include <gtest/gtest.h>

namespace thermocontact::scene {
namespace {

TEST(Tensors, PlaneStress) {
    const auto tensor = isotropic_elasticity(2, 0.1, Kinematics::plane_stress);
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
        const auto c =
            isotropic_elasticity(young, poisson, strain ? Kinematics::plane_strain : Kinematics::plane_stress)
                .matrix;
        const double modulus = c[0] - c[1] * c[3] / c[4];
        EXPECT_NEAR(modulus, strain ? young / (1 - poisson * poisson) : young, 1e-14);
    }
}

TEST(Tensors, PlaneStrain) {
    const double young = 3, poisson = 0.25;
    const auto tensor = isotropic_elasticity(young, poisson, Kinematics::plane_strain);
    const double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
    EXPECT_DOUBLE_EQ(tensor.matrix[1], lambda);
    EXPECT_DOUBLE_EQ(tensor.out_of_plane[0], lambda);
    EXPECT_DOUBLE_EQ(tensor.out_of_plane[1], lambda);
    EXPECT_EQ(tensor.out_of_plane[2], 0);
}

TEST(Tensors, Viscosity) {
    const auto tensor = isotropic_viscosity(10, 4, Kinematics::plane_stress);
    EXPECT_EQ(tensor.matrix, (std::vector<double>{14, 10, 0, 10, 14, 0, 0, 0, 2}));
    EXPECT_EQ(tensor.out_of_plane, (std::vector<double>{0, 0, 0}));
    EXPECT_EQ(isotropic_viscosity(10, 4, Kinematics::plane_strain).out_of_plane,
              (std::vector<double>{10, 10, 0}));
}

// A stress along x alone stretches by s/E and contracts by nu s/E across; shear is worth G.
TEST(Tensors, InSpace) {
    const double young = 3, poisson = 0.25;
    const auto tensor = isotropic_elasticity(young, poisson, Kinematics::space);
    const std::vector<double> strain{1 / young, -poisson / young, -poisson / young, 0.5, 0.6, 0.7};
    const double G = young / (2 * (1 + poisson));
    const std::vector<double> expected{1, 0, 0, 0.5 * G, 0.6 * G, 0.7 * G};
    for (std::size_t i = 0; i < 6; ++i) {
        double stress = 0;
        for (std::size_t j = 0; j < 6; ++j) {
            stress += tensor.matrix[6 * i + j] * strain[j];
        }
        EXPECT_NEAR(stress, expected[i], 1e-15) << i;
    }
    EXPECT_TRUE(tensor.out_of_plane.empty());
    EXPECT_EQ(isotropic_viscosity(10, 4, Kinematics::space).matrix[35], 2);
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
