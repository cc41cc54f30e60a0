/// The connected pieces of a mesh: what moves, or warms, on its own.
#pragma once

#include <cstdint>
#include <vector>

#include "fem/space.h"
#include "parallel/part.h"
#include "parallel/team.h"

namespace thermocontact::model {

struct Bodies {
    std::size_t count = 0;               ///< over all processes
    std::vector<std::int32_t> of_nodes;  ///< [nodes of the part]: the body of each
};

/// Cells that share a node belong to one body. Bodies are numbered alike on every process; every process must
/// call.
Bodies find_bodies(const fem::Space& space, const parallel::NodeNumbers& numbers, const parallel::Team& team);

}  // namespace thermocontact::model
