#include "solve/grid_dissection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "solve/condensed_system.h"
#include "solve/forecast.h"
#include "support/scenes.h"

namespace thermocontact::solve {
namespace {

TEST(GridDissection, OrdersEachNodeOnce) {
    EXPECT_TRUE(grid_dissection({}, {}).empty());
    std::vector<mesh::GridPlace> places;
    std::vector<std::int32_t> nodes;
    for (std::int32_t i = 0; i < 7 * 9; ++i) {
        places.push_back({i % 7, i / 7, 0});
        if (i % 5 != 0) {
            nodes.push_back(i);
        }
    }
    std::vector<std::int32_t> order = grid_dissection(places, nodes);
    std::ranges::sort(order);
    EXPECT_EQ(order, nodes);
}

/// Points 0 to 4 in a row: 0 1 and 3 4 on both sides of the middle, which comes last; so it goes on with the
/// points next to planes, 1 and 3.
TEST(GridDissection, ThePlaneInTheMiddleComesLast) {
    std::vector<mesh::GridPlace> places;
    for (std::int32_t i = 0; i < 5; ++i) {
        places.push_back({0, 2 * i, 0});
    }
    EXPECT_EQ(grid_dissection(places, {0, 1, 2, 3, 4}), (std::vector<std::int32_t>{0, 1, 4, 3, 2}));
}

/// A set that no plane cuts: the node inside its cell, those on edges, the corners.
TEST(GridDissection, NodesWithFewNeighboursComeFirst) {
    std::vector<mesh::GridPlace> places;
    std::vector<std::int32_t> nodes(9);
    std::iota(nodes.begin(), nodes.end(), 0);
    for (std::int32_t i = 0; i < 9; ++i) {
        places.push_back({i % 3, i / 3, 1});
    }
    EXPECT_EQ(grid_dissection(places, nodes), (std::vector<std::int32_t>{4, 1, 3, 5, 7, 0, 2, 6, 8}));
}

struct Case {
    std::string name, scene;
    support::Overrides overrides;
};

class Fill : public testing::TestWithParam<Case> {};

/// METIS dissects these graphs along lines that are as short, and not better: its factors had 0.04 to 9 %
/// more entries where both were compared. 2 % are for a METIS of another version, which may be luckier.
TEST_P(Fill, IsThatOfMetisOrLess) {
    const support::Discretisation problem(support::repository_scene(GetParam().scene, GetParam().overrides));
    const auto contact = model::nodes_with(problem.surfaces, problem.space, &scene::Contact::compliance);
    const auto entries = [&](InteriorOrders orders) {
        return measure(problem.graph, 1, contact, orders.without(contact)).factor_entries;
    };
    const double by_metis = entries(InteriorOrders(problem.graph));
    const auto places =
        mesh::grid_places(problem.scene.mesh, problem.mesh.points.size(), problem.space.nodes);
    const double by_planes = entries(InteriorOrders(problem.graph, places));
    EXPECT_NE(by_planes, by_metis) << "the same order";
    EXPECT_LE(by_planes, 1.02 * by_metis);
}

INSTANTIATE_TEST_SUITE_P(
    Meshes, Fill,
    testing::Values(
        Case{"triangles", "paper-isotropic", {"mesh.cells=[96,96]"}},
        Case{"slender", "paper-isotropic", {"mesh.cells=[200,40]"}},
        Case{"crossed", "paper-isotropic", {"mesh.cells=[48,48]", "mesh.diagonal='crossed'"}},
        Case{"degree_2", "paper-isotropic", {"mesh.cells=[48,48]", "space.degree=2"}},
        Case{"tetrahedra", "box", {"mesh.cells=[12,12,12]"}},
        Case{"hexahedra_degree_2", "box", {"mesh.cells=[6,6,6]", "space.degree=2", "mesh.cell='tensor'"}}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace thermocontact::solve
