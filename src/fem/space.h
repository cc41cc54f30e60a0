/// Nodes of a Lagrange space, and the fields that live on them.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "fem/element.h"
#include "mesh/mesh.h"

namespace thermocontact::fem {

/// Which nodes (or values, for cell-wise spaces) belong to which cell.
struct Dofmap {
    int nodes_per_cell;
    std::int32_t node_count;
    std::vector<std::int32_t> cell_nodes;  ///< [cells][nodes_per_cell]

    std::span<const std::int32_t> of(std::int32_t cell) const {
        const auto n = static_cast<std::size_t>(nodes_per_cell);
        return {cell_nodes.data() + static_cast<std::size_t>(cell) * n, n};
    }
};

/// The Lagrange space of the unknowns. Vector fields interleave their components at each node.
struct Space {
    LagrangeElement element;
    Dofmap dofmap;
    std::vector<mesh::Point> nodes;  ///< coordinates, m
    Dofmap cellwise;                 ///< one value a cell

    /// [boundaries]: sorted nodes of all facets of each. A part of the mesh has among them those of its nodes
    /// whose facet another part has.
    std::vector<std::vector<std::int32_t>> boundary_nodes;

    /// Nodes of a facet: its vertices first.
    std::vector<std::int32_t> facet_nodes(const mesh::Facet& facet) const;
};

/// Numbers the nodes: vertices as in the mesh, then for degree 2 one node an edge, and for tensor cells one a
/// quadrilateral face and one a cell.
Space make_space(const mesh::Mesh& mesh, int degree);

}  // namespace thermocontact::fem
