/// What is measured on states made by hand: contact on two sides, stress in cells.

#include <gtest/gtest.h>

#include <cmath>

#include "model/contact_measures.h"
#include "model/physics.h"
#include "model/stress.h"
#include "support/scenes.h"

namespace thermocontact::model {
namespace {

using support::Discretisation;

const std::string two_foundations = R"(
mesh = {lower = [0, 0], upper = [2, 1], cells = [8, 4]}
time = {end = 1, steps = 1}
material.density = 1
material.elasticity = {young = 1, poisson = 0.2}
heat.capacity = 1
[boundary.bottom.contact]
gap = 0.5
quadrature = 2
compliance = {stiffness = 10}
friction = {coefficient = 0.25, regularisation = 0.3}
conductance = {coefficient = 4, onset = 1e-3, foundation_temperature = 1, limit = 2}
[boundary.right.contact]
compliance = {stiffness = 100, exponent = 2}
)";

class Contact : public testing::TestWithParam<int> {
  protected:
    Contact() : at(two_foundations, {"space.degree=" + std::to_string(GetParam())}) {}

    template <typename Displacement, typename Velocity>
    void move(Displacement displacement, Velocity velocity, double temperature) {
        u = at.nodal(displacement);
        w = at.nodal(velocity);
        theta.assign(at.node_count(), temperature);
    }
    ContactProbe probe(std::size_t surface) {
        return {*at.surfaces[surface], at.mesh, at.space, 2, {&u, &w, &theta}};
    }

