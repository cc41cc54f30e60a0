/// Whether the cells of a mesh fill a body: no flat or folded cell, no overlap, no two nodes at one place.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh/facet_map.h"

namespace thermocontact::mesh {

/// The names that a file gives to vertices and cells.
struct Tags {
    std::vector<std::size_t> nodes, cells;
};

/// What is wrong with the mesh, by the file's own names; empty if nothing is.
std::optional<std::string> geometric_fault(const Mesh& mesh, const FacetMap& facets, const Tags& tags);

}  // namespace thermocontact::mesh
