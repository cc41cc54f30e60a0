#include "model/nodal.h"

#include <gtest/gtest.h>

#include <cmath>

#include "error.h"
#include "model/loads.h"
#include "support/scenes.h"

namespace thermocontact::model {
namespace {

using support::Discretisation;

const std::string body = R"(
mesh.cells = [3, 2]
time = {end = 1, steps = 4}
material.density = 1
material.elasticity = {young = 1, poisson = 0.2}
heat.capacity = 1
)";

class Degrees : public testing::TestWithParam<int> {
  protected:
    static Discretisation with(const std::string& text) {
        return Discretisation(body + text, {"space.degree=" + std::to_string(GetParam())});
    }
};
INSTANTIATE_TEST_SUITE_P(Space, Degrees, testing::Values(1, 2));

TEST_P(Degrees, InterpolationTakesNodalValues) {
    const Discretisation at = with("load.body_force = [\"x + 2*t\", \"x*y\"]\n");
    const auto values = interpolate(at.space, at.scene.body_force, 2, 0.5);
    EXPECT_EQ(values, at.nodal([](double x, double y) { return std::array<double, 2>{x + 1, x * y}; }));
    EXPECT_EQ(interpolate(at.space, {}, 2, 0.5), std::vector<double>(2 * at.node_count(), 0.0));
    std::vector<double> some(2 * at.node_count(), -7.0);
    interpolate_at(at.space, at.scene.body_force, std::vector<std::int32_t>{2}, 0.5, some);
    for (std::size_t i = 0; i < some.size(); ++i) {
        EXPECT_EQ(some[i], i / 2 == 2 ? values[i] : -7.0);
    }
    EXPECT_TRUE(depends_on_time(at.scene.body_force));
    EXPECT_FALSE(depends_on_time(std::span(at.scene.body_force).subspan(1)));
}

/// bottom, left, right, top apply in this order: the top has its corners. Free components stay free.
TEST_P(Degrees, PrescribedDisplacementOfSharedNodes) {
    const Discretisation at = with(
        "[boundary.left]\ndisplacement = [1.0, \"free\"]\n[boundary.top]\ndisplacement = [\"2 + t\", 3.0]\n"
        "[boundary.right]\ndisplacement = [\"free\", \"4*x\"]\n");
    const Prescribed prescribed = Prescribed::displacement(at.scene, at.mesh, at.space);
    std::vector<double> values(2 * at.node_count(), -7.0);
    prescribed.apply(0.5, values);
    std::vector<std::int32_t> expected_dofs;
    for (std::size_t node = 0; node < at.node_count(); ++node) {
        const auto& [x, y, z] = at.space.nodes[node];
        const bool left = x == 0, right = x == 1, top = y == 1;
        const double expected[2] = {top ? 2.5 : left ? 1.0 : -7.0, top ? 3.0 : right ? 4.0 : -7.0};
        for (std::size_t c = 0; c < 2; ++c) {
            const bool fixed = expected[c] != -7.0;
            EXPECT_EQ(values[2 * node + c], expected[c]) << "(" << x << ", " << y << ") component " << c;
            EXPECT_EQ(prescribed.fixed()[2 * node + c], fixed ? 1 : 0);
            if (fixed) {
                expected_dofs.push_back(static_cast<std::int32_t>(2 * node + c));
            }
        }
    }
    EXPECT_EQ(prescribed.dofs(), expected_dofs) << "each once, in order";
}

TEST_P(Degrees, PrescribedTemperature) {
    const Discretisation at = with("boundary.bottom.temperature = \"x\"\nboundary.left.temperature = 5\n");
    const Prescribed prescribed = Prescribed::temperature(at.scene, at.mesh, at.space);
    std::vector<double> values(at.node_count(), -7.0);
    prescribed.apply(0.0, values);
    for (std::size_t node = 0; node < at.node_count(); ++node) {
        const auto& [x, y, z] = at.space.nodes[node];
        EXPECT_EQ(values[node], x == 0 ? 5.0 : y == 0 ? x : -7.0);
    }
    EXPECT_EQ(prescribed.dofs().size(), static_cast<std::size_t>((3 + 2) * GetParam() + 1));
}

double total(const std::vector<double>& load, std::size_t component, std::size_t components) {
    double sum = 0;
    for (std::size_t i = component; i < load.size(); i += components) {
        sum += load[i];
    }
    return sum;
}

/// Loads linear in x and y are integrated exactly: their totals are integrals over body and sides. Sums of
/// some 60 numbers of the order of 1.
TEST_P(Degrees, MechanicalLoads) {
    const Discretisation at = with(
        "load.body_force = [\"3 + x\", \"-2*t\"]\n[boundary.left]\ntraction = [\"1.5*t^2\", 0.0]\n"
        "[boundary.right]\ntraction = [0.5, \"y*t\"]\n");
    Loads loads = Loads::mechanical(at.scene, at.mesh, at.space);
    for (const double t : {0.0, 0.5, 2.0, 0.5}) {
        const std::vector<double> load = loads.at(t);
        EXPECT_NEAR(total(load, 0, 2), 3.5 + 1.5 * t * t + 0.5, 1e-13) << t;
        EXPECT_NEAR(total(load, 1, 2), -2 * t + 0.5 * t, 1e-13) << t;
    }
}

TEST_P(Degrees, ThermalLoads) {
    const Discretisation at = with("heat.source = \"1 + x\"\nboundary.top.heat_flux = \"(2 + t)*x\"\n");
    Loads loads = Loads::thermal(at.scene, at.mesh, at.space);
    for (const double t : {0.0, 0.5, 2.0, 0.5}) {
        EXPECT_NEAR(total(loads.at(t), 0, 1), 1.5 + (2 + t) / 2, 1e-13) << t;
    }
}

TEST_P(Degrees, LoadsWithoutTimeAreAssembledOnce) {
    const Discretisation at = with("load.body_force = [1, \"x\"]\n");
    Loads loads = Loads::mechanical(at.scene, at.mesh, at.space);
    EXPECT_EQ(&loads.at(0.0), &loads.at(1.0));
    const Discretisation none = with("");
    EXPECT_EQ(Loads::mechanical(none.scene, none.mesh, none.space).at(0.0),
              std::vector<double>(2 * none.node_count(), 0.0));
}

/// A traction acts on its own side only.
TEST_P(Degrees, TractionsStayOnTheirSide) {
    const Discretisation at = with("boundary.right.traction = [1.0, 1.0]\n");
    Loads loads = Loads::mechanical(at.scene, at.mesh, at.space);
    const std::vector<double> load = loads.at(0.0);
    for (std::size_t node = 0; node < at.node_count(); ++node) {
        // in the sum of P2 shape functions no node of a side has weight 0
        EXPECT_EQ(load[2 * node] != 0.0, at.space.nodes[node][0] == 1.0);
    }
    EXPECT_EQ(facets_of(at.mesh, "right").size(), 2U);
    EXPECT_TRUE(facets_of(at.mesh, "nowhere").empty());
}

/// Gap and foundation temperature follow the time where they depend on it; a value that is not finite stops
/// the run.
TEST_P(Degrees, ContactFieldsFollowTime) {
    Discretisation at = with(
        "[boundary.bottom.contact]\ngap = \"x + t\"\n"
        "conductance = {coefficient = 1, onset = 1, foundation_temperature = \"10*t\"}\n"
        "[boundary.left.contact]\ngap = \"1/(1 - t)\"\ncompliance = {stiffness = 1}\n");
    ASSERT_EQ(at.surfaces.size(), 2U);
    const ContactSurface& surface = *at.surfaces[0];
    EXPECT_EQ(surface.name, "bottom");
    EXPECT_EQ(at.surfaces[1]->name, "left");
    const double* address = surface.gap.data();
    for (const double t : {0.25, 0.75}) {
        update(at.surfaces, at.space, t);
        for (const std::int32_t node : surface.nodes) {
            EXPECT_EQ(surface.gap[node], at.space.nodes[node][0] + t);
            EXPECT_EQ(surface.foundation_temperature[node], 10 * t);
        }
    }
    EXPECT_EQ(surface.gap.data(), address) << "forms refer to it";
    EXPECT_TRUE(at.surfaces[1]->foundation_temperature.empty());
    EXPECT_THROW(update(at.surfaces, at.space, 1.0), NumericsError);
}

TEST_P(Degrees, NodesWithALaw) {
    const Discretisation at = with(
        "boundary.bottom.contact.compliance.stiffness = 1\n"
        "boundary.right.contact.conductance = {coefficient = 1, onset = 1, foundation_temperature = 0}\n");
    const auto pushed = nodes_with(at.surfaces, at.space, &scene::Contact::compliance);
    const auto heated = nodes_with(at.surfaces, at.space, &scene::Contact::conductance);
    for (std::size_t node = 0; node < at.node_count(); ++node) {
        EXPECT_EQ(pushed[node], at.space.nodes[node][1] == 0.0 ? 1 : 0);
        EXPECT_EQ(heated[node], at.space.nodes[node][0] == 1.0 ? 1 : 0);
    }
}

/// The rule's name in forms/space.py for each degree that a scene may ask for.
TEST(ContactSurface, RuleOfADegree) {
    for (const auto& [quadrature, rule] : std::vector<std::pair<std::string, int>>{
             {"\"vertex\"", 0}, {"1", 1}, {"2", 3}, {"3", 3}, {"4", 5}, {"5", 5}, {"6", 7}, {"8", 9}}) {
        const Discretisation at(
            body + "boundary.bottom.contact.compliance.stiffness = 1\nboundary.bottom.contact.quadrature = " +
            quadrature);
        EXPECT_EQ(at.surfaces.front()->rule, rule) << quadrature;
    }
}

}  // namespace
}  // namespace thermocontact::model
