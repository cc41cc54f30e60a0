/// A level of multigrid and its smoother: Chebyshev's polynomial of D^-1 A with D the blocks of A's diagonal,
/// least on the upper part of the spectrum (Adams, Brezina, Hu, Tuminaro 2003).
#pragma once

#include <optional>
#include <vector>

#include "multigrid/matrix.h"
#include "multigrid/prolongation.h"
#include "multigrid/shared_nodes.h"

namespace thermocontact::multigrid {

class Level {
  public:
    /// Every process must call.
    Level(Matrix matrix, SharedNodes nodes);

    /// From x = 0; afterwards residual = b - A x.
    void smooth_from_zero();

    /// From x.
    void smooth();

    const Matrix& matrix() const { return matrix_; }
    const SharedNodes& nodes() const { return nodes_; }
    const std::vector<float>& diagonal() const {
        return diagonal_;
    }  ///< [nodes][size][lanes(size)], added up
    const std::vector<float>& inverse_diagonal() const { return inverse_diagonal_; }
    double largest() const { return largest_; }  ///< eigenvalue of D^-1 A, estimated
    std::size_t vector_length() const;

    std::optional<Prolongation> prolongation;  ///< from the next coarser level; empty on the coarsest
    std::vector<float> x, b, residual;         ///< padded nodal vectors

  private:
    void multiply(const std::vector<float>& from, std::vector<float>& to);
    enum class Residual { at_end, not_at_end };
    void run_polynomial(Residual wanted);
    double largest_eigenvalue();

    Matrix matrix_;
    SharedNodes nodes_;
    std::vector<float> diagonal_, inverse_diagonal_, direction_, product_;
    double largest_ = 1;
};

}  // namespace thermocontact::multigrid
