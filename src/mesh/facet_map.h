/// The facets of cells by their vertices, and which cells share them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "mesh/cell_shape.h"
#include "mesh/mesh.h"

namespace thermocontact::mesh {

/// Sorted vertices of a facet, -1 in unused places.
using FacetKey = std::array<std::int32_t, 4>;

FacetKey facet_key(std::span<const std::int32_t> vertices);

struct FacetKeyHash {
    std::size_t operator()(const FacetKey& key) const;
};

/// A facet of a cell, by the number that it has there.
struct CellFacet {
    std::int32_t cell, local;
};

/// The vertices of a facet, in the order of the cell's shape, into `vertices`.
void gather_vertices(const Mesh& mesh, const CellShape& shape, const CellFacet& facet,
                     std::vector<std::int32_t>& vertices);

/// All facets of the mesh with the cells they belong to: one outside, two inside.
using FacetMap = std::unordered_map<FacetKey, std::vector<CellFacet>, FacetKeyHash>;

FacetMap map_facets(const Mesh& mesh);

}  // namespace thermocontact::mesh
