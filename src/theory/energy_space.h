/// The spaces V and Q of the paper, discretised: fields that vanish where values are prescribed, with the
/// norm of their strain or gradient.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "fem/block_matrix.h"
#include "solve/condensed_system.h"
#include "theory/largest_quotient.h"

namespace thermocontact::theory {

class EnergySpace {
  public:
    /// `gram` belongs to the norm, `fixed` [dofs] marks the prescribed unknowns. The norm is one only if
    /// prescribed values hold the body; `held` tells what is known of that.
    EnergySpace(fem::BlockMatrix gram, const std::vector<char>& fixed, bool held);

    /// y := B x for nodal vectors [dofs] of a symmetric positive semidefinite B.
    using NodalProduct = std::function<void(const std::vector<double>& x, std::vector<double>& y)>;

    /// max of (B v, v) / |v|^2 over the space; infinite where |v| is not a norm. Throws NumericsError if it
    /// is not found.
    Eigenvalue largest_quotient(const NodalProduct& B);

  private:
    void apply(const NodalProduct& product, const Eigen::VectorXd& x, Eigen::VectorXd& y);
    void solve(const Eigen::VectorXd& x, Eigen::VectorXd& y);

    void scatter(const Eigen::VectorXd& x);
    void gather(const std::vector<double>& nodal, Eigen::VectorXd& y) const;

    fem::BlockMatrix gram_;
    std::vector<std::int32_t> free_;                ///< dofs of the unknowns
    std::optional<solve::CondensedSystem> system_;  ///< empty where the Gram matrix is singular
    std::vector<double> x_, y_;                     ///< [dofs]
};

}  // namespace thermocontact::theory
