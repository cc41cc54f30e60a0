/// What the two balances of a step share: a system with prescribed values and a contact term, solved by a
/// strategy.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "march/state.h"
#include "model/facet_term.h"
#include "model/nodal.h"
#include "scene/scene.h"
#include "solve/step_problem.h"

namespace thermocontact::march {

/// Solves A x + F(x) = r for the unknowns that are not prescribed, A prepared once.
class Balance {
  public:
    /// `unknown` is the trial field [dofs] that the contact term reads and solve() fills.
    /// Throws NumericsError where A is singular.
    Balance(std::string name, const scene::SolverSpec& options, fem::BlockMatrix matrix,
            model::Prescribed prescribed, const std::vector<char>& contact_nodes, model::FacetTerm contact,
            const fem::Space& space, solve::Strategy& strategy, std::vector<double>& unknown);

    /// `unknown` holds the prescribed values and a start value elsewhere; `rhs` [dofs] is used up. Throws
    /// NumericsError if no solution is found, having tried Newton and continuation in the regularisation.
    SolveReport solve(std::vector<double>& rhs);

    const model::Prescribed& prescribed() const { return prescribed_; }
    model::FacetTerm& contact() { return contact_; }
    /// Time spent in solve().
    const StepSeconds& seconds() const { return seconds_; }
    double factor_seconds() const { return factor_seconds_; }
    std::int64_t factor_entries() const { return problem_->factor_entries(); }
    std::size_t contact_unknowns() const { return problem_->contact_dofs().size(); }

  private:
    SolveReport solve_contact(Eigen::VectorXd& x);
    void remove_prescribed(std::vector<double>& rhs);

    std::string name_;  ///< "momentum", "heat"
    fem::BlockMatrix matrix_;
    model::Prescribed prescribed_;
    model::FacetTerm contact_;
    std::vector<double>* unknown_;
    StepSeconds seconds_;
    double factor_seconds_ = 0;
    std::unique_ptr<solve::StepProblem> problem_;
};

}  // namespace thermocontact::march
