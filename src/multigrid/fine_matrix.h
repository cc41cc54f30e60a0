/// The matrix of the finest level, A + (D + D^T) / 2 without rows and columns of fixed dofs, scaled, where D
/// is the derivative of contact at some state.
#pragma once

#include <cstdint>
#include <vector>

#include "fem/block_matrix.h"
#include "multigrid/matrix.h"
#include "multigrid/scaling.h"
#include "multigrid/shared_nodes.h"

namespace thermocontact::multigrid {

/// Dense pieces on some dofs each, none of them fixed, row-major; they add up.
struct Pieces {
    std::vector<std::int32_t> sizes, dofs;
    std::vector<double> values;
};

/// Blocks of the diagonal of A + D [nodes][size][size], added up over the processes; 1 at `fixed`
/// dofs.
std::vector<double> fine_diagonal(const fem::BlockMatrix& A, const Pieces& D, const std::vector<char>& fixed,
                                  const SharedNodes& nodes);

/// `scaling`: by the symmetric part of fine_diagonal of the same.
Matrix fine_matrix(const fem::BlockMatrix& A, const Pieces& D, const std::vector<char>& fixed,
                   const Scaling& scaling);

}  // namespace thermocontact::multigrid
