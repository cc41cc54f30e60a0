#include "march/balance.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "error.h"
#include "march/vectors.h"
#include "number.h"
#include "solve/continuation.h"
#include "stopwatch.h"

namespace thermocontact::march {
namespace {

solve::CondensedSystem condense(const std::string& equation, const fem::BlockMatrix& matrix,
                                const model::Prescribed& prescribed, const std::vector<char>& contact_nodes,
                                const fem::Space& space, solve::InteriorOrders& orders, double& seconds) {
    try {
        return timed(seconds, [&] {
            return solve::CondensedSystem(matrix, prescribed.fixed(), contact_nodes,
                                          orders.without(contact_nodes));
        });
    } catch (const solve::NotPositiveDefinite& failure) {
        const mesh::Point& x = space.nodes[static_cast<std::size_t>(failure.row / matrix.rows)];
        throw NumericsError(
            equation + ": the system is singular or indefinite, seen at (" + short_text(x[0]) + ", " +
            short_text(x[1]) + ") component " + std::to_string(failure.row % matrix.rows) +
            "; the body may be free to move, or a tensor not positive; prescribe a value on a "
            "boundary, or add density (heat: capacity)");
    }
}

std::string failure_text(const std::string& equation, const solve::NewtonResult& first,
                         const solve::ContinuationResult* ladder) {
    std::string text = equation + ": Newton stopped after " + std::to_string(first.iterations) +
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

Balance::Balance(std::string equation, const scene::SolverSpec& options, fem::BlockMatrix matrix,
                 model::Prescribed prescribed, const std::vector<char>& contact_nodes,
                 model::FacetTerm contact, const fem::Space& space, solve::InteriorOrders& orders,
                 std::vector<double>& unknown)
    : equation_(std::move(equation)),
      matrix_(std::move(matrix)),
      prescribed_(std::move(prescribed)),
      contact_(std::move(contact)),
      unknown_(&unknown),
      system_(condense(equation_, matrix_, prescribed_, contact_nodes, space, orders, factor_seconds_)),
      newton_({options.tolerance, options.max_iterations}) {
    contact_.restrict_to(system_.contact_dofs());
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
    const Eigen::VectorXd condensed =
        timed(seconds_.triangular_solves, [&] { return system_.condense(rhs); });
    Eigen::VectorXd x(condensed.size());
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        x[i] = (*unknown_)[static_cast<std::size_t>(system_.contact_dofs()[static_cast<std::size_t>(i)])];
    }
    SolveReport report;
    if (x.size() > 0) {
        report = timed(seconds_.newton, [&] { return solve_contact(condensed, x); });
    }
    timed(seconds_.triangular_solves, [&] { system_.expand(x, *unknown_); });
    if (!as_eigen(*unknown_).allFinite()) {
        throw NumericsError(equation_ +
                            ": the solution is not finite; scale the data, or use more time.steps");
    }
    return report;
}

SolveReport Balance::solve_contact(const Eigen::VectorXd& rhs, Eigen::VectorXd& x) {
    const Eigen::MatrixXd& S = system_.schur_complement();
    const Eigen::VectorXd start = x;
    const solve::NewtonResult direct = newton_.solve(S, rhs, contact_, x);
    if (direct.end == solve::NewtonEnd::converged) {
        return {direct.iterations, 0};
    }
    const double target = contact_.smallest_regularisation();
    if (target == 0) {
        throw NumericsError(failure_text(equation_, direct, nullptr));
    }
    const auto rung = [&](double floor, Eigen::VectorXd& value) {
        contact_.raise_regularisation(floor);
        return newton_.solve(S, rhs, contact_, value);
    };
    // the fastest unknown bounds the slip: friction regularised at that velocity is nearly linear
    x = start;
    const double fastest = std::max(rhs.size() > 0 ? (S.ldlt().solve(rhs)).cwiseAbs().maxCoeff() : 0.0,
                                    start.cwiseAbs().maxCoeff());
    const solve::ContinuationResult ladder = solve::continue_regularisation(rung, fastest, target, x);
    contact_.raise_regularisation(0);
    if (ladder.newton.end != solve::NewtonEnd::converged) {
        throw NumericsError(failure_text(equation_, direct, &ladder));
    }
    return {direct.iterations + ladder.newton.iterations, ladder.rungs};
}

}  // namespace thermocontact::march
