/// The matrix of a coarse level, P^T A P. Each process multiplies its part of A with rows of P that all
/// holders of a node share; the parts of the result add up as those of A do.
#pragma once

#include "multigrid/matrix.h"
#include "multigrid/prolongation.h"

namespace thermocontact::multigrid {

/// `coarse_count`: coarse nodes of this process.
Matrix galerkin(const Matrix& A, const Prolongation& P, std::size_t coarse_count);

}  // namespace thermocontact::multigrid
