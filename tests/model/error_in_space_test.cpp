#include "model/error_in_space.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "fem/nested_transfer.h"
#include "mesh/shapes.h"
#include "model/gradient_recovery.h"
#include "support/scenes.h"

namespace thermocontact::model {
namespace {

const char* const warm_plate = R"([mesh]
cells = [8, 8]
[time]
end = 1.0
steps = 1
[heat]
conductivity = [[2.0, 0.5], [0.5, 1.0]]
[material.elasticity]
young = 3.0
poisson = 0.3
[boundary.left]
displacement = [0.0, 0.0]
temperature = 0.0
)";

support::Overrides mesh_of(int cells, const std::string& diagonal, int degree) {
    const std::string n = std::to_string(cells);
    return {"mesh.cells=[" + n + "," + n + "]", "mesh.diagonal=\"" + diagonal + "\"",
            "space.degree=" + std::to_string(degree)};
}

double field(double x, double y) {
    return std::sin(2.2 * x + 0.4) * std::exp(0.9 * y);
}
Eigen::Vector2d gradient(double x, double y) {
    return {2.2 * std::cos(2.2 * x + 0.4) * std::exp(0.9 * y), 0.9 * field(x, y)};
}

struct Errors {
    double discrete = 0, recovered = 0;
};

/// The L2 norms of K^(1/2) (grad(field) - g), g the gradient of the interpolant or the recovered one, by a
/// rule of degree 5 with seven points on each triangle, and shape functions written out.
Errors true_errors(const support::Discretisation& on, const std::vector<double>& values,
                   const Eigen::Matrix2d& k) {
    const double a = (6 - std::sqrt(15.0)) / 21, b = (6 + std::sqrt(15.0)) / 21;
    const double wa = (155 - std::sqrt(15.0)) / 1200, wb = (155 + std::sqrt(15.0)) / 1200;
    const std::vector<std::array<double, 3>> points = {
        {1.0 / 3, 1.0 / 3, 9.0 / 40}, {a, a, wa},        {1 - 2 * a, a, wa}, {a, 1 - 2 * a, wa}, {b, b, wb},
        {1 - 2 * b, b, wb},           {b, 1 - 2 * b, wb}};
    const GradientRecovery recovery(on.mesh, on.space, {});
    const std::vector<double> smooth = recovery(values, 1).front();
    Errors sums;
    for (std::int32_t cell = 0; cell < on.mesh.cell_count(); ++cell) {
        Eigen::Matrix<double, 2, 3> x;
        for (int v = 0; v < 3; ++v) {
            const mesh::Point& p =
                on.mesh
                    .points[static_cast<std::size_t>(on.mesh.vertices_of(cell)[static_cast<std::size_t>(v)])];
            x.col(v) << p[0], p[1];
        }
        Eigen::Matrix2d jacobian;
        jacobian << x.col(1) - x.col(0), x.col(2) - x.col(0);
        Eigen::Matrix<double, 2, 3> reference;
        reference << -1, 1, 0, -1, 0, 1;
        const Eigen::Matrix<double, 2, 3> slopes = jacobian.inverse().transpose() * reference;
        const auto nodes = on.space.dofmap.of(cell);
        const auto at = [&](int local) {
            return values[static_cast<std::size_t>(nodes[static_cast<std::size_t>(local)])];
        };
        for (const auto& [s, t, weight] : points) {
            const Eigen::Vector3d l(1 - s - t, s, t);
            Eigen::Vector2d g = Eigen::Vector2d::Zero(), better = g;
            const auto add = [&](int local, double shape) {
                const auto site =
                    2 * static_cast<std::size_t>(recovery.dofmap().of(cell)[static_cast<std::size_t>(local)]);
                better += shape * Eigen::Vector2d(smooth[site], smooth[site + 1]);
            };
            for (int v = 0; v < 3; ++v) {
                g += at(v) * slopes.col(v) * (on.scene.degree == 1 ? 1.0 : 4 * l[v] - 1);
                add(v, on.scene.degree == 1 ? l[v] : l[v] * (2 * l[v] - 1));
            }
            for (int e = 0; on.scene.degree == 2 && e < 3; ++e) {  // opposite to vertex e, in Basix order
                const int p = (e + 1) % 3, q = (e + 2) % 3;
                g += at(3 + e) * 4 * (l[p] * slopes.col(q) + l[q] * slopes.col(p));
                add(3 + e, 4 * l[p] * l[q]);
            }
            const Eigen::Vector2d place = x * l, exact = gradient(place[0], place[1]);
            const double volume = weight * std::abs(jacobian.determinant()) / 2;
            sums.discrete += volume * (exact - g).dot(k * (exact - g));
            sums.recovered += volume * (exact - better).dot(k * (exact - better));
        }
    }
    return {std::sqrt(sums.discrete), std::sqrt(sums.recovered)};
}

class Efficiency : public testing::TestWithParam<std::tuple<std::string, int>> {};

/// The index estimate/error differs from 1 by at most |recovered - exact|/|discrete - exact|, by the triangle
/// inequality, which for a smooth function is O(h): 0.67 of it, or less, where h is halved (a third for terms
/// of higher order). The rule is exact for the estimate, and to 1e-3 of it for the true error.
TEST_P(Efficiency, TendsToOneWithTheOrderOfTheRecovery) {
    const auto& [diagonal, degree] = GetParam();
    std::vector<double> bounds;
    for (const int n : {8, 16, 32}) {
        const support::Discretisation on(warm_plate, mesh_of(n, diagonal, degree));
        std::vector<double> values;
        for (const mesh::Point& x : on.space.nodes) {
            values.push_back(field(x[0], x[1]));
        }
        const std::vector<double> still(2 * values.size(), 0.0);
        const ErrorInSpace found = estimate_error(on.scene, on.mesh, on.space, still, {}, values);
        Eigen::Matrix2d k;
        k << 2, 0.5, 0.5, 1;
        const Errors exact = true_errors(on, values, k);
        bounds.push_back(exact.recovered / exact.discrete);
        EXPECT_LT(std::abs(found.heat.error / exact.discrete - 1), bounds.back() + 1e-3) << n;
        EXPECT_EQ(found.deformation.error, 0);
        EXPECT_EQ(found.deformation.size, 0);
    }
    EXPECT_LT(bounds[1], 0.67 * bounds[0]);
    EXPECT_LT(bounds[2], 0.67 * bounds[1]);
    EXPECT_LT(bounds[2], 0.1);
}

INSTANTIATE_TEST_SUITE_P(Meshes, Efficiency,
                         testing::Combine(testing::Values("right", "left", "crossed"),
                                          testing::Values(1, 2)));

/// u = (f, 0): eps = (f_x, 0, f_y); the estimate is quadratic in E, and zero for what the space contains.
TEST(ErrorInSpace, MeasuresDeformationInTheNormOfElasticity) {
    const support::Discretisation soft(warm_plate), stiff(warm_plate, {"material.elasticity.young=12"});
    const auto waves = [](double x, double y) { return std::array{field(x, y), 0.3 * field(y, x)}; };
    const auto linear = [](double x, double y) { return std::array{x - y, 2 * y + 3 * x}; };
    const std::vector<double> cold(soft.node_count(), 7.0);
    const auto estimate = [&](const support::Discretisation& on, const auto& u) {
        return estimate_error(on.scene, on.mesh, on.space, on.nodal(u), {}, cold);
    };
    const ErrorInSpace one = estimate(soft, waves), four = estimate(stiff, waves);
    EXPECT_GT(one.deformation.error, 0.01 * one.deformation.size);
    EXPECT_NEAR(four.deformation.error, 2 * one.deformation.error, 1e-12 * one.deformation.error);
    EXPECT_NEAR(four.deformation.size, 2 * one.deformation.size, 1e-12 * one.deformation.size);
    const ErrorInSpace none = estimate(soft, linear);
    EXPECT_LT(none.deformation.error, 1e-12 * none.deformation.size);
    // a uniform temperature has no gradient but that of round-off, which is told as such
    EXPECT_LT(none.heat.error, 0.1 * none.heat.noise);
    EXPECT_LT(none.heat.size, 0.1 * none.heat.noise);
}

}  // namespace
}  // namespace thermocontact::model
