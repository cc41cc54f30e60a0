#include <algorithm>

#include "mesh/mesh.h"

namespace thermocontact::mesh {
namespace {

enum Side : std::int32_t { bottom, left, right, top };

/// Numbering of the vertices of a grid of nx x ny squares: the grid row by row, then the midpoints of crossed
/// squares.
struct Grid {
    std::int32_t nx, ny;
    std::int32_t vertex(std::int32_t i, std::int32_t j) const { return j * (nx + 1) + i; }
    std::int32_t midpoint(std::int32_t i, std::int32_t j) const { return (nx + 1) * (ny + 1) + j * nx + i; }
};

std::vector<Point> grid_points(const Grid& grid, const scene::MeshSpec& spec) {
    const double hx = (spec.upper[0] - spec.lower[0]) / grid.nx;
    const double hy = (spec.upper[1] - spec.lower[1]) / grid.ny;
    const auto at = [&](double i, double j) {
        return Point{spec.lower[0] + i * hx, spec.lower[1] + j * hy, 0.0};
    };
    std::vector<Point> points;
    for (std::int32_t j = 0; j <= grid.ny; ++j) {
        for (std::int32_t i = 0; i <= grid.nx; ++i) {
            points.push_back(at(i, j));
            // the far sides exactly where the scene has them, whatever the round-off of h
            if (i == grid.nx) {
                points.back()[0] = spec.upper[0];
            }
            if (j == grid.ny) {
                points.back()[1] = spec.upper[1];
            }
        }
    }
    if (spec.diagonal == "crossed") {
        for (std::int32_t j = 0; j < grid.ny; ++j) {
            for (std::int32_t i = 0; i < grid.nx; ++i) {
                points.push_back(at(i + 0.5, j + 0.5));
            }
        }
    }
    return points;
}

using Triangle = std::array<std::int32_t, 3>;

/// The triangles of square (i, j), with corners a b (lower) and c d (upper).
std::vector<Triangle> triangles(const Grid& grid, std::int32_t i, std::int32_t j,
                                const std::string& diagonal) {
    const auto a = grid.vertex(i, j);
    const auto b = grid.vertex(i + 1, j);
    const auto c = grid.vertex(i, j + 1);
    const auto d = grid.vertex(i + 1, j + 1);
    if (diagonal == "left") {
        return {{a, b, c}, {b, c, d}};
    }
    if (diagonal == "crossed") {
        const auto m = grid.midpoint(i, j);
        return {{a, b, m}, {a, c, m}, {b, d, m}, {c, d, m}};
    }
    return {{a, b, d}, {a, c, d}};
}

/// The side of the rectangle on which both vertices lie; -1 if there is none.
std::int32_t side_of(const Grid& grid, std::int32_t p, std::int32_t q) {
    if (std::max(p, q) >= (grid.nx + 1) * (grid.ny + 1)) {
        return -1;
    }
    const std::int32_t pi = p % (grid.nx + 1), pj = p / (grid.nx + 1);
    const std::int32_t qi = q % (grid.nx + 1), qj = q / (grid.nx + 1);
    if (pj == qj && (pj == 0 || pj == grid.ny)) {
        return pj == 0 ? bottom : top;
    }
    if (pi == qi && (pi == 0 || pi == grid.nx)) {
        return pi == 0 ? left : right;
    }
    return -1;
}

void append_facets(const Grid& grid, const Triangle& triangle, std::int32_t cell,
                   std::vector<Facet>& facets) {
    for (std::int32_t local = 0; local < 3; ++local) {
        // Basix: facet i of a triangle is opposite vertex i
        const auto p = triangle[static_cast<std::size_t>((local + 1) % 3)];
        const auto q = triangle[static_cast<std::size_t>((local + 2) % 3)];
        if (const auto side = side_of(grid, p, q); side >= 0) {
            facets.push_back({cell, local, side});
        }
    }
}

}  // namespace

std::vector<std::string> boundary_names(const std::string& shape) {
    if (shape == "rectangle") {
        return {"bottom", "left", "right", "top"};
    }
    return {};
}

Mesh make_rectangle(const scene::MeshSpec& spec) {
    const Grid grid{spec.cells[0], spec.cells[1]};
    Mesh mesh{2, "triangle", grid_points(grid, spec), 3, {}, {}, boundary_names("rectangle")};
    std::int32_t cell = 0;
    for (std::int32_t j = 0; j < grid.ny; ++j) {
        for (std::int32_t i = 0; i < grid.nx; ++i) {
            for (const Triangle& triangle : triangles(grid, i, j, spec.diagonal)) {
                mesh.cells.insert(mesh.cells.end(), triangle.begin(), triangle.end());
                append_facets(grid, triangle, cell++, mesh.facets);
            }
        }
    }
    std::ranges::stable_sort(mesh.facets, {}, &Facet::boundary);
    return mesh;
}

}  // namespace thermocontact::mesh
