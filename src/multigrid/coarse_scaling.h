/// A coarse level scaled by its diagonal blocks, as scaling.h says, with what goes with its unknowns.
#pragma once

#include "multigrid/matrix.h"
#include "multigrid/prolongation.h"
#include "multigrid/shared_nodes.h"
#include "multigrid/tentative.h"

namespace thermocontact::multigrid {

/// L^-1 A L^-T, P L^-T and L^T B in the places of A, P and the `motions` B [nodes of A], so that P B and the
/// energy of B stay what they are. Motions that an aggregate lacks stay zero. Every process must call.
void scale_coarse(Matrix& A, Prolongation& P, NearNullSpace& motions, const SharedNodes& nodes);

}  // namespace thermocontact::multigrid
