#include "mesh/geometry_check.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "mesh/cell_shape.h"
#include "number.h"

namespace thermocontact::mesh {
namespace {

constexpr double same_place = 1e-10;  ///< relative to the size of the body
constexpr double flat = 1e-12;        ///< volume relative to that of a cube of the cell's size

using Vector = Eigen::Vector3d;

Vector place(const Mesh& mesh, std::int32_t vertex) {
    return Vector(mesh.points[static_cast<std::size_t>(vertex)].data());
}

std::string show(const Point& x) {
    return "(" + short_text(x[0]) + ", " + short_text(x[1]) + ", " + short_text(x[2]) + ")";
}

/// Two vertices nearer than the tolerance. They fall into the same box of a grid, or of the grid shifted by
/// half a box.
std::optional<std::string> duplicate_nodes(const Mesh& mesh, const Tags& tags) {
    Eigen::AlignedBox3d box;
    for (const Point& x : mesh.points) {
        box.extend(Vector(x.data()));
    }
    const double width = 2 * same_place * box.diagonal().norm();
    for (const double shift : {0.0, 0.5}) {
        std::map<std::array<double, 3>, std::size_t> boxes;
        for (std::size_t v = 0; v < mesh.points.size(); ++v) {
            std::array<double, 3> key{};
            for (std::size_t i = 0; i < 3; ++i) {
                key[i] = std::floor(mesh.points[v][i] / width + shift);
            }
            if (const auto [other, is_new] = boxes.emplace(key, v); !is_new) {
                return "nodes " + std::to_string(tags.nodes[other->second]) + " and " +
                       std::to_string(tags.nodes[v]) + " lie at the same place " + show(mesh.points[v]) +
                       "; expected one node a place (Gmsh: Coherence Mesh)";
            }
        }
    }
    return {};
}

/// Determinants of the edges that meet at each corner of a cell; those of a simplex are the same everywhere,
/// so that one is enough.
std::vector<double> corner_determinants(const Mesh& mesh, std::int32_t cell) {
    const auto vertices = mesh.vertices_of(cell);
    const auto d = static_cast<std::size_t>(mesh.dimension);
    const bool is_simplex = vertices.size() == d + 1;
    std::vector<double> result;
    for (std::size_t corner = 0; corner < (is_simplex ? 1 : vertices.size()); ++corner) {
        Eigen::Matrix3d edges = Eigen::Matrix3d::Identity();
        for (std::size_t i = 0; i < d; ++i) {
            // along axis i from the lower to the upper end; in Basix order bit i of a corner is its place
            // there
            const std::size_t bit = std::size_t{1} << i;
            const std::size_t upper = is_simplex ? i + 1 : corner | bit,
                              lower = is_simplex ? 0 : corner & ~bit;
            edges.col(static_cast<Eigen::Index>(i)) =
                place(mesh, vertices[upper]) - place(mesh, vertices[lower]);
        }
        result.push_back(edges.determinant());
    }
    return result;
}

double longest_edge(const Mesh& mesh, std::int32_t cell) {
    double longest = 0;
    for (const std::int32_t a : mesh.vertices_of(cell)) {
        for (const std::int32_t b : mesh.vertices_of(cell)) {
            longest = std::max(longest, (place(mesh, a) - place(mesh, b)).norm());
        }
    }
    return longest;
}

std::optional<std::string> flat_or_folded(const Mesh& mesh, const Tags& tags) {
    for (std::int32_t cell = 0; cell < mesh.cell_count(); ++cell) {
        const auto determinants = corner_determinants(mesh, cell);
        const double least = flat * std::pow(longest_edge(mesh, cell), mesh.dimension);
        const auto [low, high] = std::ranges::minmax(determinants);
        if (low > least || high < -least) {
            continue;
        }
        const std::string name = mesh.cell + " " + std::to_string(tags.cells[static_cast<std::size_t>(cell)]);
        return low < -least && high > least
                   ? name + " is inverted: its corners turn both ways; expected a convex cell"
                   : name + " is flat, with no volume at a corner; expected a cell with volume";
    }
    return {};
}

Vector centre(const Mesh& mesh, std::span<const std::int32_t> vertices) {
    const Vector sum =
        std::accumulate(vertices.begin(), vertices.end(), Vector(Vector::Zero()),
                        [&](const Vector& x, std::int32_t v) { return Vector(x + place(mesh, v)); });
    return sum / static_cast<double>(vertices.size());
}

/// On which side of the facet `x` lies.
double side(const Mesh& mesh, const std::vector<std::int32_t>& facet, const Vector& x) {
    const Vector a = place(mesh, facet[0]), along = place(mesh, facet[1]) - a;
    const Vector across = mesh.dimension == 2 ? Vector(Vector::UnitZ()) : Vector(place(mesh, facet[2]) - a);
    return along.cross(across).dot(x - a);
}

/// Two cells on the same side of the facet that they share: one of them is turned over.
std::optional<std::string> overlaps(const Mesh& mesh, const FacetMap& facets, const Tags& tags) {
    const auto tag = [&](const CellFacet& at) {
        return std::to_string(tags.cells[static_cast<std::size_t>(at.cell)]);
    };
    const CellShape& shape = cell_shape(mesh.cell);
    std::vector<std::int32_t> facet;
    for (const auto& [key, cells] : facets) {
        if (cells.size() == 1) {
            continue;
        }
        if (cells.size() > 2) {
            return "elements " + tag(cells[0]) + ", " + tag(cells[1]) + " and " + tag(cells[2]) +
                   " share one facet; expected at most two cells at a facet";
        }
        gather_vertices(mesh, shape, cells[0], facet);
        const double one = side(mesh, facet, centre(mesh, mesh.vertices_of(cells[0].cell)));
        const double other = side(mesh, facet, centre(mesh, mesh.vertices_of(cells[1].cell)));
        if (one * other > 0) {
            return "elements " + tag(cells[0]) + " and " + tag(cells[1]) +
                   " overlap: both lie on the same side of their common facet, one of them inverted";
        }
    }
    return {};
}

}  // namespace

std::optional<std::string> geometric_fault(const Mesh& mesh, const FacetMap& facets, const Tags& tags) {
    for (const auto& fault :
         {duplicate_nodes(mesh, tags), flat_or_folded(mesh, tags), overlaps(mesh, facets, tags)}) {
        if (fault) {
            return fault;
        }
    }
    return {};
}

}  // namespace thermocontact::mesh
