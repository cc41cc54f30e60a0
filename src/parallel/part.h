/// The part of a mesh that one process works on.
///
/// Every process makes the whole mesh and cuts it the same way. It keeps its cells with all their nodes, so
/// that what it assembles at nodes shared with others adds up to the whole; no cell is kept twice.
#pragma once

#include <cstdint>
#include <vector>

#include "fem/space.h"
#include "mesh/mesh.h"

namespace thermocontact::parallel {

/// Numbers of the nodes of a part among all nodes. Those that a process owns are consecutive; a node belongs
/// to the first of the processes that have it.
struct NodeNumbers {
    std::vector<std::int32_t> global;  ///< [nodes of the part]
    std::vector<std::int32_t> first;   ///< [processes + 1]: first node owned by each, then the count of all
    int rank = 0;                      ///< the process of this part
    std::vector<std::int32_t> whole;   ///< [nodes of the part]: the node in the whole mesh's space

    std::int32_t begin() const { return first[static_cast<std::size_t>(rank)]; }  ///< owned from here
    std::int32_t end() const { return first[static_cast<std::size_t>(rank) + 1]; }
    std::int32_t total() const { return first.back(); }
    bool owns(std::size_t node) const { return global[node] >= begin() && global[node] < end(); }
};

struct Part {
    mesh::Mesh mesh;
    fem::Space space;
    NodeNumbers numbers;
    NodeNumbers facet_numbers;             ///< the same of mesh.facets, each of which one process has
    std::int64_t cells = 0, vertices = 0;  ///< of the whole mesh
};

/// Cells of about equal count with short borders, by METIS: [cells], the process of each. The same on every
/// process.
std::vector<std::int32_t> partition(const mesh::Mesh& mesh, int processes);

/// The part of process `rank`. Throws SystemError if METIS fails.
Part take_part(mesh::Mesh mesh, fem::Space space, int processes, int rank);

}  // namespace thermocontact::parallel
