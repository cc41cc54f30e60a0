/// Whether a solution is as good as a factor in double precision would make it.
///
/// A factor stored in 32 bits a number (column_group.h) solves (A + dA) d = b with dA some 2^-32 of A. Used
/// for the correction d of a start value (defect correction), it leaves the defect dA d: against A w that is
/// as small as rounding where the start value is near w, and each further pass takes another such share off.
///
/// How small is small: Cholesky's method in double precision solves (A + dA) w = b with
///
///   |dA_ij| <= omega (a_ii a_jj)^(1/2),      omega = a small multiple of epsilon
///
/// (N. J. Higham, Accuracy and Stability of Numerical Algorithms, 10.1). For any w with the defect r that
/// omega is
///
///   omega = max_i |r_i| / a_ii^(1/2)  /  max_j a_jj^(1/2) |w_j|:
///
/// dA_ij = r_i / w_j, with j where the second maximum is and 0 elsewhere, makes w exact, and no dA within a
/// smaller bound has entries that reach r_i by fewer than all of a row's unknowns. It is the same for an
/// unknown in any units.
///
/// Passes contract as long as the factor can be made at all: dA = dL L^T + L dL^T, and for the vector v of
/// the smallest eigenvalue lambda |L^T v|^2 = lambda |v|^2, so that what is left of a correction along v is
/// v^T dA v/lambda = 2 |dL|/lambda^(1/2), some 2^-32 (cond A)^(1/2).
#pragma once

#include <span>
#include <vector>

#include "fem/traversal.h"

namespace thermocontact::solve {

class Defect {
  public:
    /// `matrix` must stay, `fixed` [dofs] marks the unknowns that are none.
    Defect(const fem::BlockMatrix& matrix, const std::vector<char>& fixed, fem::Beside beside);

    /// Keeps the defect rhs - A w of w = solution [dofs], zero where fixed.
    void take(const std::vector<double>& rhs, const std::vector<double>& solution);

    const std::vector<double>& value() const { return value_; }

    /// omega for A w + forces = rhs, of what was taken last; `forces` are those at the listed dofs, 0 at
    /// others. Infinite where a number is not finite.
    double backward_error(const std::vector<double>& rhs, const std::vector<double>& solution,
                          std::span<const std::int32_t> dofs, std::span<const double> forces);

  private:
    double largest_share(const std::vector<double>& rhs, const std::vector<double>& solution) const;

    const fem::BlockMatrix* matrix_;
    fem::Traversal traversal_;
    std::vector<double> roots_;  ///< a_ii^(1/2); 0 where fixed
    std::vector<std::int32_t> fixed_dofs_;
    std::vector<double> value_;
    std::vector<double> masked_;  ///< w where some of the fixed unknowns have a value
};

}  // namespace thermocontact::solve
