#include "mesh/grading.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <numeric>

#include "mesh/facet_map.h"
#include "mesh/geometry_check.h"
#include "mesh/shapes.h"
#include "scene/scene_files.h"

namespace thermocontact::mesh {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

std::vector<double> points(const Axis& axis) {
    std::vector<double> result;
    for (int i = 0; i <= axis.cells; ++i) {
        result.push_back(coordinate(axis, i));
    }
    return result;
}

std::vector<Axis> axes(int cells) {
    std::vector<Axis> result;
    for (const auto& [a, b] : {std::pair(1.0, 1.0),
                               {8.0, 1.0},
                               {1.0, 8.0},
                               {5.0, 5.0},
                               {100.0, 3.0},
                               {1.5, 40.0},
                               {1 + 1e-13, 1.0},
                               {1e6, 1e6}}) {
        for (const auto& [lower, upper] : {std::pair(0.0, 1.0), {-0.3, 1.1}, {2.0, 12.0}}) {
            result.push_back({lower, upper, cells, {a, b}});
        }
    }
    return result;
}

/// The coordinates are of the size of the axis and its ends; a few operations round each.
double round_off(const Axis& axis) {
    return 16 * epsilon * std::max({std::abs(axis.lower), std::abs(axis.upper), axis.upper - axis.lower});
}

/// Graded at one side: x = (a^s - 1)/(a - 1).
TEST(Grading, OneSideIsAGeometricSeries) {
    const Axis axis{0, 1, 10, {8, 1}};
    for (int i = 0; i <= 10; ++i) {
        EXPECT_NEAR(coordinate(axis, i), (std::pow(8, i / 10.0) - 1) / 7, 4 * epsilon) << i;
    }
}

/// With ratios a = 4 and b = 2, m = 2/3: 4 of 6 cells grow by 8^(1/6) = sqrt(2) each, 2 shrink by it; the two
/// beside m are equal. In units of the largest size there, the ends of the cells are those of x(s).
TEST(Grading, HalvesMeetWithEqualCells) {
    const std::vector<double> x = points({0, 1, 6, {4, 2}});
    std::vector<double> sizes;
    for (std::size_t i = 0; i < 6; ++i) {
        sizes.push_back(x[i + 1] - x[i]);
    }
    const double r = std::sqrt(2), sum = 1 + r + 2 + 2 * r + 2 * r + 2;
    const std::vector<double> expected{1 / sum, r / sum, 2 / sum, 2 * r / sum, 2 * r / sum, 2 / sum};
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_NEAR(sizes[i], expected[i], 4 * epsilon) << i;
    }
}

/// Where the ratios hold exactly: densities dx/ds at the sides and at m, by differences of very many cells.
TEST(Grading, RatiosAreThoseOfTheDensity) {
    const int n = 1 << 20;
    const Axis axis{0, 1, n, {50, 3}};
    const double g = std::log(150.0), m = std::log(50.0) / g;
    const auto size = [&](double s) {
        const double i = std::floor(s * n);
        return coordinate(axis, i + 1) - coordinate(axis, i);
    };
    // a cell differs from the density in it by g/n of itself, and the size is off by round-off: epsilon n
    const double tolerance = 4 * g / n + 64 * epsilon * n;
    EXPECT_NEAR(size(m) / size(0) / 50, 1, tolerance);
    EXPECT_NEAR(size(m) / size(1 - 0.5 / n) / 3, 1, tolerance);
}

TEST(Grading, PointsRiseFromEndToEnd) {
    for (const Axis& axis : axes(24)) {
        const std::vector<double> x = points(axis);
        EXPECT_EQ(x.front(), axis.lower);
        EXPECT_EQ(x.back(), axis.upper);
        for (std::size_t i = 0; i + 1 < x.size(); ++i) {
            EXPECT_LT(x[i], x[i + 1]);
            EXPECT_GE(x[i + 1] - x[i], smallest_cell(axis) - round_off(axis));
        }
    }
}

/// The points of n cells are every other one of 2n cells, to the last bit.
TEST(Grading, FinerMeshesContainCoarserOnes) {
    for (const int n : {1, 3, 24}) {
        const auto coarse = axes(n), fine = axes(2 * n);
        for (std::size_t k = 0; k < coarse.size(); ++k) {
            for (int i = 0; i <= n; ++i) {
                EXPECT_EQ(coordinate(coarse[k], i), coordinate(fine[k], 2 * i)) << n << " cells, point " << i;
            }
        }
    }
}

/// Equal ratios, or exchanged ones, mirror the mesh; to the last bit around 0, where mirroring is exact.
TEST(Grading, MirrorsItself) {
    for (const auto& [a, b] : {std::pair(5.0, 5.0), {1e6, 1e6}, {1.01, 1.01}, {100.0, 3.0}, {8.0, 1.0}}) {
        for (const int n : {2, 7, 24, 100}) {
            const Axis axis{-0.7, 0.7, n, {a, b}}, mirrored{-0.7, 0.7, n, {b, a}};
            for (int i = 0; i <= n; ++i) {
                if (a == b && n % 2 == 0) {
                    EXPECT_EQ(coordinate(axis, i), -coordinate(axis, n - i)) << a << ' ' << n << ' ' << i;
                }
                EXPECT_NEAR(coordinate(axis, i), -coordinate(mirrored, n - i), round_off(axis));
            }
        }
    }
}

