#include "mesh/forest.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <set>

#include "error.h"
#include "mesh/facet_map.h"
#include "mesh/geometry_check.h"
#include "mesh/gmsh_file.h"
#include "mesh/shapes.h"

namespace thermocontact::mesh {
namespace {

std::shared_ptr<const Mesh> rectangle(const std::string& diagonal) {
    scene::MeshSpec spec{"rectangle", {0, 0}, {1, 0.7}, {3, 2}, diagonal};
    Mesh mesh = make_mesh(spec);
    mesh.region_names = {"even"};
    for (std::int32_t cell = 0; cell < mesh.cell_count(); ++cell) {
        mesh.cell_regions.push_back(cell % 2 == 0 ? 0 : -1);
    }
    return std::make_shared<const Mesh>(std::move(mesh));
}

std::shared_ptr<const Mesh> box() {
    scene::MeshSpec spec{"box", {0, 0, 0}, {1, 0.6, 1.3}, {2, 1, 2}, ""};
    return std::make_shared<const Mesh>(make_mesh(spec));
}

std::shared_ptr<const Mesh> file(const std::string& name) {
    return std::make_shared<const Mesh>(
        read_gmsh(std::filesystem::path(THERMOCONTACT_SCENES) / "meshes" / name));
}

/// Tetrahedra whose marked edges are of every type: points in general position around one inner point.
std::shared_ptr<const Mesh> star() {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> shift(-0.15, 0.15);
    Mesh mesh = make_mesh({"box", {0, 0, 0}, {1, 1, 1}, {2, 2, 2}, ""});
    for (Point& x : mesh.points) {
        for (double& coordinate : x) {
            coordinate += shift(random);
        }
    }
    return std::make_shared<const Mesh>(std::move(mesh));
}

Point point(const Mesh& mesh, std::int32_t vertex) {
    return mesh.points[static_cast<std::size_t>(vertex)];
}

double volume(const Mesh& mesh, std::span<const std::int32_t> vertices) {
    const auto d = static_cast<Eigen::Index>(vertices.size()) - 1;
    Eigen::MatrixXd edges(d, d);
    for (Eigen::Index i = 0; i < d; ++i) {
        for (Eigen::Index j = 0; j < d; ++j) {
            const auto axis = static_cast<std::size_t>(j);
            edges(i, j) =
                point(mesh, vertices[static_cast<std::size_t>(i + 1)])[axis] - point(mesh, vertices[0])[axis];
        }
    }
    return std::abs(edges.determinant()) / (d == 2 ? 2 : 6);
}

/// Of a facet: length or area, from the Gram determinant of its edges.
double area(const Mesh& mesh, const std::vector<std::int32_t>& vertices) {
    const auto n = static_cast<Eigen::Index>(vertices.size()) - 1;
    Eigen::MatrixXd edges(n, 3);
    for (Eigen::Index i = 0; i < n; ++i) {
        for (Eigen::Index j = 0; j < 3; ++j) {
            const auto axis = static_cast<std::size_t>(j);
            edges(i, j) =
                point(mesh, vertices[static_cast<std::size_t>(i + 1)])[axis] - point(mesh, vertices[0])[axis];
        }
    }
    return std::sqrt((edges * edges.transpose()).determinant()) / (n == 1 ? 1 : 2);
}

/// By boundary or region name.
std::map<std::string, double> sizes_by_name(const Mesh& mesh) {
    std::map<std::string, double> sizes;
    std::vector<std::int32_t> vertices;
    for (const Facet& facet : mesh.facets) {
        gather_vertices(mesh, cell_shape(mesh.cell), {facet.cell, facet.local}, vertices);
        sizes[mesh.boundary_names[static_cast<std::size_t>(facet.boundary)]] += area(mesh, vertices);
    }
    for (std::int32_t cell = 0; cell < mesh.cell_count(); ++cell) {
        const std::int32_t region =
            mesh.cell_regions.empty() ? -1 : mesh.cell_regions[static_cast<std::size_t>(cell)];
        sizes[region < 0 ? "body" : "region " + mesh.region_names[static_cast<std::size_t>(region)]] +=
            volume(mesh, mesh.vertices_of(cell));
    }
    return sizes;
}

/// Longest edge to the power d over the volume: 2 for half a square, 16.7 for a long thin tetrahedron.
double slenderness(const Mesh& mesh, std::span<const std::int32_t> vertices) {
    double longest = 0;
    for (const std::int32_t a : vertices) {
        for (const std::int32_t b : vertices) {
            longest = std::max(longest, std::hypot(point(mesh, a)[0] - point(mesh, b)[0],
                                                   point(mesh, a)[1] - point(mesh, b)[1],
                                                   point(mesh, a)[2] - point(mesh, b)[2]));
        }
    }
    return std::pow(longest, static_cast<double>(vertices.size() - 1)) / volume(mesh, vertices);
}

/// Of a simplex in every order of its vertices the smallest list of squared edges, relative to their sum.
std::vector<long> similarity_class(const Mesh& mesh, std::span<const std::int32_t> vertices) {
    std::vector<std::int32_t> order(vertices.begin(), vertices.end());
    std::ranges::sort(order);
    std::vector<long> best;
    do {
        std::vector<double> squares;
        for (std::size_t i = 0; i < order.size(); ++i) {
            for (std::size_t j = i + 1; j < order.size(); ++j) {
                const Point x = point(mesh, order[i]), y = point(mesh, order[j]);
                squares.push_back(std::pow(x[0] - y[0], 2) + std::pow(x[1] - y[1], 2) +
                                  std::pow(x[2] - y[2], 2));
            }
        }
        const double sum = std::accumulate(squares.begin(), squares.end(), 0.0);
        std::vector<long> rounded;
        for (const double square : squares) {
            rounded.push_back(std::lround(square / sum * 1e8));
        }
        best = best.empty() ? rounded : std::min(best, rounded);
    } while (std::ranges::next_permutation(order).found);
    return best;
}

std::vector<int> everywhere(const Forest& forest, int level) {
    return std::vector<int>(static_cast<std::size_t>(forest.cell_count()), level);
}

/// Levels that grow toward a point of the mesh.
std::vector<int> toward(const Forest& forest, const Point& x, int deepest) {
    const Mesh mesh = forest.mesh();
    std::vector<int> levels;
    for (std::int32_t cell = 0; cell < mesh.cell_count(); ++cell) {
        double near = std::numeric_limits<double>::infinity();
        for (const std::int32_t vertex : mesh.vertices_of(cell)) {
            const Point y = point(mesh, vertex);
            near = std::min(near, std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]));
        }
        levels.push_back(near == 0 ? deepest : 0);
    }
    return levels;
}

