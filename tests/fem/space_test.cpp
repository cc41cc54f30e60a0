#include "fem/space.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "mesh/shapes.h"

namespace thermocontact::fem {
namespace {

struct Case {
    std::string diagonal;
    int degree;
};

class Spaces : public testing::TestWithParam<Case> {
  protected:
    static constexpr int nx = 3, ny = 2;
    const mesh::Mesh mesh =
        mesh::make_rectangle({"rectangle", {0, 1}, {3, 2}, {nx, ny}, GetParam().diagonal});
    const Space space = make_space(mesh, GetParam().degree);
};

/// Vertices, and for degree 2 the edges: by Euler's formula V - E + F = 1 for the cells of a disk.
TEST_P(Spaces, NodeCount) {
    const int vertices = static_cast<int>(mesh.points.size());
    const int edges = vertices + mesh.cell_count() - 1;
    EXPECT_EQ(space.dofmap.node_count, vertices + (GetParam().degree == 2 ? edges : 0));
    EXPECT_EQ(space.dofmap.nodes_per_cell, GetParam().degree == 2 ? 6 : 3);
    EXPECT_EQ(space.nodes.size(), static_cast<std::size_t>(space.dofmap.node_count));
}

/// A node is one place, and a place has one node: shared edges share theirs.
TEST_P(Spaces, NodesAndPlacesCorrespond) {
    std::set<std::pair<double, double>> places;
    for (const mesh::Point& x : space.nodes) {
        places.insert({x[0], x[1]});
    }
    EXPECT_EQ(places.size(), space.nodes.size());
    std::set<std::int32_t> used(space.dofmap.cell_nodes.begin(), space.dofmap.cell_nodes.end());
    EXPECT_EQ(used.size(), space.nodes.size());
    EXPECT_EQ(*used.rbegin(), space.dofmap.node_count - 1);
}

/// In every cell: vertices first, as in the mesh, then the midpoints of the edges opposite vertex 0, 1, 2.
/// The midpoints of the grid's numbers of at most 4 binary digits are exact.
TEST_P(Spaces, NodesOfACellAreInBasixOrder) {
    for (int cell = 0; cell < mesh.cell_count(); ++cell) {
        const auto nodes = space.dofmap.of(cell);
        const std::int32_t* vertices = &mesh.cells[3 * cell];
        for (int i = 0; i < 3; ++i) {
            EXPECT_EQ(nodes[i], vertices[i]);
            EXPECT_EQ(space.nodes[nodes[i]], mesh.points[vertices[i]]);
            if (GetParam().degree == 2) {
                const mesh::Point &p = mesh.points[vertices[(i + 1) % 3]],
                                  &q = mesh.points[vertices[(i + 2) % 3]];
                const mesh::Point middle{(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, 0.0};
                EXPECT_EQ(space.nodes[nodes[3 + i]], middle) << "cell " << cell << " edge " << i;
            }
        }
    }
}

TEST_P(Spaces, FacetNodesLieOnTheirSide) {
    const std::map<std::string, std::pair<int, double>> sides{
        {"bottom", {1, 1.0}}, {"left", {0, 0.0}}, {"right", {0, 3.0}}, {"top", {1, 2.0}}};
    for (const mesh::Facet& facet : mesh.facets) {
        const auto& [axis, at] = sides.at(mesh.boundary_names[facet.boundary]);
        const auto nodes = space.facet_nodes(facet);
        ASSERT_EQ(nodes.size(), static_cast<std::size_t>(GetParam().degree + 1));
        for (const std::int32_t node : nodes) {
            EXPECT_EQ(space.nodes[node][axis], at);
        }
        if (nodes.size() == 3) {
            const mesh::Point &p = space.nodes[nodes[0]], &q = space.nodes[nodes[1]],
                              &middle = space.nodes[nodes[2]];
            EXPECT_EQ(middle, (mesh::Point{(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, 0.0}))
                << "the midpoint comes last";
        }
    }
}

TEST_P(Spaces, BoundaryNodesAreSortedAndAll) {
    for (std::int32_t boundary = 0; boundary < 4; ++boundary) {
        const auto nodes = space.boundary_nodes[static_cast<std::size_t>(boundary)];
        const int facets =
            mesh.boundary_names[boundary] == "bottom" || mesh.boundary_names[boundary] == "top" ? nx : ny;
        EXPECT_EQ(nodes.size(), static_cast<std::size_t>(GetParam().degree * facets + 1));
        EXPECT_EQ(std::adjacent_find(nodes.begin(), nodes.end(), std::greater_equal<>()), nodes.end())
            << "not strictly increasing";
    }
}

TEST_P(Spaces, CellwiseSpaceHasOneNodeACell) {
    ASSERT_EQ(space.cellwise.node_count, mesh.cell_count());
    for (int cell = 0; cell < mesh.cell_count(); ++cell) {
        ASSERT_EQ(space.cellwise.of(cell).size(), 1U);
        EXPECT_EQ(space.cellwise.of(cell)[0], cell);
    }
}

INSTANTIATE_TEST_SUITE_P(Meshes, Spaces,
                         testing::Values(Case{"right", 1}, Case{"right", 2}, Case{"left", 1}, Case{"left", 2},
                                         Case{"crossed", 1}, Case{"crossed", 2}),
                         [](const auto& info) {
                             return info.param.diagonal + "_" + std::to_string(info.param.degree);
                         });

TEST(LagrangeElement, UnknownCell) {
    EXPECT_THROW(make_lagrange("heptagon", 1), std::logic_error);
}

}  // namespace
}  // namespace thermocontact::fem
