/// Differences of runs: against functions whose norms are known, and real pilots.
#include "plan/difference.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/shapes.h"
#include "plan/climb.h"
#include "support/scenes.h"

namespace thermocontact::plan {
namespace {

Domain domain(const std::string& name, const support::Overrides& overrides) {
    const scene::Scene scene = support::repository_scene(name, overrides);
    mesh::Mesh mesh = mesh::make_mesh(scene.mesh);
    fem::Space space = fem::make_space(mesh, scene.degree);
    return {scene.mesh, std::move(mesh), std::move(space)};
}

template <typename Function>
std::vector<double> nodal(const fem::Space& space, Function function) {
    std::vector<double> values;
    for (const mesh::Point& x : space.nodes) {
        values.push_back(function(x));
    }
    return values;
}

/// A function with a kink at every cell of `from`, which is one of `to` all the same: moved there and seen
/// again at the nodes of `from`, and from there by way of a mesh between.
void expect_nested(const std::string& name, support::Overrides coarse, support::Overrides middle,
                   support::Overrides fine) {
    const Domain a = domain(name, coarse), b = domain(name, middle), c = domain(name, fine);
    const auto rough = nodal(a.space, [](const mesh::Point& x) {
        return std::sin(40 * x[0]) + std::cos(29 * x[1]) + std::sin(17 * x[2]);
    });
    const auto directly = Transfer(a, c)(rough, 1);
    const auto by_way = Transfer(b, c)(Transfer(a, b)(rough, 1), 1);
    const auto back = Transfer(c, a)(directly, 1);
    ASSERT_EQ(directly.size(), c.space.nodes.size());
    for (std::size_t i = 0; i < directly.size(); ++i) {
        EXPECT_NEAR(directly[i], by_way[i], 1e-12) << name;
    }
    for (std::size_t i = 0; i < rough.size(); ++i) {
        EXPECT_NEAR(back[i], rough[i], 1e-12) << name;
    }
}

TEST(Transfer, IsExactOnNestedMeshes) {
    for (const char* degree : {"space.degree=1", "space.degree=2"}) {
        for (const char* kind : {"mesh.diagonal=\"right\"", "mesh.diagonal=\"left\"",
                                 "mesh.diagonal=\"crossed\"", "mesh.cell=\"tensor\""}) {
            expect_nested("paper", {"mesh.cells=[2,3]", degree, kind}, {"mesh.cells=[4,6]", degree, kind},
                          {"mesh.cells=[12,18]", degree, kind});
        }
        for (const char* kind : {"mesh.cell=\"simplex\"", "mesh.cell=\"tensor\""}) {
            expect_nested("box", {"mesh.cells=[2,1,1]", degree, kind}, {"mesh.cells=[4,2,2]", degree, kind},
                          {"mesh.cells=[8,4,4]", degree, kind});
        }
    }
}

/// A polynomial of the space's degree is the same function on every mesh.
TEST(Transfer, KeepsPolynomials) {
    const auto square = [](const mesh::Point& x) { return x[0] * x[0] - 3 * x[0] * x[1] + x[2]; };
    const Domain coarse = domain("box", {"mesh.cells=[2,2,3]", "space.degree=2"});
    const Domain fine = domain("box", {"mesh.cells=[3,5,4]", "space.degree=2"});
    const auto moved = Transfer(coarse, fine)(nodal(coarse.space, square), 1);
    const auto exact = nodal(fine.space, square);
    for (std::size_t i = 0; i < moved.size(); ++i) {
        EXPECT_NEAR(moved[i], exact[i], 1e-13);
    }
}

TEST(Norms, AreThoseOfKnownFunctions) {
    const scene::Scene scene = support::repository_scene("paper", {"mesh.cells=[4,4]"});
    const Norms norms(scene, {"velocity", "strain", "temperature"});
    Frame frame;
    for (const mesh::Point& x : norms.domain().space.nodes) {
        frame.displacement.insert(frame.displacement.end(), {5 + 2 * x[1], 7.0});  // eps_xy = 1
        frame.velocity.insert(frame.velocity.end(), {3.0, 4.0});
        frame.temperature.push_back(x[0]);
    }
    const std::vector<double> found = norms.of(frame);
    EXPECT_NEAR(found[0], 5, 1e-12);
    EXPECT_NEAR(found[1], std::sqrt(2.0), 1e-12);
    EXPECT_NEAR(found[2], std::sqrt(1.0 / 3), 1e-12);
}

Pilot pilot_of(const Discretisation& choice, Quantity quantity) {
    const scene::Scene scene =
        support::repository_scene("paper-isotropic", settings(choice.stepping, choice.tolerance));
    return run_pilot(discretised(scene, choice), choice, quantity, nullptr, [] {});
}

TEST(Comparison, OfPilotsFallsAsTheyAreRefined) {
    const scene::Scene scene = support::repository_scene("paper-isotropic");
    Comparison comparison(scene, Quantity::norms);
    const auto pilot = [&](int scale) {
        return pilot_of({1, scale, {"bdf2", false}, 16, 0}, Quantity::norms);
    };
    const Pilot coarse = pilot(1), middle = pilot(2), fine = pilot(4);
    ASSERT_EQ(coarse.frames.size(), static_cast<std::size_t>(instants));
    const auto first = comparison.difference(coarse, middle), second = comparison.difference(middle, fine);
    for (std::size_t c = 0; c < first.size(); ++c) {
        EXPECT_LT(second[c], first[c]);
        EXPECT_GT(second[c], 0);
        EXPECT_LT(second[c], comparison.size(fine)[c]);
    }
    EXPECT_EQ(comparison.difference(fine, fine), (std::vector<double>{0, 0, 0}));
}

TEST(Comparison, OfOneNumber) {
    const scene::Scene scene = support::repository_scene("paper-isotropic");
    for (const Quantity quantity :
         {Quantity::peak_pressure, Quantity::contact_force, Quantity::temperature, Quantity::contact_share}) {
        Comparison comparison(scene, quantity);
        const Pilot coarse = pilot_of({1, 1, {"bdf2", false}, 16, 0}, quantity);
        const Pilot fine = pilot_of({1, 2, {"bdf2", false}, 16, 0}, quantity);
        ASSERT_EQ(comparison.components().size(), 1U);
        EXPECT_GT(comparison.size(fine)[0], 0) << name(quantity);
        EXPECT_GT(comparison.difference(coarse, fine)[0], 0) << name(quantity);
        EXPECT_LT(comparison.difference(coarse, fine)[0], 2 * comparison.size(fine)[0]) << name(quantity);
    }
}

}  // namespace
}  // namespace thermocontact::plan
