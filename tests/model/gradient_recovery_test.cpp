#include "model/gradient_recovery.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fem/nested_transfer.h"
#include "mesh/shapes.h"

namespace thermocontact::model {
namespace {

fem::ForestSpace somewhere_finer(int dimension, int degree) {
    const scene::MeshSpec spec = dimension == 2
                                     ? scene::MeshSpec{"rectangle", {0, 0}, {1, 0.5}, {3, 2}, "right"}
                                     : scene::MeshSpec{"box", {0, 0, 0}, {1, 0.5, 1}, {2, 2, 2}, ""};
    mesh::Forest forest(std::make_shared<const mesh::Mesh>(mesh::make_mesh(spec)));
    std::mt19937 random(4);
    std::vector<int> levels;
    for (std::int32_t cell = 0; cell < forest.cell_count(); ++cell) {
        levels.push_back(random() % 3 == 0 ? 3 : 0);
    }
    return {forest.with_levels(levels), degree};
}

/// Of degree 2 or 3, and its derivatives.
double polynomial(const mesh::Point& x, int degree) {
    const double square = x[0] * x[0] - 2 * x[0] * x[1] + x[1] * x[2] + x[2] + 3 * x[1];
    return degree == 2 ? square : square + x[0] * x[1] * x[1] - x[2] * x[2] * x[2];
}
mesh::Point slope(const mesh::Point& x, int degree) {
    mesh::Point g{2 * x[0] - 2 * x[1], -2 * x[0] + x[2] + 3, x[1] + 1};
    if (degree == 3) {
        g = {g[0] + x[1] * x[1], g[1] + 2 * x[0] * x[1], g[2] - 3 * x[2] * x[2]};
    }
    return g;
}

class RecoveredGradients : public testing::TestWithParam<std::pair<int, int>> {};

/// Polynomials of degree p + 1 have their own gradient, on any mesh and up to its sides. What a fit's
/// condition below 1e3 (that of columns it accepts) makes of round-off, over the smallest cell, is 1e-11.
TEST_P(RecoveredGradients, PreservesPolynomials) {
    const auto [dimension, degree] = GetParam();
    const fem::ForestSpace on = somewhere_finer(dimension, degree);
    std::vector<double> values;
    for (const mesh::Point& x : on.space.nodes) {
        values.push_back(polynomial(x, degree + 1));
        values.push_back(x[0]);
    }
    const GradientRecovery recovery(on.mesh, on.space, {});
    const auto gradients = recovery(values, 2);
    const auto d = static_cast<std::size_t>(dimension);
    for (std::int32_t cell = 0; cell < on.mesh.cell_count(); ++cell) {
        const auto nodes = on.space.dofmap.of(cell), sites = recovery.dofmap().of(cell);
        for (std::size_t n = 0; n < nodes.size(); ++n) {
            const mesh::Point exact = slope(on.space.nodes[static_cast<std::size_t>(nodes[n])], degree + 1);
            for (std::size_t axis = 0; axis < d; ++axis) {
                const std::size_t i = static_cast<std::size_t>(sites[n]) * d + axis;
                EXPECT_NEAR(gradients[0][i], exact[axis], 1e-11);
                EXPECT_NEAR(gradients[1][i], axis == 0 ? 1.0 : 0.0, 1e-11);
            }
        }
    }
}

/// A kink between two sets: each side has its own gradient, which fits to both would smear.
TEST_P(RecoveredGradients, StaysWithinASet) {
    const auto [dimension, degree] = GetParam();
    const fem::ForestSpace on = somewhere_finer(dimension, degree);
    const double kink = 0.25;  // along y, where a line of the mesh is
    std::vector<double> values;
    for (const mesh::Point& x : on.space.nodes) {
        values.push_back(std::abs(x[1] - kink));
    }
    std::vector<std::int32_t> sets;
    for (std::int32_t cell = 0; cell < on.mesh.cell_count(); ++cell) {
        double middle = 0;
        for (const std::int32_t v : on.mesh.vertices_of(cell)) {
            middle += on.mesh.points[static_cast<std::size_t>(v)][1] / (dimension + 1);
        }
        sets.push_back(middle > kink ? 0 : -1);
    }
    const GradientRecovery recovery(on.mesh, on.space, sets);
    const auto gradients = recovery(values, 1);
    const auto d = static_cast<std::size_t>(dimension);
    for (std::int32_t cell = 0; cell < on.mesh.cell_count(); ++cell) {
        for (const std::int32_t site : recovery.dofmap().of(cell)) {
            EXPECT_NEAR(gradients[0][static_cast<std::size_t>(site) * d + 1],
                        sets[static_cast<std::size_t>(cell)] == 0 ? 1.0 : -1.0, 1e-11);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Spaces, RecoveredGradients,
                         testing::Values(std::pair(2, 1), std::pair(2, 2), std::pair(3, 1), std::pair(3, 2)));

}  // namespace
}  // namespace thermocontact::model
