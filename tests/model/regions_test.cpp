/// A body of two parts: x < 1 is of the scene's own material, the rest of the region "part".

#include <gtest/gtest.h>

#include <numeric>

#include "model/loads.h"
#include "model/physics.h"
#include "support/scenes.h"

namespace thermocontact::model {
namespace {

scene::Scene two_parts() {
    scene::Scene scene = scene::read(R"(
mesh = {upper = [3, 1], cells = [3, 2]}
time = {end = 1, steps = 1}
material = {density = 2, viscosity = {trace = 1, shear = 1}}
heat = {capacity = 4, source = "5"}
)");
    mesh::Mesh mesh = mesh::make_mesh(scene.mesh);
    mesh.region_names = {"part"};
    for (std::int32_t cell = 0; cell < mesh.cell_count(); ++cell) {
        const bool is_part = std::ranges::any_of(mesh.vertices_of(cell), [&](std::int32_t vertex) {
            return mesh.points[static_cast<std::size_t>(vertex)][0] > 1.5;
        });
        mesh.cell_regions.push_back(is_part ? 0 : -1);
    }
    scene.mesh.file = std::make_shared<const mesh::Mesh>(std::move(mesh));
    scene.regions["part"] = {scene.material, scene.heat};
    return scene;
}

double total_source(const scene::Scene& scene) {
    const support::Discretisation at(scene);
    const std::vector<double> load = Loads::thermal(at.scene, at.mesh, at.space).at(0.0);
    return std::reduce(load.begin(), load.end());
}

/// The region of area 2 has its own source, the rest of area 1 the scene's 5 W/m^3, which acts nowhere else:
/// also where the region has none.
TEST(Regions, HaveTheirOwnHeatSource) {
    scene::Scene scene = two_parts();
    EXPECT_NEAR(total_source(scene), 3 * 5.0, 1e-13);
    scene.regions["part"].heat->source = scene::Expression(7.0);
    EXPECT_NEAR(total_source(scene), 2 * 7.0 + 1 * 5.0, 1e-13);
    scene.regions["part"].heat->source.reset();
    EXPECT_NEAR(total_source(scene), 1 * 5.0, 1e-13);
}

/// Norms in which a density or a capacity is divided out take it for the whole body: there must be one.
TEST(Regions, DensityAndCapacityAreUniformOnlyIfAllAgree) {
    scene::Scene scene = two_parts();
    EXPECT_EQ(uniform_density(scene), 2.0);
    EXPECT_EQ(uniform_capacity(scene), 4.0);
    scene.regions["part"].material->density = 3;
    EXPECT_EQ(uniform_density(scene), std::nullopt);
    EXPECT_EQ(uniform_capacity(scene), 4.0);
    scene.regions["part"].heat->capacity = 5;
    EXPECT_EQ(uniform_capacity(scene), std::nullopt);
}

}  // namespace
}  // namespace thermocontact::model