    Discretisation at;
    std::vector<double> u, w, theta;
};
INSTANTIATE_TEST_SUITE_P(Degree, Contact, testing::Values(1, 2));

using Vector = std::array<double, 2>;
constexpr double round_off = 1e-13;  ///< relative, sums over 8 facets

/// The bottom (length 2, normal -y) sinks by 0.6, 0.1 beyond its gap, and slides at 0.4; the body is 5 K too
/// hot, limited to 2.
TEST_P(Contact, ClosedEverywhere) {
    move(
        [](double, double) {
            return Vector{0, -0.6};
        },
        [](double, double) {
            return Vector{0.4, 0.7};
        },
        6.0);
    const ContactMeasures measures = probe(0).measure(parallel::Alone());
    const double p = 10 * 0.1, share = 0.4 / 0.5;
    EXPECT_NEAR(measures.area, 2.0, round_off);
    EXPECT_NEAR(measures.normal_force, 2 * p, round_off * 10);
    EXPECT_NEAR(measures.tangential_force, 2 * 0.25 * p * share, round_off);
    EXPECT_NEAR(measures.max_penetration, 0.1, round_off);
    EXPECT_NEAR(measures.contact_fraction, 1.0, round_off);
    EXPECT_NEAR(measures.slip_fraction, 1.0, round_off);
    EXPECT_NEAR(measures.heat_flow, 2 * 4 * 2.0, round_off * 100);
}

TEST_P(Contact, OpenEverywhere) {
    move(
        [](double, double) {
            return Vector{-0.1, 0.0};
        },
        [](double, double) {
            return Vector{1.0, 0.0};
        },
        6.0);
    for (std::size_t surface : {0U, 1U}) {
        const ContactMeasures measures = probe(surface).measure(parallel::Alone());
        EXPECT_EQ(measures.normal_force, 0.0);
        EXPECT_EQ(measures.tangential_force, 0.0);
        EXPECT_EQ(measures.max_penetration, 0.0);
        EXPECT_EQ(measures.contact_fraction, 0.0);
        EXPECT_EQ(measures.slip_fraction, 0.0);
        EXPECT_EQ(measures.heat_flow, 0.0);
    }
}

/// Closed for x < 1: half the length, up to the facets' own ends. Sticking where |w_t| <= 0.3, x < 0.75.
TEST_P(Contact, Shares) {
    move(
        [](double x, double) {
            return Vector{0, x < 1.01 ? -0.6 : -0.4};
        },
        [](double x, double) {
            return Vector{x < 0.76 ? 0.2 : 0.2 + 4 * (x - 0.75), 0};
        },
        0.0);
    const ContactMeasures measures = probe(0).measure(parallel::Alone());
    // Facet [1, 1.25] falls from 0.1 to -0.1 (P1: closed up to its middle; P2 with its midpoint at -0.1: up
    // to (3 - sqrt 5)/4 = 0.19 of it); the two Gauss points of `quadrature = 2` lie at 0.211 and 0.789 of the
    // facet.
    const double closed = 1.0 + (GetParam() == 1 ? 0.125 : 0.0);
    EXPECT_NEAR(measures.contact_fraction, closed / 2, round_off);
    // facet [0.75, 1]: |w_t| rises from 0.2 to 1.2, 0.41 at the first point: all of it slips
    EXPECT_NEAR(measures.slip_fraction, (closed - 0.75) / 2, round_off);
}

/// Right side (length 1, normal x), without friction: whatever is closed slips, and rubs with no force.
TEST_P(Contact, FrictionlessSideAndItsExponent) {
    move(
        [](double, double) {
            return Vector{0.2, 0.0};
        },
        [](double, double) {
            return Vector{0.0, 0.0};
        },
        6.0);
    const ContactMeasures measures = probe(1).measure(parallel::Alone());
    EXPECT_NEAR(measures.normal_force, 100 * 0.04, round_off * 10);
    EXPECT_EQ(measures.tangential_force, 0.0);
    EXPECT_NEAR(measures.max_penetration, 0.2, round_off);
    EXPECT_NEAR(measures.slip_fraction, 1.0, round_off);
    EXPECT_EQ(measures.heat_flow, 0.0);
    const FacetFields fields = probe(1).fields();
    EXPECT_FALSE(fields.contains("traction"));
    EXPECT_FALSE(fields.contains("heat_flow"));
    EXPECT_TRUE(fields.contains("pressure"));
}

/// Pointwise values are those of the laws at the nodes of each facet, in the facet's order of nodes.
TEST_P(Contact, FieldsAtTheNodes) {
    move(
        [](double x, double) {
            return Vector{0.3, -0.4 - 0.1 * x};
        },
        [](double x, double) {
            return Vector{x - 1, 2};
        },
        0.5);
    ContactProbe bottom = probe(0);
    const FacetFields fields = bottom.fields();
    std::size_t i = 0;
    for (const mesh::Facet& facet : at.surfaces[0]->facets) {
        for (const std::int32_t node : at.space.facet_nodes(facet)) {
            const double x = at.space.nodes[node][0], r = 0.1 * x - 0.1, p = 10 * std::max(r, 0.0);
            const double speed = std::hypot(x - 1, 0.3);
            EXPECT_NEAR(fields.at("gap")[i], -r, round_off);
            EXPECT_NEAR(fields.at("pressure")[i], p, round_off * 10);
            EXPECT_NEAR(fields.at("slip_velocity")[2 * i], x - 1, round_off);
            EXPECT_NEAR(fields.at("slip_velocity")[2 * i + 1], 0.0, round_off);
            EXPECT_NEAR(fields.at("traction")[2 * i], -0.25 * p * (x - 1) / speed, round_off);
            EXPECT_NEAR(fields.at("traction")[2 * i + 1], 0.0, round_off);
            if (std::abs(r) > 1e-12) {  // at r = 0 round-off decides between 0 and a rise of 4000 r
                EXPECT_NEAR(fields.at("heat_flow")[i], r > 0 ? 4 * -0.5 * std::min(r / 1e-3, 1.0) : 0.0,
                            1e-9);
            }
            ++i;
        }
    }
    EXPECT_EQ(fields.at("gap").size(), i);
}

struct StressCase {
    std::string name;
    std::string material;
    std::array<double, 6> expected;  ///< xx yy zz xy yz xz
};

constexpr double e_xx = 0.02, e_yy = -0.01, e_xy = 0.015, rate = 0.5, warmth = 3.0;

/// sigma = E eps(u) + V eps(w) - theta M with eps(w) = rate eps(u), by hand.
std::vector<StressCase> stress_cases() {
    const double tr = e_xx + e_yy;
    // E = 2, nu = 0.25: plane stress lambda* = E nu/(1 - nu^2), plane strain lambda = E nu/((1 + nu)(1 - 2
    // nu)), 2G = E/(1 + nu)
    const double star = 2 * 0.25 / (1 - 0.0625), lambda = 2 * 0.25 / (1.25 * 0.5), two_G = 1.6;
    const auto isotropic = [&](double l, double g, double zz) {
        return std::array<double, 6>{l * tr + g * e_xx, l * tr + g * e_yy, zz, g * e_xy, 0, 0};
    };
    const auto minus = [](std::array<double, 6> stress, std::array<double, 4> thermal) {  // xx yy zz xy
        for (std::size_t i = 0; i < 4; ++i) {
            stress[i] -= warmth * thermal[i];
        }
        return stress;
    };
    const std::string elastic = "material.elasticity = {young = 2, poisson = 0.25}\n";
    const std::string strained = "material.elasticity = {young = 2, poisson = 0.25, plane = \"strain\"}\n";
    const std::string viscous = "material.viscosity = {trace = 7, shear = 3}\n";
    return {
        {"plane_stress", elastic, isotropic(star, two_G, 0)},
        {"plane_strain", strained, isotropic(lambda, two_G, lambda * tr)},
        {"viscous_only", viscous, isotropic(7 * rate, 3 * rate, 0)},
        {"viscoelastic_plane_strain", strained + viscous,
         isotropic(lambda + 7 * rate, two_G + 3 * rate, (lambda + 7 * rate) * tr)},
        {"voigt",
         "material.elasticity.tensor = [[4, 1, 0.5], [1, 3, 0.2], [0.5, 0.2, 2]]\n",
         {4 * e_xx + e_yy + 0.5 * 2 * e_xy, e_xx + 3 * e_yy + 0.2 * 2 * e_xy, 0,
          0.5 * e_xx + 0.2 * e_yy + 2 * 2 * e_xy, 0, 0}},
        {"warm_plane_stress", elastic + "heat = {capacity = 1, thermal_stress = 0.4}\n",
         minus(isotropic(star, two_G, 0), {0.4, 0.4, 0, 0})},
        {"warm_plane_strain", strained + "heat = {capacity = 1, thermal_stress = 0.4}\n",
         minus(isotropic(lambda, two_G, lambda * tr), {0.4, 0.4, 0.4, 0})},
        {"warm_anisotropic", strained + "heat = {capacity = 1, thermal_stress = [[0.4, 0.1], [0.1, 0.3]]}\n",
         minus(isotropic(lambda, two_G, lambda * tr), {0.4, 0.3, 0, 0.1})}};
}

class Stress : public testing::TestWithParam<std::tuple<StressCase, int>> {};

TEST_P(Stress, OfUniformStrain) {
    const auto& [state, degree] = GetParam();
    const Discretisation at(
        "mesh = {cells = [3, 2], diagonal = \"crossed\"}\ntime = {end = 1, steps = 1}\nmaterial.density = "
        "1\n" +
        state.material + "space.degree = " + std::to_string(degree) + "\n");
    const auto u = at.nodal([](double x, double y) {
        return Vector{0.3 + e_xx * x + (e_xy - 0.1) * y,
                      -0.2 + (e_xy + 0.1) * x + e_yy * y};  // and a rotation by 0.1
    });
    std::vector<double> w;
    for (const double value : u) {
        w.push_back(rate * value);
    }
    const std::vector<double> theta(at.scene.heat ? at.node_count() : 0, warmth);
    StressProbe probe(at.scene, at.mesh, at.space, u, w, theta);
    const auto stress = probe.mean_stress();
    ASSERT_EQ(stress.size(), 6 * static_cast<std::size_t>(at.mesh.cell_count()));
    const auto& [xx, yy, zz, xy, yz, xz] = state.expected;
    // J2 of the three-dimensional tensor
    const double von_mises =
        std::sqrt(((xx - yy) * (xx - yy) + (yy - zz) * (yy - zz) + (zz - xx) * (zz - xx)) / 2 + 3 * xy * xy);
    const auto found = probe.von_mises();
    for (std::size_t cell = 0; cell < found.size(); ++cell) {
        for (std::size_t i = 0; i < 6; ++i) {
            // differences of displacements of 0.3 over 1/6: some 10 roundings of 1e-16 * 6, times stiffness
            // 10
            EXPECT_NEAR(stress[6 * cell + i], state.expected[i], 1e-13)
                << "cell " << cell << " component " << i;
        }
        EXPECT_NEAR(found[cell], von_mises, 1e-13);
    }
}

INSTANTIATE_TEST_SUITE_P(Materials, Stress,
                         testing::Combine(testing::ValuesIn(stress_cases()), testing::Values(1, 2)),
                         [](const auto& info) {
                             return std::get<0>(info.param).name + "_" +
                                    std::to_string(std::get<1>(info.param));
                         });

/// Stress varies within a cell of degree 2; its mean is that at the centroid for a quadratic displacement.
TEST(StressProbe, MeanOverTheCell) {
    const Discretisation at(
        "mesh.cells = [2, 2]\nspace.degree = 2\ntime = {end = 1, steps = 1}\nmaterial.density = 1\n"
        "material.elasticity.tensor = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\n");
    const auto u = at.nodal([](double x, double y) { return Vector{x * x, x * y}; });
    const std::vector<double> w(u.size(), 0.0);
    StressProbe probe(at.scene, at.mesh, at.space, u, w, {});
    const auto stress = probe.mean_stress();
    for (int cell = 0; cell < at.mesh.cell_count(); ++cell) {
        double x = 0, y = 0;
        for (int i = 0; i < 3; ++i) {
            x += at.mesh.points[at.mesh.cells[3 * cell + i]][0] / 3;
            y += at.mesh.points[at.mesh.cells[3 * cell + i]][1] / 3;
        }
        const double expected[6] = {2 * x, x, 0, y, 0, 0};
        for (int i = 0; i < 6; ++i) {
            EXPECT_NEAR(stress[6 * cell + i], expected[i], 1e-14);
        }
    }
}

/// Uniform stress of a body whose cells differ in size, and von Mises stress of the state as it is when
/// asked.
TEST(StressProbe, CellsOfAnySizeAtAnyTime) {
    scene::Scene scene = scene::read(
        "mesh.cells = [2, 1]\ntime = {end = 1, steps = 1}\n"
        "material.elasticity.tensor = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\n");
    mesh::Mesh mesh = mesh::make_mesh(scene.mesh);
    for (mesh::Point& x : mesh.points) {
        x[0] *= x[0];
    }
    scene.mesh.file = std::make_shared<const mesh::Mesh>(std::move(mesh));
    const Discretisation at(scene);
    auto u = at.nodal([](double x, double) { return std::array{0.25 * x, 0.0}; });
    const std::vector<double> w(u.size(), 0.0);
    StressProbe probe(at.scene, at.mesh, at.space, u, w, {});
    for (const double expected : {0.25, 0.5}) {
        for (const double stress : probe.von_mises()) {  // of (xx, 0, 0): |xx|
            EXPECT_NEAR(stress, expected, 1e-15);
        }
        std::ranges::for_each(u, [](double& value) { value *= 2; });
    }
}

/// The heat's tensors and the mechanical ones, zero where the scene has none; without friction nothing
/// sticks.
TEST(Constants, AbsentLawsAreZero) {
    const Discretisation at(
        "mesh.cells = [1, 1]\ntime = {end = 1, steps = 1}\nheat.capacity = 2\n"
        "boundary.bottom.contact.conductance = {coefficient = 3, onset = 4, foundation_temperature = 0}\n");
    const fem::Constants body = body_constants(at.scene),
                         contact = contact_constants(at.surfaces.front()->laws, 0.5);
    EXPECT_EQ(body.at("c"), std::vector<double>{2});
    EXPECT_EQ(body.at("rho"), std::vector<double>{0});
    EXPECT_EQ(body.at("E"), std::vector<double>(9, 0.0));
    EXPECT_EQ(body.at("Visc_zz"), std::vector<double>(3, 0.0));
    EXPECT_EQ(body.at("R"), std::vector<double>(4, 0.0));
    EXPECT_EQ(contact.at("k"), std::vector<double>{0.5});
    EXPECT_LT(contact.at("eps").front(), 0.0);
    EXPECT_EQ(contact.at("k_c"), std::vector<double>{3});
    EXPECT_EQ(contact.at("eps_c"), std::vector<double>{4});
    EXPECT_TRUE(std::isinf(contact.at("L").front()));
    EXPECT_FALSE(contact.contains("c_n"));
    EXPECT_FALSE(has_compliance(at.scene));
    EXPECT_FALSE(has_friction(at.scene));
    EXPECT_TRUE(has_conductance(at.scene));
}

}  // namespace
}  // namespace thermocontact::model
