/// The four kinds of cells: one numbering of facets for mesh and elements, one node in what cells share.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "fem/space.h"
#include "mesh/cell_shape.h"

namespace thermocontact::fem {
namespace {

class CellKinds : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(All, CellKinds,
                         testing::Values("triangle", "quadrilateral", "tetrahedron", "hexahedron"),
                         [](const auto& info) { return std::string(info.param); });

/// Facet numbers go from the mesh into the compiled forms, which follow Basix.
TEST_P(CellKinds, FacetsAreNumberedLikeThoseOfBasix) {
    const std::string cell = GetParam();
    const mesh::CellShape& shape = mesh::cell_shape(cell);
    const LagrangeElement linear = make_lagrange(cell, 1);
    ASSERT_EQ(linear.topology.size(), static_cast<std::size_t>(shape.dimension) + 1);
    EXPECT_EQ(shape.facets, linear.topology[static_cast<std::size_t>(shape.dimension) - 1]);
    EXPECT_EQ(shape.vertices, linear.node_count);
}

using Corner = std::array<std::size_t, 3>;

/// The unit cube beside another one, whose vertex v lies where vertex `order[v]` would.
mesh::Mesh two_cubes(const std::array<std::size_t, 8>& order) {
    mesh::Mesh mesh{3, "hexahedron", {}, 8, std::vector<std::int32_t>(16), {}, {}};
    const auto number = [](const Corner& at) { return at[0] + 3 * (at[1] + 2 * at[2]); };
    for (const double z : {0, 1}) {
        for (const double y : {0, 1}) {
            for (const double x : {0, 1, 2}) {
                mesh.points.push_back({x, y, z});
            }
        }
    }
    for (std::size_t v = 0; v < 8; ++v) {
        const std::size_t w = order[v];
        mesh.cells[v] = static_cast<std::int32_t>(number({v & 1U, v >> 1U & 1U, v >> 2U}));
        mesh.cells[8 + v] = static_cast<std::int32_t>(number({1 + (w & 1U), w >> 1U & 1U, w >> 2U}));
    }
    return mesh;
}

/// In however many ways the neighbour is turned or mirrored, the edges and the face between them have one
/// node each: 12 vertices, 20 edges, 11 faces and 2 interiors.
TEST(Hexahedra, ShareTheirNodesHoweverTheyAreTurned) {
    std::array<std::size_t, 3> axes{0, 1, 2};
    do {
        for (std::size_t mirrored = 0; mirrored < 8; ++mirrored) {
            std::array<std::size_t, 8> order{};
            for (std::size_t v = 0; v < 8; ++v) {
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    order[v] |= (v >> axis & 1U) << axes[axis];
                }
                order[v] ^= mirrored;
            }
            const Space space = make_space(two_cubes(order), 2);
            const std::set<mesh::Point> places(space.nodes.begin(), space.nodes.end());
            EXPECT_EQ(space.nodes.size(), 12U + 20 + 11 + 2)
                << "axes " << axes[0] << axes[1] << axes[2] << " mirrored " << mirrored;
            EXPECT_EQ(places.size(), space.nodes.size());
        }
    } while (std::ranges::next_permutation(axes).found);
}

}  // namespace
}  // namespace thermocontact::fem
