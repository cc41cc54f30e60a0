/// Friction makes dF/dx unsymmetric: where the normal force grows, so does mu times it along the slip. Rows
/// of a contact node turned by the polar decomposition of its block on the diagonal,
///
///     N = Q S,   Q orthogonal, S symmetric and positive definite,
///
/// are nearly symmetric again, however stiff contact is. Multigrid takes Q^T (A + dF/dx) for symmetric.
#pragma once

#include <cstdint>
#include <vector>

#include "multigrid/fine_matrix.h"

namespace thermocontact::multigrid {

class Rotations {
  public:
    Rotations() = default;

    /// Of nodes where A + D is not symmetric. Every process must call.
    Rotations(const fem::BlockMatrix& A, const Pieces& D, const std::vector<char>& fixed,
              const SharedNodes& nodes);

    /// Q^T D.
    Pieces turned(const Pieces& D) const;

    /// r = Q^T r, [nodes][size].
    void turn(std::vector<double>& r) const;

  private:
    int size_ = 1;
    std::vector<std::int32_t> nodes_;  ///< in order
    std::vector<double> transposed_;   ///< [nodes_][size][size]: Q^T, row-major
};

}  // namespace thermocontact::multigrid
