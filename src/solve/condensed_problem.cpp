#include "solve/condensed_problem.h"

#include <Eigen/Cholesky>

namespace thermocontact::solve {

Eigen::VectorXd CondensedProblem::begin(const std::vector<double>& rhs, const std::vector<double>& start) {
    rhs_ = system_.condense(rhs);
    Eigen::VectorXd x(rhs_.size());
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        x[i] = start[static_cast<std::size_t>(contact_dofs()[static_cast<std::size_t>(i)])];
    }
    return x;
}

NewtonResult CondensedProblem::solve(NonlinearTerm& F, Eigen::VectorXd& x) {
    if (x.size() == 0) {
        return {NewtonEnd::converged, 0, 0.0};
    }
    return newton_.solve(system_.schur_complement(), rhs_, F, x);
}

double CondensedProblem::largest_without_contact() {
    return rhs_.size() > 0 ? system_.schur_complement().ldlt().solve(rhs_).cwiseAbs().maxCoeff() : 0.0;
}

std::unique_ptr<StepProblem> Condensed::prepare(const StepProblemInput& input) {
    return std::make_unique<CondensedProblem>(input, orders_.without(input.contact_nodes));
}

}  // namespace thermocontact::solve
