/// What is measured in three dimensions, on states made by hand.

#include <gtest/gtest.h>

#include <cmath>

#include "model/contact_measures.h"
#include "model/stress.h"
#include "support/scenes.h"

namespace thermocontact::model {
namespace {

using support::Discretisation;
using Vector = std::array<double, 3>;

const std::string box = R"(
mesh = {shape = "box", lower = [0, 0, 0], upper = [2, 1, 0.5], cells = [2, 2, 1]}
time = {end = 1, steps = 1}
heat.capacity = 1
)";

class InSpace : public testing::TestWithParam<std::tuple<const char*, int>> {
  protected:
    static Discretisation with(const std::string& text) {
        const auto& [cell, degree] = GetParam();
        return Discretisation(box + text, {"mesh.cell=\"" + std::string(cell) + "\"",
                                           "space.degree=" + std::to_string(degree)});
    }
    template <typename Field>
    static std::vector<double> nodal(const Discretisation& at, Field field) {
        std::vector<double> result;
        for (const mesh::Point& x : at.space.nodes) {
            const Vector value = field(x);
            result.insert(result.end(), value.begin(), value.end());
        }
        return result;
    }
};
INSTANTIATE_TEST_SUITE_P(Cells, InSpace,
                         testing::Combine(testing::Values("simplex", "tensor"), testing::Values(1, 2)),
                         [](const auto& info) {
                             return std::string(std::get<0>(info.param)) +
                                    std::to_string(std::get<1>(info.param));
                         });

/// Every component another number: six stiffnesses without coupling, in Voigt's order of shear yz, xz, xy,
/// six strains, and M theta. Stresses of a few units from differences over 1/4: some 10 roundings of 1e-16 *
/// 4 * 10.
TEST_P(InSpace, StressOfUniformStrain) {
    const Discretisation at = with(
        "material.elasticity.tensor = [[1, 0, 0, 0, 0, 0], [0, 2, 0, 0, 0, 0], [0, 0, 3, 0, 0, 0],"
        "[0, 0, 0, 4, 0, 0], [0, 0, 0, 0, 5, 0], [0, 0, 0, 0, 0, 6]]\n"
        "heat.thermal_stress = [[0.1, 0.2, 0.3], [0.2, 0.4, 0.5], [0.3, 0.5, 0.6]]\n");
    const double xx = 0.3, yy = -0.2, zz = 0.5, xy = 0.1, yz = 0.4, xz = -0.3, turn = 0.7;
    const auto u = nodal(at, [&](const mesh::Point& x) {
        return Vector{xx * x[0] + (xy - turn) * x[1] + xz * x[2], (xy + turn) * x[0] + yy * x[1] + yz * x[2],
                      xz * x[0] + yz * x[1] + zz * x[2]};
    });
    const std::vector<double> w(u.size(), 0.0), theta(at.node_count(), 2.0);
    StressProbe probe(at.scene, at.mesh, at.space, u, w, theta);
    const double expected[] = {xx - 0.2,         2 * yy - 0.8,     3 * zz - 1.2,
                               6 * 2 * xy - 0.4, 4 * 2 * yz - 1.0, 5 * 2 * xz - 0.6};
    const auto stress = probe.mean_stress();
    ASSERT_EQ(stress.size(), 6 * static_cast<std::size_t>(at.mesh.cell_count()));
    for (std::size_t i = 0; i < stress.size(); ++i) {
        EXPECT_NEAR(stress[i], expected[i % 6], 1e-13) << "cell " << i / 6 << " component " << i % 6;
    }
}

/// The bottom (area 1, normal -y) is pressed in by 0.1 and slides at 0.24 along x, 0.32 along z: |w_t| = 0.4.
TEST_P(InSpace, FrictionAlongBothAxesOfASide) {
    const Discretisation at = with(R"(
material.viscosity = {trace = 1, shear = 1}
[boundary.bottom.contact]
compliance = {stiffness = 10}
friction = {coefficient = 0.25, regularisation = 0.3}
)");
    const auto u = nodal(at, [](const mesh::Point&) { return Vector{0, -0.1, 0}; });
    const auto w = nodal(at, [](const mesh::Point&) { return Vector{0.24, 0.7, 0.32}; });
    const std::vector<double> theta(at.node_count(), 0.0);
    ContactProbe probe(*at.surfaces[0], at.mesh, at.space, 3, {&u, &w, &theta});
    const double pressure = 10 * 0.1, share = 0.4 / 0.5;
    // sums over at most 4 facets of numbers of the order of 1
    const ContactMeasures measures = probe.measure(parallel::Alone());
    EXPECT_NEAR(measures.area, 1.0, 1e-14);
    EXPECT_NEAR(measures.normal_force, pressure, 1e-13);
    EXPECT_NEAR(measures.tangential_force, 0.25 * pressure * share, 1e-13);
    const FacetFields fields = probe.fields();
    const double along[] = {0.24, 0, 0.32};
    for (std::size_t i = 0; i < fields.at("traction").size(); ++i) {
        EXPECT_NEAR(fields.at("traction")[i], -0.25 * pressure * along[i % 3] / 0.5, 1e-13) << i;
        EXPECT_NEAR(fields.at("slip_velocity")[i], along[i % 3], 1e-13) << i;
    }
}

}  // namespace
}  // namespace thermocontact::model
