/// What the two balances of a step share: a condensed system with prescribed values and a contact term.
#pragma once

#include <string>
#include <vector>

#include "march/state.h"
#include "model/facet_term.h"
#include "model/nodal.h"
#include "scene/scene.h"
#include "solve/condensed_system.h"

namespace thermocontact::march {

/// Solves A x + F(x) = r for the unknowns that are not prescribed, A factored once.
class Balance {
  public:
    /// `unknown` is the trial field [dofs] that the contact term reads and solve() fills.
    /// Throws NumericsError where A is singular.
    Balance(std::string equation, const scene::SolverSpec& options, fem::BlockMatrix matrix,
            model::Prescribed prescribed, const std::vector<char>& contact_nodes, model::FacetTerm contact,
            const fem::Space& space, solve::InteriorOrders& orders, std::vector<double>& unknown);

    /// `unknown` holds the prescribed values and a start value elsewhere; `rhs` [dofs] is used up. Throws
    /// NumericsError if no solution is found, having tried Newton and continuation in the regularisation.
    SolveReport solve(std::vector<double>& rhs);

    const model::Prescribed& prescribed() const { return prescribed_; }
    model::FacetTerm& contact() { return contact_; }
    /// Time spent in solve().
    const StepSeconds& seconds() const { return seconds_; }
    double factor_seconds() const { return factor_seconds_; }
    std::int64_t factor_entries() const { return system_.factor_entries(); }
    std::size_t contact_unknowns() const { return system_.contact_dofs().size(); }

  private:
    SolveReport solve_contact(const Eigen::VectorXd& rhs, Eigen::VectorXd& x);
    void remove_prescribed(std::vector<double>& rhs);

    std::string equation_;
    fem::BlockMatrix matrix_;
    model::Prescribed prescribed_;
    model::FacetTerm contact_;
    std::vector<double>* unknown_;
    StepSeconds seconds_;
    double factor_seconds_ = 0;
    solve::CondensedSystem system_;
    solve::Newton newton_;
};

}  // namespace thermocontact::march
