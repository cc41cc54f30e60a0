#include "mesh/facet_map.h"

#include <algorithm>

namespace thermocontact::mesh {

FacetKey facet_key(std::span<const std::int32_t> vertices) {
    FacetKey key{-1, -1, -1, -1};
    std::ranges::copy(vertices, key.begin());
    std::ranges::sort(key);
    return key;
}

std::size_t FacetKeyHash::operator()(const FacetKey& key) const {
    std::uint64_t hash = 0;
    for (const std::int32_t vertex : key) {
        hash = (hash ^ static_cast<std::uint32_t>(vertex)) * 0x9E3779B97F4A7C15ULL;  // Fibonacci hashing
        hash ^= hash >> 29U;
    }
    return hash;
}

void gather_vertices(const Mesh& mesh, const CellShape& shape, const CellFacet& facet,
                     std::vector<std::int32_t>& vertices) {
    vertices.clear();
    for (const int v : shape.facets[static_cast<std::size_t>(facet.local)]) {
        vertices.push_back(mesh.vertices_of(facet.cell)[static_cast<std::size_t>(v)]);
    }
}

FacetMap map_facets(const Mesh& mesh) {
    const CellShape& shape = cell_shape(mesh.cell);
    FacetMap map;
    std::vector<std::int32_t> vertices;
    for (std::int32_t cell = 0; cell < mesh.cell_count(); ++cell) {
        for (std::size_t local = 0; local < shape.facets.size(); ++local) {
            const CellFacet facet{cell, static_cast<std::int32_t>(local)};
            gather_vertices(mesh, shape, facet, vertices);
            map[facet_key(vertices)].push_back(facet);
        }
    }
    return map;
}

}  // namespace thermocontact::mesh
