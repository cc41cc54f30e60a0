/// Grids of cells of every kind, and what they hold on several surfaces.

#include "output/fields.h"

#include <gtest/gtest.h>

#include <array>

#include "support/scenes.h"

namespace thermocontact::output {
namespace {

/// A node, and two of which it lies in the middle.
using Middle = std::array<int, 3>;

/// VTK's cells of degree 2, as the references of its classes number their nodes. Where two pairs have one
/// middle they say how the corners go round, also in degree 1.
const std::vector<Middle> line{{2, 0, 1}}, triangle{{3, 0, 1}, {4, 1, 2}, {5, 2, 0}},
    quadrilateral{{4, 0, 1}, {5, 1, 2}, {6, 2, 3}, {7, 3, 0}, {8, 0, 2}, {8, 1, 3}},
    tetrahedron{{4, 0, 1}, {5, 1, 2}, {6, 2, 0}, {7, 0, 3}, {8, 1, 3}, {9, 2, 3}},
    hexahedron{{8, 0, 1},  {9, 1, 2},  {10, 2, 3}, {11, 3, 0}, {12, 4, 5}, {13, 5, 6}, {14, 6, 7},
               {15, 7, 4}, {16, 0, 4}, {17, 1, 5}, {18, 2, 6}, {19, 3, 7}, {20, 0, 7}, {20, 3, 4},
               {21, 1, 6}, {21, 2, 5}, {22, 0, 5}, {22, 1, 4}, {23, 2, 7}, {23, 3, 6}, {24, 0, 2},
               {24, 1, 3}, {25, 4, 6}, {25, 5, 7}, {26, 0, 6}, {26, 1, 7}, {26, 2, 4}, {26, 3, 5}};

struct Case {
    std::string name, mesh;
    std::uint8_t types[2][2];  ///< VTK's numbers of body and contact cells: [degree - 1]
    std::vector<Middle> body, contact;
};

// a quarter is exact: so are all places
const std::string rectangle = "shape = \"rectangle\", upper = [1, 0.5], cells = [2, 1]",
                  box = "shape = \"box\", lower = [0, 0, 0], upper = [1, 0.5, 2], cells = [2, 1, 1]";
const std::vector<Case> cases{
    {"triangle", rectangle, {{5, 3}, {22, 21}}, triangle, line},
    {"quadrilateral", rectangle + ", cell = \"tensor\"", {{9, 3}, {28, 21}}, quadrilateral, line},
    {"tetrahedron", box, {{10, 5}, {24, 22}}, tetrahedron, triangle},
    {"hexahedron", box + ", cell = \"tensor\"", {{12, 9}, {29, 28}}, hexahedron, quadrilateral}};

class VtkOrder : public testing::TestWithParam<std::tuple<Case, int>> {
  protected:
    static std::array<double, 3> place(const VtuGrid& grid, std::size_t cell, int node) {
        const auto n = static_cast<std::size_t>(grid.connectivity[cell + static_cast<std::size_t>(node)]);
        return {grid.points[3 * n], grid.points[3 * n + 1], grid.points[3 * n + 2]};
    }

    /// Of degree 1 there are the corners alone: the two pairs around one middle have it in common.
    static void expect_order(const VtuGrid& grid, const std::vector<Middle>& middles) {
        const auto size = static_cast<std::size_t>(grid.nodes_per_cell);
        ASSERT_GT(grid.connectivity.size(), 0U);
        for (std::size_t cell = 0; cell < grid.connectivity.size(); cell += size) {
            for (std::size_t i = 0; i < middles.size(); ++i) {
                const auto& [node, p, q] = middles[i];
                const bool is_there = node < grid.nodes_per_cell;
                if (!is_there && (i == 0 || middles[i - 1][0] != node)) {
                    continue;
                }
                for (std::size_t c = 0; c < 3; ++c) {
                    const double found = (place(grid, cell, p)[c] + place(grid, cell, q)[c]) / 2;
                    const double expected = is_there ? place(grid, cell, node)[c]
                                                     : (place(grid, cell, middles[i - 1][1])[c] +
                                                        place(grid, cell, middles[i - 1][2])[c]) /
                                                           2;
                    EXPECT_EQ(found, expected) << "node " << node << " between " << p << " and " << q;
                }
            }
        }
    }
};

TEST_P(VtkOrder, OfTheNodesOfEveryCell) {
    const auto& [kind, degree] = GetParam();
    const scene::Scene scene =
        scene::read("mesh = {" + kind.mesh + "}\nspace.degree = " + std::to_string(degree) +
                    "\ntime = {end = 1, steps = 1}\nheat.capacity = 1\n"
                    "boundary.bottom.contact.conductance = {coefficient = 1, onset = 1, "
                    "foundation_temperature = 0}\n");
    march::Simulation simulation(scene);
    FieldGrids grids(scene, simulation);
    const VtuGrid body = grids.body(), contact = grids.contact();
    EXPECT_EQ(body.cell_type, kind.types[degree - 1][0]);
    EXPECT_EQ(contact.cell_type, kind.types[degree - 1][1]);
    expect_order(body, kind.body);
    expect_order(contact, kind.contact);
}

INSTANTIATE_TEST_SUITE_P(Fields, VtkOrder, testing::Combine(testing::ValuesIn(cases), testing::Values(1, 2)),
                         [](const auto& info) {
                             return std::get<0>(info.param).name + "_" +
                                    std::to_string(std::get<1>(info.param));
                         });

/// One surface after another, each with its own values: the gaps are 0.25 and 0.5 + y.
TEST(Fields, EachSurfaceHasItsOwn) {
    const scene::Scene scene = scene::read(R"(
mesh.cells = [3, 2]
time = {end = 1, steps = 1}
material.viscosity = {trace = 1, shear = 1}
boundary.bottom.contact = {gap = 0.25, compliance = {stiffness = 1}}
boundary.right.contact = {gap = "0.5 + y", compliance = {stiffness = 1}}
)");
    march::Simulation simulation(scene);
    FieldGrids grids(scene, simulation);
    const VtuGrid contact = grids.contact();
    const auto gap = std::ranges::find(contact.point_data, "gap", &VtuArray::name);
    ASSERT_NE(gap, contact.point_data.end());
    ASSERT_EQ(gap->values.size(), 2U * 3 + 2U * 2);
    for (std::size_t i = 0; i < gap->values.size(); ++i) {
        const double y = contact.points[3 * i + 1];
        EXPECT_NEAR(gap->values[i], i < 6 ? 0.25 : 0.5 + y, 1e-15) << "point " << i;
    }
    for (const auto& state : contact.point_integers) {
        EXPECT_EQ(state.values, std::vector<std::int32_t>(10, 0)) << state.name << ": open everywhere";
    }
}

}  // namespace
}  // namespace thermocontact::output
