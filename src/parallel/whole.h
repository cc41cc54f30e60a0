/// Nodal values of a part and of the whole mesh: what does not depend on the number of processes.
#pragma once

#include <vector>

#include "parallel/part.h"
#include "parallel/team.h"

namespace thermocontact::parallel {

/// The values [nodes of the part][components] of all processes as [nodes of the whole mesh][components], on
/// every process. Nodes that processes share have the value of their owner. Every process must call.
std::vector<double> to_whole(const NodeNumbers& numbers, const Team& team, const std::vector<double>& values);

/// The rows of this part's nodes from `whole` [nodes of the whole mesh][components].
std::vector<double> from_whole(const NodeNumbers& numbers, const std::vector<double>& whole);

}  // namespace thermocontact::parallel
