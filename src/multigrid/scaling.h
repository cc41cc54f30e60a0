/// Every level is scaled by the blocks D = L L^T of its diagonal: of A x = b it solves
///
///     L^-1 A L^-T y = L^-1 b,   x = L^-T y,
///
/// whose diagonal blocks are the identity. However stiff contact or a material makes a node, the scaled
/// entries are of order one, and single precision holds them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace thermocontact::multigrid {

/// Blocks [size][size] of a node or a pair, row-major.
class Scaling {
  public:
    /// `diagonal` [nodes][size][size]: the blocks D, the same wherever a node is held, of which the symmetric
    /// part is taken. Of one that is not positive definite the positive entries on its diagonal are taken.
    Scaling(int size, const std::vector<double>& diagonal);

    /// L^-1 of a node, zero above its diagonal.
    const double* inverse(std::size_t node) const { return inverses_.data() + node * length_; }

    /// L_i^-1 B L_j^-T in the place of B.
    void scale(std::size_t i, std::size_t j, std::span<double> B) const;

    /// L^-1 D B in the place of B [size][columns]: L^T B, where D is the block that was given.
    void divide_product(std::size_t node, const double* D, double* B, int columns) const;

  private:
    int size_;
    std::size_t length_;
    std::vector<double> inverses_;  ///< [nodes][size][size]
};

}  // namespace thermocontact::multigrid
