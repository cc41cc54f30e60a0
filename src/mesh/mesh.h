/// A mesh as plain data, and the shapes that a scene can name.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace thermocontact::mesh {

using Point = std::array<double, 3>;

/// A facet on the boundary: the cell it belongs to, its Basix local number there, its boundary.
struct Facet {
    std::int32_t cell;
    std::int32_t local;
    std::int32_t boundary;  ///< index into Mesh::boundary_names
};

struct Mesh {
    int dimension;
    std::string cell;           ///< "triangle"
    std::vector<Point> points;  ///< vertices, m
    int vertices_per_cell;
    std::vector<std::int32_t> cells;          ///< [cells][vertices_per_cell], Basix vertex order
    std::vector<Facet> facets;                ///< exterior facets with a name, sorted by boundary
    std::vector<std::string> boundary_names;  ///< sorted

    std::int32_t cell_count() const {
        return static_cast<std::int32_t>(cells.size()) / static_cast<std::int32_t>(vertices_per_cell);
    }
};

/// The rectangle [lower, upper] in cells[0] x cells[1] squares, each cut along its right (lower left to upper
/// right), left or both diagonals; boundaries bottom, left, right, top.
Mesh make_rectangle(const scene::MeshSpec& spec);

/// Names of the boundaries of a shape, sorted.
std::vector<std::string> boundary_names(const std::string& shape);

}  // namespace thermocontact::mesh
