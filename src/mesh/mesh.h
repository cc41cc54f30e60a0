/// A mesh as plain data.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

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
    std::string cell;           ///< "triangle", "quadrilateral", "tetrahedron", "hexahedron"
    std::vector<Point> points;  ///< vertices, m
    int vertices_per_cell;
    std::vector<std::int32_t> cells;              ///< [cells][vertices_per_cell], Basix vertex order
    std::vector<Facet> facets;                    ///< exterior facets with a name, sorted by boundary
    std::vector<std::string> boundary_names;      ///< sorted
    std::vector<std::int32_t> cell_regions = {};  ///< [cells]: index into region_names; empty: no regions
    std::vector<std::string> region_names = {};   ///< sorted

    std::int32_t cell_count() const {
        return static_cast<std::int32_t>(cells.size()) / static_cast<std::int32_t>(vertices_per_cell);
    }

    std::span<const std::int32_t> vertices_of(std::int32_t cell_index) const {
        const auto n = static_cast<std::size_t>(vertices_per_cell);
        return {cells.data() + static_cast<std::size_t>(cell_index) * n, n};
    }
};

}  // namespace thermocontact::mesh
