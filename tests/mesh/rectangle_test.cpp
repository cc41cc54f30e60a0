#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "mesh/shapes.h"

namespace thermocontact::mesh {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

struct Case {
    std::string name;
    scene::MeshSpec spec;
};

std::vector<Case> cases() {
    const std::vector<Case> boxes{{"unit_square", {"", {0, 0}, {1, 1}, {4, 4}, ""}},
                                  {"one_square", {"", {0, 0}, {1, 1}, {1, 1}, ""}},
                                  {"offset_rectangle", {"", {-0.3, 0.7}, {1.1, 1.0}, {7, 3}, ""}},
                                  {"one_row", {"", {2, -5}, {12, -4.9}, {5, 1}, ""}},
                                  {"one_column", {"", {0, 0}, {0.1, 3}, {1, 6}, ""}}};
    std::vector<Case> result;
    for (const std::string diagonal : {"right", "left", "crossed"}) {
        for (Case box : boxes) {
            box.spec.shape = "rectangle";
            box.spec.diagonal = diagonal;
            box.name += "_" + diagonal;
            result.push_back(box);
        }
    }
    return result;
}

class Rectangle : public testing::TestWithParam<Case> {
  protected:
    static const scene::MeshSpec& spec() { return GetParam().spec; }
    int nx() const { return spec().cells[0]; }
    int ny() const { return spec().cells[1]; }
    bool crossed() const { return spec().diagonal == "crossed"; }
    const Point& vertex(int cell, int local) const { return mesh.points[mesh.cells[3 * cell + local]]; }
    double area(int cell) const {
        const Point &a = vertex(cell, 0), &b = vertex(cell, 1), &c = vertex(cell, 2);
        return std::abs((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])) / 2;
    }
    const Mesh mesh = make_rectangle(GetParam().spec);
};

TEST_P(Rectangle, Counts) {
    EXPECT_EQ(mesh.cell_count(), (crossed() ? 4 : 2) * nx() * ny());
    EXPECT_EQ(mesh.points.size(),
              static_cast<std::size_t>((nx() + 1) * (ny() + 1) + (crossed() ? nx() * ny() : 0)));
    EXPECT_EQ(mesh.vertices_per_cell, 3);
    EXPECT_EQ(mesh.dimension, 2);
    EXPECT_EQ(mesh.cell, "triangle");
}

/// The cells have equal areas. A cell's area is a difference of products of coordinates up to |x|, each
/// rounded: an error of a few epsilon |x| (width + height).
TEST_P(Rectangle, CellsShareTheAreaEqually) {
    const double width = spec().upper[0] - spec().lower[0], height = spec().upper[1] - spec().lower[1];
    double farthest = 0, sum = 0;
    for (const auto* corner : {&spec().lower, &spec().upper}) {
        farthest = std::max({farthest, std::abs((*corner)[0]), std::abs((*corner)[1])});
    }
    const double tolerance = 8 * epsilon * farthest * (width + height);
    for (int cell = 0; cell < mesh.cell_count(); ++cell) {
        EXPECT_NEAR(area(cell), width * height / mesh.cell_count(), tolerance) << "cell " << cell;
        sum += area(cell);
    }
    EXPECT_NEAR(sum, width * height, tolerance * mesh.cell_count());
}

TEST_P(Rectangle, CornersAndSidesAreExact) {
    std::map<std::pair<double, double>, int> corners;
    for (const Point& p : mesh.points) {
        EXPECT_EQ(p[2], 0.0);
        for (int i = 0; i < 2; ++i) {
            EXPECT_GE(p[i], spec().lower[i]);
            EXPECT_LE(p[i], spec().upper[i]);
        }
        ++corners[{p[0], p[1]}];
    }
    for (const double x : {spec().lower[0], spec().upper[0]}) {
        for (const double y : {spec().lower[1], spec().upper[1]}) {
            EXPECT_EQ((corners[{x, y}]), 1);
        }
    }
    EXPECT_EQ(corners.size(), mesh.points.size()) << "two vertices at one place";
}

/// Inside, an edge has two cells; on the boundary one. The mesh's facets are exactly the latter.
TEST_P(Rectangle, FacetsAreTheEdgesOfOneCell) {
    std::map<std::set<int>, int> cells_of_edge;
    const auto edge = [&](int cell, int local) {
        return std::set<int>{mesh.cells[3 * cell + (local + 1) % 3], mesh.cells[3 * cell + (local + 2) % 3]};
    };
    for (int cell = 0; cell < mesh.cell_count(); ++cell) {
        for (int local = 0; local < 3; ++local) {
            ++cells_of_edge[edge(cell, local)];
        }
    }
    std::set<std::set<int>> exterior, facets;
    for (const auto& [vertices, count] : cells_of_edge) {
        EXPECT_LE(count, 2);
        if (count == 1) {
            exterior.insert(vertices);
        }
    }
    for (const Facet& facet : mesh.facets) {
        facets.insert(edge(facet.cell, facet.local));
    }
    EXPECT_EQ(facets, exterior);
    EXPECT_EQ(facets.size(), mesh.facets.size());
}

TEST_P(Rectangle, FacetsLieOnTheSideTheyAreNamedAfter) {
    struct Side {
        int axis;
        double at;
        int count;
    };
    const std::map<std::string, Side> sides{{"bottom", {1, spec().lower[1], nx()}},
                                            {"left", {0, spec().lower[0], ny()}},
                                            {"right", {0, spec().upper[0], ny()}},
                                            {"top", {1, spec().upper[1], nx()}}};
    ASSERT_EQ(mesh.boundary_names, (std::vector<std::string>{"bottom", "left", "right", "top"}));
    std::map<std::string, int> counts;
    int last = 0;
    for (const Facet& facet : mesh.facets) {
        EXPECT_GE(facet.boundary, last) << "not sorted by boundary";
        last = facet.boundary;
        const std::string& name = mesh.boundary_names[facet.boundary];
        const Side& side = sides.at(name);
        ++counts[name];
        EXPECT_EQ(vertex(facet.cell, (facet.local + 1) % 3)[side.axis], side.at) << name;
        EXPECT_EQ(vertex(facet.cell, (facet.local + 2) % 3)[side.axis], side.at) << name;
        // the third vertex is off the side, hence inside: the facet's outward normal is that of the side
        const double inside = vertex(facet.cell, facet.local)[side.axis];
        EXPECT_NE(inside, side.at) << name;
    }
    for (const auto& [name, side] : sides) {
        EXPECT_EQ(counts[name], side.count) << name;
    }
}

/// The inner edge of the first square tells the diagonals apart.
TEST_P(Rectangle, DiagonalIsTheOneAskedFor) {
    const int lower_left = 0, lower_right = 1, upper_left = nx() + 1, upper_right = nx() + 2;
    const std::map<std::string, std::set<int>> shared{{"right", {lower_left, upper_right}},
                                                      {"left", {lower_right, upper_left}},
                                                      {"crossed", {(nx() + 1) * (ny() + 1)}}};
    const int cells_in_square = crossed() ? 4 : 2;
    std::map<int, int> uses;
    for (int i = 0; i < 3 * cells_in_square; ++i) {
        ++uses[mesh.cells[i]];
    }
    std::set<int> common;
    for (const auto& [vertex, count] : uses) {
        if (count == cells_in_square) {
            common.insert(vertex);
        }
    }
    EXPECT_EQ(common, shared.at(spec().diagonal));
}

INSTANTIATE_TEST_SUITE_P(Shapes, Rectangle, testing::ValuesIn(cases()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace thermocontact::mesh