struct Case {
    std::string name;
    std::shared_ptr<const Mesh> base;
};

void PrintTo(const Case& one, std::ostream* out) {
    *out << one.name;
}

class EveryBase : public testing::TestWithParam<Case> {};

/// No hanging nodes, no flat or overlapping cells, boundaries and regions of the size that they had.
void expect_conforming(const Mesh& mesh, const Mesh& base) {
    const FacetMap facets = map_facets(mesh);
    Tags tags{std::vector<std::size_t>(mesh.points.size()),
              std::vector<std::size_t>(static_cast<std::size_t>(mesh.cell_count()))};
    std::iota(tags.nodes.begin(), tags.nodes.end(), 1);
    std::iota(tags.cells.begin(), tags.cells.end(), 1);
    EXPECT_EQ(geometric_fault(mesh, facets, tags).value_or(""), "");
    double surface = 0, old_surface = 0;
    std::vector<std::int32_t> vertices;
    for (const auto& [key, cells] :
         facets) {  // facets of one cell: the surface, which a hanging node enlarges
        ASSERT_LE(cells.size(), 2U);
        if (cells.size() == 1) {
            gather_vertices(mesh, cell_shape(mesh.cell), cells.front(), vertices);
            surface += area(mesh, vertices);
        }
    }
    for (const auto& [key, cells] : map_facets(base)) {
        if (cells.size() == 1) {
            gather_vertices(base, cell_shape(base.cell), cells.front(), vertices);
            old_surface += area(base, vertices);
        }
    }
    EXPECT_NEAR(surface, old_surface, 1e-10 * old_surface);  // sums of as many areas, each to round-off
    const auto now = sizes_by_name(mesh), before = sizes_by_name(base);
    ASSERT_EQ(now.size(), before.size());
    for (const auto& [name, size] : before) {
        EXPECT_NEAR(now.at(name), size, 1e-10 * size) << name;
    }
}

TEST_P(EveryBase, WithoutBisectionsIsTheMesh) {
    const Mesh& base = *GetParam().base;
    const Mesh mesh = Forest(GetParam().base).mesh();
    EXPECT_EQ(mesh.cells, base.cells);
    EXPECT_EQ(mesh.points, base.points);
    EXPECT_EQ(mesh.facets.size(), base.facets.size());
}

TEST_P(EveryBase, RefinedTowardAPointStaysAMesh) {
    const Mesh& base = *GetParam().base;
    Forest forest(GetParam().base);
    for (int level = 2; level <= 12; level += 2) {
        forest = forest.with_levels(toward(forest, base.points.front(), level));
        EXPECT_GE(forest.deepest(), level);
        expect_conforming(forest.mesh(), base);
    }
    EXPECT_LT(forest.cell_count(), 400 * base.cell_count()) << "only near the point";
}

