#include "solve/condensed_problem.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

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

void CondensedProblem::evaluate_at(const Eigen::VectorXd& x, NonlinearTerm& F) {
    Eigen::VectorXd value;
    F.evaluate(x, value);
}

double CondensedProblem::largest_unknown(const Eigen::VectorXd& start) {
    if (rhs_.size() == 0) {
        return 0.0;
    }
    return std::max(system_.schur_complement().ldlt().solve(rhs_).cwiseAbs().maxCoeff(),
                    start.cwiseAbs().maxCoeff());
}

bool CondensedProblem::finish(const Eigen::VectorXd& x, std::vector<double>& solution) {
    system_.expand(x, solution);
    return std::ranges::all_of(solution, [](double value) { return std::isfinite(value); });
}

std::unique_ptr<StepProblem> Condensed::prepare(const StepProblemInput& input) {
    return std::make_unique<CondensedProblem>(input, orders_.without(input.contact_nodes), workers_);
}

}  // namespace thermocontact::solve