/// Absent and 1 give the mesh there was before, to the last bit.
TEST(Grading, OneIsUniform) {
    const scene::MeshSpec plain{"rectangle", {-0.3, 0.7}, {1.1, 1.0}, {7, 3}, "crossed"};
    scene::MeshSpec ones = plain;
    ones.grading = {{1, 1}, {1, 1}};
    const auto expected = make_mesh(plain).points;
    EXPECT_EQ(make_mesh(ones).points, expected);
    EXPECT_EQ(expected[2][0], -0.3 + 2 * ((1.1 - -0.3) / 7));
}

scene::MeshSpec graded(const std::string& shape, const std::string& cell, const std::string& diagonal) {
    scene::MeshSpec spec{shape, {-1, 0}, {1, 3}, {5, 4}, diagonal, cell};
    spec.grading = {{6, 1}, {2, 30}};
    if (shape == "box") {
        spec.lower.push_back(2);
        spec.upper.push_back(2.5);
        spec.cells.push_back(3);
        spec.grading.push_back({1, 4});
    }
    return spec;
}

/// Twice the volume of a triangle, or six times that of a tetrahedron; of tensor cells d! times theirs.
double scaled_volume(const Mesh& mesh, std::int32_t cell) {
    const auto vertices = mesh.vertices_of(cell);
    const bool simplex = mesh.vertices_per_cell == mesh.dimension + 1;
    const std::vector<std::size_t> ends =
        simplex ? std::vector<std::size_t>{1, 2, 3} : std::vector<std::size_t>{1, 2, 4};
    Eigen::Matrix3d edges = Eigen::Matrix3d::Identity();
    for (int i = 0; i < mesh.dimension; ++i) {
        const auto place = [&](std::size_t local) {
            return Eigen::Vector3d(mesh.points[static_cast<std::size_t>(vertices[local])].data());
        };
        edges.col(i) = place(ends[static_cast<std::size_t>(i)]) - place(0);
    }
    const double factor = simplex ? 1 : mesh.dimension == 2 ? 2 : 6;
    return factor * std::abs(edges.determinant());
}

class GradedShape : public testing::TestWithParam<std::array<const char*, 3>> {};

TEST_P(GradedShape, CellsFillTheBody) {
    const auto& [shape, cell, diagonal] = GetParam();
    const Mesh mesh = make_mesh(graded(shape, cell, diagonal));
    const Tags tags{std::vector<std::size_t>(mesh.points.size()),
                    std::vector<std::size_t>(static_cast<std::size_t>(mesh.cell_count()))};
    EXPECT_EQ(geometric_fault(mesh, map_facets(mesh), tags), std::nullopt);
    double sum = 0;
    for (std::int32_t c = 0; c < mesh.cell_count(); ++c) {
        sum += scaled_volume(mesh, c);
    }
    const double expected = mesh.dimension == 2 ? 2 * 6 : 6 * 3;
    EXPECT_NEAR(sum, expected, 64 * epsilon * expected);
}

/// Points are those of each axis, and the midpoints of crossed cells those of twice the cells.
TEST_P(GradedShape, PointsAreThoseOfTheAxes) {
    const auto& [shape, cell, diagonal] = GetParam();
    const scene::MeshSpec spec = graded(shape, cell, diagonal);
    const Mesh mesh = make_mesh(spec);
    scene::MeshSpec finer = spec;
    for (int& count : finer.cells) {
        count *= 2;
    }
    const auto fine = make_mesh(finer).points;
    for (const Point& x : mesh.points) {
        EXPECT_NE(std::ranges::find(fine, x), fine.end());
    }
    const Axis along{spec.lower[1], spec.upper[1], spec.cells[1], spec.grading[1]};
    const std::size_t row = static_cast<std::size_t>(spec.cells[0] + 1);
    for (int j = 0; j <= spec.cells[1]; ++j) {
        EXPECT_EQ(mesh.points[static_cast<std::size_t>(j) * row][1], coordinate(along, j));
    }
}

INSTANTIATE_TEST_SUITE_P(All, GradedShape,
                         testing::Values(std::array{"rectangle", "simplex", "right"},
                                         std::array{"rectangle", "simplex", "left"},
                                         std::array{"rectangle", "simplex", "crossed"},
                                         std::array{"rectangle", "tensor", ""},
                                         std::array{"box", "simplex", ""}, std::array{"box", "tensor", ""}));

/// Of a scene: each side's key is that side's ratio, and 1 is as good as absent.
TEST(Grading, IsReadBySide) {
    const std::string box = R"(mesh.shape = "box"
mesh.cells = [2, 2, 2]
time = {end = 1, steps = 1}
heat.capacity = 1
)";
    const char* const sides[] = {"left", "right", "bottom", "top", "front", "back"};
    for (std::size_t i = 0; i < 6; ++i) {
        const scene::Scene scene = scene::read(box + "mesh.grading." + sides[i] + " = 3\nmesh.grading." +
                                               sides[(i + 3) % 6] + " = 1\n");
        for (std::size_t j = 0; j < 6; ++j) {
            const scene::Grading& along = scene.mesh.grading.at(j / 2);
            EXPECT_EQ(j % 2 == 0 ? along.lower : along.upper, i == j ? 3 : 1) << sides[i] << ' ' << sides[j];
        }
        EXPECT_EQ(scene.resolved["mesh"]["grading"].dump(), std::string("{\"") + sides[i] + "\":3.0}");
    }
    EXPECT_FALSE(scene::read(box + "mesh.grading.left = 1\n").resolved["mesh"].contains("grading"));
}

}  // namespace
}  // namespace thermocontact::mesh
