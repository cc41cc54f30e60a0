/// Aggregates: nodes of a level that become one node of the next coarser one.
///
/// Vaněk, Mandel and Brezina (1996): roots whose strong neighbours are all free take these; what is left
/// joins the aggregate it couples with most, or makes new ones. Nodes couple strongly where |A_ij|^2 >
/// theta^2 |A_ii| |A_jj| in Frobenius' norm. Aggregates do not cross the borders of processes.
#pragma once

#include <cstdint>
#include <vector>

#include "multigrid/matrix.h"
#include "multigrid/shared_nodes.h"

namespace thermocontact::multigrid {

struct Aggregates {
    std::int32_t count = 0;        ///< of this process
    std::vector<std::int32_t> of;  ///< [nodes]: -1 for those that another process owns, or that couple weakly
};

/// Nodes not in `active` [nodes] stay outside.
Aggregates aggregate(const Matrix& A, const std::vector<char>& active, const SharedNodes& nodes);

}  // namespace thermocontact::multigrid
