#include "march/balance.h"

#include <algorithm>
#include <cmath>

#include "error.h"
#include "march/vectors.h"
#include "number.h"
#include "solve/continuation.h"
#include "solve/panel_factor.h"
#include "stopwatch.h"

namespace thermocontact::march {
namespace {

std::unique_ptr<solve::StepProblem> prepare(const solve::StepProblemInput& input, const fem::Space& space,
                                            solve::Strategy& strategy) {
    try {
        return strategy.prepare(input);
    } catch (const solve::NotPositiveDefinite& failure) {
        const mesh::Point& x = space.nodes[static_cast<std::size_t>(failure.row / input.matrix.rows)];
        throw NumericsError(
            input.name + " balance: the system is singular or indefinite, seen at (" + short_text(x[0]) +
            ", " + short_text(x[1]) + ") component " + std::to_string(failure.row % input.matrix.rows) +
            "; the body may be free to move, or a tensor not positive; prescribe a value on a "
            "boundary, or add density (heat: capacity)");
    }
}

std::string failure_text(const std::string& name, const solve::NewtonResult& first,
                         const solve::ContinuationResult* ladder) {
    std::string text = name + " balance: Newton stopped after " + std::to_string(first.iterations) +
                       " iterations (" + solve::describe(first.end) + ", relative residual " +
                       short_text(first.residual) + ")";
    if (ladder != nullptr) {
        text += "; continuation in friction.regularisation stopped after " + std::to_string(ladder->rungs) +
                " solves (" + solve::describe(ladder->newton.end) + ", relative residual " +
                short_text(ladder->newton.residual) + ")";
    }
    return text + "; try more time.steps, a larger friction.regularisation, or more solver.max_iterations";
}

}  // namespace

Balance::Balance(std::string name, const scene::SolverSpec& options, fem::BlockMatrix matrix,
                 model::Prescribed prescribed, const std::vector<char>& contact_nodes,
                 model::FacetTerm contact, const fem::Space& space, solve::Strategy& strategy,
                 std::vector<double>& unknown)
    : name_(std::move(name)),
      matrix_(std::move(matrix)),
      prescribed_(std::move(prescribed)),
      contact_(std::move(contact)),
      unknown_(&unknown) {
    const bool symmetric = contact_.smallest_regularisation() == 0;
    const solve::StepProblemInput input{
        name_,         matrix_,   prescribed_.fixed(),
        contact_nodes, symmetric, {options.tolerance, options.max_iterations}};
    problem_ = timed(factor_seconds_, [&] { return prepare(input, space, strategy); });
    contact_.restrict_to(problem_->contact_dofs());
}

void Balance::remove_prescribed(std::vector<double>& rhs) {
    const auto value = [&](std::int32_t dof) { return (*unknown_)[static_cast<std::size_t>(dof)]; };
    if (std::ranges::all_of(prescribed_.dofs(), [&](std::int32_t dof) { return value(dof) == 0.0; })) {
        return;
    }
    std::vector<double> values(rhs.size(), 0.0);
    for (const std::int32_t dof : prescribed_.dofs()) {
        values[static_cast<std::size_t>(dof)] = value(dof);
    }
    as_eigen(rhs) -= as_eigen(matrix_.multiply(values));
}

SolveReport Balance::solve(std::vector<double>& rhs) {
    remove_prescribed(rhs);
    Eigen::VectorXd x = timed(seconds_.triangular_solves, [&] { return problem_->begin(rhs, *unknown_); });
    const SolveReport report = timed(seconds_.newton, [&] { return solve_contact(x); });
    const bool finite = timed(seconds_.triangular_solves, [&] { return problem_->finish(x, *unknown_); });
    if (!finite) {
        throw NumericsError(name_ +
                            " balance: the solution is not finite; scale the data, or use more time.steps");
    }
    return report;
}

SolveReport Balance::solve_contact(Eigen::VectorXd& x) {
    const Eigen::VectorXd start = x;
    const solve::NewtonResult direct = problem_->solve(contact_, x);
    if (direct.end == solve::NewtonEnd::converged) {
        return {direct.iterations, 0};
    }
    const double target = contact_.smallest_regularisation();
    if (target == 0) {
        throw NumericsError(failure_text(name_, direct, nullptr));
    }
    const auto rung = [&](double floor, Eigen::VectorXd& value) {
        contact_.raise_regularisation(floor);
        return problem_->solve(contact_, value);
    };
    // the fastest unknown bounds the slip: friction regularised at that velocity is nearly linear
    x = start;
    const double fastest = problem_->largest_unknown(start);
    const solve::ContinuationResult ladder = solve::continue_regularisation(rung, fastest, target, x);
    contact_.raise_regularisation(0);
    if (ladder.newton.end != solve::NewtonEnd::converged) {
        throw NumericsError(failure_text(name_, direct, &ladder));
    }
    return {direct.iterations + ladder.newton.iterations, ladder.rungs};
}

}  // namespace thermocontact::march
