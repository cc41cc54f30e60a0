#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numeric>

#include "mesh/facet_map.h"
#include "mesh/geometry_check.h"
#include "mesh/shapes.h"

namespace thermocontact::mesh {
namespace {

scene::MeshSpec spec(const std::string& shape, const std::string& cell) {
    if (shape == "box") {
        return {"box", {-1, 0, 2}, {1, 3, 2.5}, {3, 2, 4}, "", cell};
    }
    return {"rectangle", {-1, 0}, {1, 3}, {3, 2}, "right", cell};
}

class Shape : public testing::TestWithParam<std::pair<const char*, const char*>> {
  protected:
    const scene::MeshSpec given = spec(GetParam().first, GetParam().second);
    const Mesh mesh = make_mesh(given);
    const FacetMap facets = map_facets(mesh);
};

/// No flat, folded or overlapping cell, no node twice, no facet with three cells.
TEST_P(Shape, CellsFillTheBody) {
    Tags tags;
    tags.nodes.resize(mesh.points.size());
    tags.cells.resize(static_cast<std::size_t>(mesh.cell_count()));
    EXPECT_EQ(geometric_fault(mesh, facets, tags), std::nullopt);
    const int cubes = std::accumulate(given.cells.begin(), given.cells.end(), 1, std::multiplies());
    const int parts = given.cell == "tensor" ? 1 : mesh.dimension == 2 ? 2 : 6;
    EXPECT_EQ(mesh.cell_count(), parts * cubes);
}

/// The named facets are exactly those with one cell, and lie on the side that their name says.
TEST_P(Shape, SidesAreWhereTheirNamesSay) {
    const std::map<std::string, std::pair<std::size_t, bool>> places{
        {"left", {0, false}}, {"right", {0, true}},  {"bottom", {1, false}},
        {"top", {1, true}},   {"front", {2, false}}, {"back", {2, true}}};
    std::size_t outside = 0;
    for (const auto& [key, cells] : facets) {
        outside += cells.size() == 1 ? 1 : 0;
    }
    EXPECT_EQ(mesh.facets.size(), outside);
    EXPECT_TRUE(std::ranges::is_sorted(mesh.boundary_names));
    for (const auto& [key, cells] : facets) {
        for (const Facet& facet : mesh.facets) {
            if (facet.cell != cells[0].cell || facet.local != cells[0].local) {
                continue;
            }
            const auto [axis, upper] =
                places.at(mesh.boundary_names[static_cast<std::size_t>(facet.boundary)]);
            for (const std::int32_t vertex : key) {
                if (vertex >= 0) {
                    EXPECT_EQ(mesh.points[static_cast<std::size_t>(vertex)][axis],
                              (upper ? given.upper : given.lower)[axis]);
                }
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, Shape,
                         testing::Values(std::pair("rectangle", "simplex"), std::pair("rectangle", "tensor"),
                                         std::pair("box", "simplex"), std::pair("box", "tensor")));

}  // namespace
}  // namespace thermocontact::mesh
