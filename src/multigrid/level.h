/// A level of multigrid and its smoother: Chebyshev's polynomial of the scaled matrix, least on the upper
/// part of its spectrum (Adams, Brezina, Hu, Tuminaro 2003).
#pragma once

#include <optional>
#include <vector>

#include "multigrid/matrix.h"
#include "multigrid/prolongation.h"
#include "multigrid/shared_nodes.h"

namespace thermocontact::multigrid {

class Level {
  public:
    /// Every process must call, here and below.
    Level(Matrix matrix, SharedNodes nodes);

    /// From x = 0; afterwards residual = b - A x.
    void smooth_from_zero();

    /// From x.
    void smooth();

    const Matrix& matrix() const { return matrix_; }
    const SharedNodes& nodes() const { return nodes_; }
    double largest() const { return largest_; }  ///< eigenvalue, estimated

    std::optional<Prolongation> prolongation;  ///< from the next coarser level; empty on the coarsest
    std::vector<float> x, b, residual;         ///< padded nodal vectors

  private:
    enum class Residual { at_end, not_at_end };

    std::size_t stride() const;
    void subtract_product(const std::vector<float>& from, std::vector<float>& to);
    void run_polynomial(Residual wanted);
    double largest_eigenvalue();

    Matrix matrix_;
    SharedNodes nodes_;
    std::vector<float> direction_;
    double largest_ = 1;
};

}  // namespace thermocontact::multigrid
