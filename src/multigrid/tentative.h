/// The tentative prolongation of aggregates reproduces the near-null space B of their nodes, orthonormalised
/// in each: B = Q R, Q its prolongation, R what the coarse node keeps of B.
#pragma once

#include <cstdint>
#include <vector>

#include "multigrid/aggregation.h"
#include "multigrid/shared_nodes.h"

namespace thermocontact::multigrid {

/// [nodes][size][motions]: 1 motion for scalars, 3 rigid ones in the plane, 6 in space; zero at fixed dofs.
struct NearNullSpace {
    int motions = 1;
    std::vector<double> values;
};

struct Tentative {
    Rows transposed;        ///< Q^T: at most one block a row, [size][lanes(motions)], column first_coarse +
                            ///< aggregate
    NearNullSpace motions;  ///< R: [aggregates][motions][motions]
};

/// Motions that depend on others in an aggregate, as rotations of a single node do, are zero in Q.
Tentative tentative(const Aggregates& aggregates, const NearNullSpace& motions, int size,
                    std::int32_t first_coarse);

}  // namespace thermocontact::multigrid
