#include "solve/condensed_problem.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace thermocontact::solve {
namespace {

bool all_finite(const std::vector<double>& values) {
    return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

}  // namespace

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
    return all_finite(solution);
}

/// (A + dF/dx)^-1 or its transpose, over the unknowns in the order of the factor.
Eigen::VectorXd CondensedProblem::solve_with_factors(const Eigen::VectorXd& rhs, bool transposed) {
    std::vector<double> full(static_cast<std::size_t>(matrix_->graph->node_count()) *
                             static_cast<std::size_t>(matrix_->rows));
    const std::vector<std::int32_t>& dofs = system_.dofs();
    for (std::size_t i = 0; i < dofs.size(); ++i) {
        full[static_cast<std::size_t>(dofs[i])] = rhs[static_cast<Eigen::Index>(i)];
    }
    const Eigen::VectorXd condensed = system_.condense(full);
    Eigen::VectorXd contact;
    if (condensed.size() > 0 && transposed) {
        contact = newton_.factors().transpose().solve(condensed);
    } else if (condensed.size() > 0) {
        contact = newton_.factors().solve(condensed);
    }
    system_.expand(contact, full);
    Eigen::VectorXd x(rhs.size());
    for (std::size_t i = 0; i < dofs.size(); ++i) {
        x[static_cast<Eigen::Index>(i)] = full[static_cast<std::size_t>(dofs[i])];
    }
    return x;
}

std::optional<Condition> CondensedProblem::condition(const std::vector<double>& solution) {
    const std::vector<std::int32_t>& dofs = system_.dofs();
    const auto contact_count = static_cast<Eigen::Index>(contact_dofs().size());
    const Eigen::MatrixXd* derivative = newton_.derivative();
    if ((contact_count > 0 && derivative == nullptr) || !all_finite(solution)) {
        return std::nullopt;
    }
    const std::vector<double> magnitudes = product_of_magnitudes(*matrix_, solution);
    const auto count = static_cast<Eigen::Index>(dofs.size());
    Eigen::VectorXd x(count), g(count);
    for (std::size_t i = 0; i < dofs.size(); ++i) {
        x[static_cast<Eigen::Index>(i)] = solution[static_cast<std::size_t>(dofs[i])];
        g[static_cast<Eigen::Index>(i)] = magnitudes[static_cast<std::size_t>(dofs[i])];
    }
    double of_contact = 1;
    if (contact_count > 0) {
        const Eigen::VectorXd contact = x.tail(contact_count);
        g.tail(contact_count) += (*derivative - system_.schur_complement()).cwiseAbs() * contact.cwiseAbs();
        of_contact = newton_.condition(contact).value_or(1.0);
    }
    return Condition{
        skeel_condition([this](const Eigen::VectorXd& v) { return solve_with_factors(v, false); },
                        [this](const Eigen::VectorXd& v) { return solve_with_factors(v, true); }, g, x),
        of_contact};
}

std::unique_ptr<StepProblem> Condensed::prepare(const StepProblemInput& input) {
    return std::make_unique<CondensedProblem>(input, orders_.without(input.contact_nodes), workers_);
}

}  // namespace thermocontact::solve