TEST_P(EveryBase, AtRandomStaysAMeshThatItsBisectionsTell) {
    std::mt19937 random(3);
    const Mesh& base = *GetParam().base;
    Forest forest(GetParam().base);
    for (int round = 0; round < (base.cell_count() > 1000 ? 1 : 3); ++round) {
        std::vector<int> levels;
        for (const std::int32_t leaf : forest.leaves()) {
            levels.push_back(random() % 7 == 0 ? forest.at(leaf).level + 2 : 0);
        }
        forest = forest.with_levels(levels);
        expect_conforming(forest.mesh(), base);
        const Forest again(GetParam().base, forest.bisections());
        EXPECT_EQ(again.mesh().cells, forest.mesh().cells);
        EXPECT_EQ(again.mesh().points, forest.mesh().points);
    }
}

/// What was wanted is there, and wanting the levels that there are changes nothing: the way does not matter.
TEST_P(EveryBase, IsTheSmallestOfItsLevels) {
    Forest forest = Forest(GetParam().base);
    for (int level = 2; level <= 6; level += 2) {
        forest = forest.with_levels(toward(forest, GetParam().base->points.front(), level));
    }
    std::vector<int> levels;
    for (const std::int32_t leaf : forest.leaves()) {
        levels.push_back(forest.at(leaf).level);
    }
    EXPECT_EQ(forest.with_levels(levels).bisections(), forest.bisections());
    EXPECT_EQ(forest.with_levels(everywhere(forest, 0)).bisections(), Forest(GetParam().base).bisections());
    const Forest finer = forest.with_levels(everywhere(forest, 7));
    for (const std::int32_t leaf : finer.leaves()) {
        EXPECT_GE(finer.at(leaf).level, 7);
    }
    EXPECT_EQ(finer.bisections(),
              Forest(GetParam().base)
                  .with_levels(std::vector<int>(static_cast<std::size_t>(GetParam().base->cell_count()), 7))
                  .bisections());
}

/// Arnold, Mukherjee and Pouly: at most 72 classes of tetrahedra below one; of triangles 4.
TEST_P(EveryBase, HasFinitelyManyShapes) {
    const Mesh& base = *GetParam().base;
    const std::size_t most = base.dimension == 2 ? 4 : 72;
    Forest forest(GetParam().base);
    for (int level = 2; level <= 20; level += 2) {
        forest = forest.with_levels(toward(forest, base.points.front(), level));
    }
    const Mesh mesh = forest.mesh();
    std::map<std::int32_t, std::set<std::vector<long>>> classes;
    double worst = 0, worst_of_base = 0;
    for (const std::int32_t leaf : forest.leaves()) {
        const Forest::Cell& cell = forest.at(leaf);
        classes[cell.root].insert(similarity_class(mesh, mesh.vertices_of(cell.leaf)));
        worst = std::max(worst, slenderness(mesh, mesh.vertices_of(cell.leaf)));
    }
    for (std::int32_t cell = 0; cell < base.cell_count(); ++cell) {
        worst_of_base = std::max(worst_of_base, slenderness(base, base.vertices_of(cell)));
    }
    for (const auto& [root, found] : classes) {
        EXPECT_LE(found.size(), most) << root;
    }
    EXPECT_LE(worst, 8 * worst_of_base);
}

TEST_P(EveryBase, RefusesBisectionsThatDoNotFit) {
    Forest forest(GetParam().base);
    forest = forest.with_levels(toward(forest, GetParam().base->points.front(), 4));
    Bisections longer = forest.bisections(), shorter = longer;
    longer.push_back(0);
    shorter.pop_back();
    EXPECT_THROW(Forest(GetParam().base, longer), SceneError);
    EXPECT_THROW(Forest(GetParam().base, shorter), SceneError);
    bool refused = false;  // unless its refinement edge is on the surface, no cell can be bisected alone
    for (std::ptrdiff_t cell = 0; cell < GetParam().base->cell_count(); ++cell) {
        Bisections hanging = Forest(GetParam().base).bisections();
        hanging[static_cast<std::size_t>(cell)] = 1;
        hanging.insert(hanging.begin() + cell + 1, {0, 0});
        try {
            expect_conforming(Forest(GetParam().base, hanging).mesh(), *GetParam().base);
        } catch (const SceneError&) {
            refused = true;
        }
        cell += GetParam().base->cell_count() / 12;
    }
    EXPECT_TRUE(refused);
}

INSTANTIATE_TEST_SUITE_P(Meshes, EveryBase,
                         testing::Values(Case{"right", rectangle("right")}, Case{"left", rectangle("left")},
                                         Case{"crossed", rectangle("crossed")}, Case{"box", box()},
                                         Case{"star", star()}, Case{"brake-pad", file("brake-pad.msh")}),
                         [](const auto& info) {
                             std::string name = info.param.name;
                             std::erase(name, '-');
                             return name;
                         });

}  // namespace
}  // namespace thermocontact::mesh
