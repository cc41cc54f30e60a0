#include "mesh/grid_places.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fem/space.h"
#include "mesh/shapes.h"

namespace thermocontact::mesh {
namespace {

struct Case {
    std::string name;
    scene::MeshSpec spec;
    int degree;
};

/// Far from the origin and graded, so that coordinates round.
std::vector<Case> cases() {
    std::vector<Case> result;
    for (const int degree : {1, 2}) {
        const auto add = [&](const std::string& name, scene::MeshSpec spec) {
            spec.grading.resize(spec.cells.size());
            spec.grading[1] = {7, 2};
            result.push_back({name + "_degree_" + std::to_string(degree), std::move(spec), degree});
        };
        for (const char* diagonal : {"right", "left", "crossed"}) {
            add(diagonal, {"rectangle", {-10.3, 100.1}, {-9.7, 100.8}, {5, 7}, diagonal});
        }
        scene::MeshSpec tensor{"rectangle", {-10.3, 100.1}, {-9.7, 100.8}, {5, 7}, ""};
        scene::MeshSpec box{"box", {-10.3, 100.1, 7}, {-9.7, 100.8, 7.7}, {3, 4, 3}, ""};
        add("tetrahedra", box);
        tensor.cell = box.cell = "tensor";
        add("quadrilaterals", tensor);
        add("hexahedra", box);
    }
    return result;
}

class GridPlaces : public testing::TestWithParam<Case> {
  protected:
    const Mesh mesh = make_mesh(GetParam().spec);
    const fem::Space space = fem::make_space(mesh, GetParam().degree);
    const std::vector<GridPlace> places = grid_places(GetParam().spec, mesh.points.size(), space.nodes);
};

TEST_P(GridPlaces, PointsOfTheGridAreOnItsPlaces) {
    const std::vector<int>& cells = GetParam().spec.cells;
    std::size_t node = 0;
    for (int k = 0; k <= (cells.size() > 2 ? cells[2] : 0); ++k) {
        for (int j = 0; j <= cells[1]; ++j) {
            for (int i = 0; i <= cells[0]; ++i, ++node) {
                EXPECT_EQ(places[node], (GridPlace{2 * i, 2 * j, 2 * k}));
            }
        }
    }
}

TEST_P(GridPlaces, NoCellReachesAcrossAPlane) {
    for (std::int32_t cell = 0; cell < mesh.cell_count(); ++cell) {
        for (std::size_t axis = 0; axis < GetParam().spec.cells.size(); ++axis) {
            const auto along = [&](std::int32_t node) {
                return places[static_cast<std::size_t>(node)][axis];
            };
            const auto [first, last] = std::ranges::minmax(space.dofmap.of(cell), {}, along);
            EXPECT_LE(along(last), along(first) / 2 * 2 + 2);
        }
    }
}

TEST_P(GridPlaces, OtherNodesAreBetweenPlanes) {
    const auto on_planes = std::ranges::count_if(places, [](const GridPlace& place) {
        return std::ranges::all_of(place, [](std::int32_t along) { return along % 2 == 0; });
    });
    std::ptrdiff_t points = 1;
    for (const int cells : GetParam().spec.cells) {
        points *= cells + 1;
    }
    EXPECT_EQ(on_planes, points);
}

INSTANTIATE_TEST_SUITE_P(Shapes, GridPlaces, testing::ValuesIn(cases()),
                         [](const auto& info) { return info.param.name; });

TEST(GridPlaces, NoneOnOtherMeshes) {
    scene::MeshSpec spec{"rectangle", {0, 0}, {1, 1}, {3, 2}, "right"};
    const Mesh mesh = make_mesh(spec);
    EXPECT_EQ(grid_places(spec, mesh.points.size(), mesh.points).size(), mesh.points.size());
    EXPECT_TRUE(grid_places(spec, mesh.points.size() + 1, mesh.points).empty()) << "refined";
    spec.file = std::make_shared<const Mesh>(mesh);
    EXPECT_TRUE(grid_places(spec, mesh.points.size(), mesh.points).empty()) << "of a file";
}

}  // namespace
}  // namespace thermocontact::mesh
