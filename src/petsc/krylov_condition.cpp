// The condition of strategy "newton-krylov": as solve/condition.h has it, by Krylov solves with the tangent
// of the last iteration and its transpose.
//
// The method of Hager and Higham wants whole vectors, which every process has in the order of the whole mesh:
// all decide alike, and the estimate does not depend on how the mesh was cut, but for entries that several
// parts share, whose magnitudes add up part by part. A solve leaves a residual of `precision` of its
// right-hand side, and an error of that share of the largest norm that a solution can have, which is the one
// that is looked for.

#include <algorithm>
#include <cmath>

#include "petsc/check.h"
#include "petsc/krylov.h"

namespace thermocontact::petsc {
namespace {

constexpr double precision = 1e-6;
constexpr int most_solves = 10;            ///< of the estimate; five, mostly
constexpr double share = 0.01;             ///< of the iterations of a run that the estimate may cost
constexpr double slowest = 100;            ///< iterations a digit, where nothing is known
constexpr std::int32_t few_nodes = 3'000;  ///< on which a solve takes milliseconds

}  // namespace

bool KrylovProblem::estimate_is_cheap() const {
    if (numbers_->total() <= few_nodes) {
        return true;
    }
    const double foreseen = most_solves * -std::log10(precision) * fresh_rate_.value_or(slowest);
    return foreseen <= share * static_cast<double>(iterations_);
}

/// Of values [dofs] of the parts: the owned ones, or sums of those at shared nodes.
Eigen::VectorXd KrylovProblem::whole(const std::vector<double>& local, bool adds_up) const {
    const auto b = static_cast<std::size_t>(matrix_->rows);
    Eigen::VectorXd all = Eigen::VectorXd::Zero(numbers_->total() * matrix_->rows);
    for (std::size_t dof = 0; dof < local.size(); ++dof) {
        if (adds_up || numbers_->owns(dof / b)) {
            all[numbers_->whole[dof / b] * matrix_->rows + static_cast<Eigen::Index>(dof % b)] = local[dof];
        }
    }
    team_->sum(std::span(all.data(), static_cast<std::size_t>(all.size())));
    return all;
}

/// Nothing where the iteration does not converge.
std::optional<Eigen::VectorXd> KrylovProblem::solve_whole(const Eigen::VectorXd& rhs, bool transposed) {
    const auto b = static_cast<std::size_t>(matrix_->rows);
    for (std::size_t dof = 0; dof < local_.size(); ++dof) {
        local_[dof] = rhs[numbers_->whole[dof / b] * matrix_->rows + static_cast<Eigen::Index>(dof % b)];
    }
    free_only(local_);
    vectors_.put(local_, residual_);
    const auto turn = [&] {  // where friction outweighs the body, a hierarchy serves its own tangent only
        if (transposed && !symmetric_) {
            tangent_.transpose();
            fresh_rate_.reset();
        }
    };
    turn();
    const bool solved = solve_linear(precision);
    turn();
    if (!solved) {
        return std::nullopt;
    }
    vectors_.take(update_, local_);
    return whole(local_, false);
}

std::optional<solve::Condition> KrylovProblem::condition(const std::vector<double>& solution) {
    const bool finite = std::ranges::all_of(solution, [](double value) { return std::isfinite(value); });
    if (team_->any(!finite) || !began_ || !estimate_is_cheap()) {
        return std::nullopt;
    }
    local_ = solve::product_of_magnitudes(*matrix_, solution);
    local_x_ = solution;
    for (double& value : local_x_) {
        value = std::abs(value);
    }
    tangent_.add_derivative_magnitudes(local_x_, local_);
    free_only(local_);
    const Eigen::VectorXd g = whole(local_, true);
    local_ = solution;
    free_only(local_);
    const Eigen::VectorXd x = whole(local_, false);
    bool solved = true;
    const auto solve = [&](const Eigen::VectorXd& rhs, bool transposed) -> Eigen::VectorXd {
        std::optional<Eigen::VectorXd> result;
        if (solved) {
            result = solve_whole(rhs, transposed);
        }
        solved = result.has_value();
        return result ? std::move(*result) : Eigen::VectorXd::Zero(rhs.size());
    };
    const double system =
        solve::skeel_condition([&](const Eigen::VectorXd& v) { return solve(v, false); },
                               [&](const Eigen::VectorXd& v) { return solve(v, true); }, g, x);
    return solved ? std::optional(solve::Condition{system, std::nullopt}) : std::nullopt;
}

}  // namespace thermocontact::petsc
