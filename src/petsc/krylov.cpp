#include "petsc/krylov.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "petsc/check.h"
#include "petsc/events.h"
#include "solve/cycle.h"
#include "solve/line_search.h"

namespace thermocontact::petsc {
namespace {

constexpr double loosest = 1e-1;  ///< relative tolerance of the first linear solves of a step
constexpr double tightest = 1e-10;
/// A step ends a hundredfold beyond the tolerance, as contact laws multiply what the momentum balance leaves:
/// an error of the gap is a share of the onset, over which conductance rises, and |u| may be thousands of
/// these. Where the last solve stays above, which is the rest of a Newton step and not of the solver, a short
/// one follows (polish). In scenes/brake-pad.toml a tenth of the tolerance left 1.2e-9 of the flow, a
/// hundredth 4e-11; in scenes/box.toml (hexahedra of degree 2, 4 processes) 0.87 of it left 8e-9.
constexpr double beyond_tolerance = 0.01, near_tolerance = 10;
/// What rounding leaves of a residual is known from a short solve that did not halve it. No step is asked for
/// less, and what comes within twice of it ends one. A step forgets a tenth: the next ones may leave less.
constexpr double forgotten = 0.9, close_enough = 2;
constexpr PetscInt most_iterations = 1000;
constexpr PetscInt gmres_restart = 60;
constexpr double worn_out = 1.5;  ///< times the iterations of a new hierarchy: time for another
constexpr int worn_out_margin = 5;

double norm(Vec v) {
    PetscReal result = 0;
    check(VecNorm(v, NORM_2, &result));
    return result;
}

}  // namespace

KrylovProblem::KrylovProblem(const solve::StepProblemInput& input, const parallel::Part& part,
                             const parallel::Team& team)
    : name_(input.name),
      matrix_(&input.matrix),
      numbers_(&part.numbers),
      team_(&team),
      fixed_(input.fixed),
      options_(input.newton),
      symmetric_(input.symmetric),
      vectors_(part.numbers, input.matrix.rows),
      tangent_(input.matrix, fixed_, vectors_),
      preconditioner_(input.matrix, fixed_, part, team) {
    const auto b = static_cast<std::size_t>(input.matrix.rows);
    for (std::size_t dof = 0; dof < fixed_.size(); ++dof) {
        if (input.contact_nodes[dof / b] != 0 && fixed_[dof] == 0) {
            contact_dofs_.push_back(static_cast<std::int32_t>(dof));
        }
    }
    has_contact_ = team.any(!contact_dofs_.empty());
    for (Vector* vector : {&x_, &rhs_, &linear_, &nonlinear_, &residual_, &update_, &candidate_}) {
        *vector = vectors_.make();
    }
    local_x_.resize(fixed_.size());
    local_.resize(fixed_.size());
    local_z_.resize(fixed_.size());
    contact_x_.resize(static_cast<Eigen::Index>(contact_dofs_.size()));
    make_solver();
}

void KrylovProblem::make_solver() {
    check(KSPCreate(PETSC_COMM_WORLD, solver_.put()));
    check(KSPSetOptionsPrefix(solver_, (name_ + "_").c_str()));
    // flexible ones: a preconditioner in single precision is not quite linear
    check(KSPSetType(solver_, symmetric_ ? KSPCG : KSPFGMRES));
    if (!symmetric_) {
        check(KSPGMRESSetRestart(solver_, gmres_restart));
    }
    check(KSPSetNormType(solver_, KSP_NORM_UNPRECONDITIONED));
    check(KSPSetOperators(solver_, tangent_.shell(), tangent_.shell()));
    PC preconditioner = nullptr;
    check(KSPGetPC(solver_, &preconditioner));
    check(PCSetType(preconditioner, PCSHELL));
    check(PCShellSetContext(preconditioner, this));
    check(PCShellSetApply(preconditioner, &KrylovProblem::precondition));
    check(KSPSetFromOptions(solver_));
}

void KrylovProblem::free_only(std::vector<double>& local) const {
    for (std::size_t dof = 0; dof < local.size(); ++dof) {
        if (fixed_[dof] != 0) {
            local[dof] = 0.0;
        }
    }
}

Eigen::VectorXd KrylovProblem::begin(const std::vector<double>& rhs, const std::vector<double>& start) {
    local_ = rhs;
    free_only(local_);
    vectors_.add_up(local_, rhs_);
    Eigen::VectorXd x(vectors_.owned());
    for (std::size_t dof = 0; dof < start.size(); ++dof) {
        if (const PetscInt index = vectors_.owned_index(dof); index >= 0) {
            x[index] = fixed_[dof] != 0 ? 0.0 : start[dof];
        }
    }
    return x;
}

/// x on this part, and its entries that F takes.
void KrylovProblem::take(Vec x) {
    vectors_.take(x, local_x_);
    for (Eigen::Index i = 0; i < contact_x_.size(); ++i) {
        contact_x_[i] = local_x_[static_cast<std::size_t>(contact_dofs_[static_cast<std::size_t>(i)])];
    }
}

KrylovProblem::Residual KrylovProblem::residual(solve::NonlinearTerm& F, Vec x) {
    take(x);
    tangent_.multiply_constant(local_x_, linear_);
    check(VecWAXPY(residual_, -1.0, rhs_, linear_));
    const double linear_norm = norm(linear_);
    double nonlinear_norm = 0;
    if (has_contact_) {
        const Timed timed(Events::all().contact);
        F.evaluate(contact_x_, contact_F_);
        std::ranges::fill(local_, 0.0);
        for (Eigen::Index i = 0; i < contact_F_.size(); ++i) {
            local_[static_cast<std::size_t>(contact_dofs_[static_cast<std::size_t>(i)])] = contact_F_[i];
        }
        vectors_.add_up(local_, nonlinear_);
        check(VecAXPY(residual_, 1.0, nonlinear_));
        nonlinear_norm = norm(nonlinear_);
    }
    const double size = norm(residual_), scale = linear_norm + norm(rhs_) + nonlinear_norm;
    return {size, scale > 0 ? size / scale : size, linear_norm, nonlinear_norm};
}

void KrylovProblem::update_tangent(solve::NonlinearTerm& F) {
    if (has_contact_) {
        const Timed timed(Events::all().contact);
        tangent_.set_derivative(F, contact_x_, contact_dofs_);
    }
}

/// A new hierarchy for the tangent there is.
void KrylovProblem::renew_hierarchy() {
    const Timed timed(Events::all().hierarchy);
    preconditioner_.renew(tangent_.derivative());
}

PetscErrorCode KrylovProblem::precondition(PC shell, Vec r, Vec z) {
    KrylovProblem* self = nullptr;
    if (const PetscErrorCode code = PCShellGetContext(shell, &self); code != 0) {
        return code;
    }
    try {
        const Timed timed(Events::all().cycle);
        self->vectors_.take(r, self->local_);
        self->preconditioner_.apply(self->local_, self->local_z_);
        self->vectors_.put(self->local_z_, z);
    } catch (const SystemError&) {  // not through PETSc's frames
        return PETSC_ERR_LIB;
    }
    return 0;
}

bool KrylovProblem::solve_linear(double tolerance) {
    const Timed timed(Events::all().linear);
    const auto attempt = [&](PetscInt& iterations) {
        check(KSPSolve(solver_, residual_, update_));
        tangent_.zero_fixed(update_);  // multigrid moves prescribed unknowns by what its tolerance allows
        KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
        check(KSPGetConvergedReason(solver_, &reason));
        check(KSPGetIterationNumber(solver_, &iterations));
        iterations_ += iterations;
        return reason > 0;
    };
    check(KSPSetTolerances(solver_, tolerance, PETSC_DEFAULT, PETSC_DEFAULT, most_iterations));
    PetscInt iterations = 0;
    // the number of iterations is about proportional to the digits asked for
    const double digits = -std::log10(tolerance);
    if (fresh_rate_ && attempt(iterations)) {
        if (iterations > worn_out * *fresh_rate_ * digits + worn_out_margin) {
            fresh_rate_.reset();  // good enough this time
        }
        return true;
    }
    renew_hierarchy();
    const bool solved = attempt(iterations);
    fresh_rate_ = solved ? std::optional(iterations / digits) : std::nullopt;
    return solved;
}

/// As in solve::Newton::is_round_off.
bool KrylovProblem::is_round_off(solve::NonlinearTerm& F, const Residual& current) {
    residual(F, x_);
    PetscReal rest = 0, forces = 0;
    check(VecNorm(residual_, NORM_1, &rest));
    check(VecNorm(nonlinear_, NORM_1, &forces));
    return solve::may_be_round_off(current.relative, rest, has_contact_ ? forces : 0.0, options_.tolerance) &&
           current.norm <= round_off(F);
}

double KrylovProblem::round_off(solve::NonlinearTerm& F) {
    local_ = solve::product_of_magnitudes(*matrix_, local_x_);
    for (double& value : local_x_) {
        value = std::abs(value);
    }
    tangent_.add_derivative_magnitudes(local_x_, local_);
    contact_F_.setZero(contact_x_.size());
    F.add_sensitivity(contact_x_, contact_F_);
    for (Eigen::Index i = 0; i < contact_F_.size(); ++i) {
        local_[static_cast<std::size_t>(contact_dofs_[static_cast<std::size_t>(i)])] += contact_F_[i];
    }
    free_only(local_);
    vectors_.add_up(local_, linear_);
    return std::numeric_limits<double>::epsilon() * norm(linear_);
}

/// What Newton's last step leaves is anything below the tolerance: one more, of a few iterations, brings it
/// near round-off; taken if it lowers the residual.
void KrylovProblem::polish(solve::NonlinearTerm& F, Residual& current) {
    const double wanted = goal() / current.relative;
    if (!has_contact_ || close_enough * wanted >= 1) {
        return;
    }
    update_tangent(F);
    if (!solve_linear(std::clamp(wanted, tightest, loosest))) {
        return;
    }
    check(VecWAXPY(candidate_, -1.0, update_, x_));
    const Residual next = residual(F, candidate_);
    if (2 * next.norm > current.norm) {
        rounding_ = std::min(next.relative, current.relative);
    }
    if (next.norm < current.norm) {
        check(VecCopy(candidate_, x_));
        current = next;
    }
}

/// The relative residual that a step is to end with.
double KrylovProblem::goal() const {
    return std::max(beyond_tolerance * options_.tolerance, rounding_);
}

solve::NewtonResult KrylovProblem::solve(solve::NonlinearTerm& F, Eigen::VectorXd& x) {
    using solve::NewtonEnd;
    check(VecPlaceArray(x_, x.data()));
    struct Reset {
        Vec vector;
        ~Reset() { VecResetArray(vector); }
    } reset{x_};
    rounding_ *= forgotten;
    began_ = true;
    Residual current = residual(F, x_);
    double forcing = has_contact_ ? loosest : tightest;
    solve::CycleDetector cycle;
    for (int iteration = 0;; ++iteration) {
        if (!std::isfinite(current.norm)) {
            return {NewtonEnd::not_finite, iteration, current.relative};
        }
        if (current.relative <= options_.tolerance) {
            polish(F, current);
            return {NewtonEnd::converged, iteration, current.relative};
        }
        const auto excused = [&] { return is_round_off(F, current); };
        const auto stalled = [&](NewtonEnd end) -> solve::NewtonResult {
            if (excused()) {
                return {NewtonEnd::converged, iteration, current.relative, true};
            }
            residual(F, x_);
            return {end, iteration, current.relative, false, current.relative * round_off(F) / current.norm};
        };
        if (iteration == options_.max_iterations) {
            return stalled(NewtonEnd::too_many_iterations);
        }
        if (cycle.returns({current.norm, current.linear_norm, current.nonlinear_norm})) {
            return stalled(NewtonEnd::cycling);
        }
        update_tangent(F);
        // a solve that would come near the tolerance is to be the last, and no more digits than that
        const double end = goal() / current.relative;
        const bool is_last = forcing * current.relative <= near_tolerance * options_.tolerance;
        const double wanted = is_last ? end : std::max(forcing, end);
        if (!solve_linear(std::clamp(wanted, tightest, loosest))) {
            return stalled(NewtonEnd::not_solved);
        }
        const double before = current.norm;
        Residual next{};
        const auto work = [&] {  // of the residual along the step, which is -update
            PetscScalar product = 0;
            check(VecDot(update_, residual_, &product));
            return -product;
        };
        const solve::LineResidual start{before, work()};
        const auto attempt = [&](double length) -> solve::LineResidual {
            check(VecWAXPY(candidate_, -length, update_, x_));
            next = residual(F, candidate_);
            return {next.norm, work()};
        };
        if (!solve::line_search(start, excused, attempt)) {
            return stalled(NewtonEnd::line_search_failed);
        }
        check(VecCopy(candidate_, x_));
        current = next;
        // Eisenstat and Walker, choice 2
        const double ratio = current.norm / before;
        forcing = std::clamp(0.9 * ratio * ratio, tightest, loosest);
    }
}

void KrylovProblem::evaluate_at(const Eigen::VectorXd& x, solve::NonlinearTerm& F) {
    check(VecPlaceArray(x_, x.data()));
    residual(F, x_);
    check(VecResetArray(x_));
}

double KrylovProblem::largest_unknown(const Eigen::VectorXd& start) {
    double largest = start.size() > 0 ? start.cwiseAbs().maxCoeff() : 0.0;
    check(VecCopy(rhs_, residual_));
    tangent_.drop_derivative();
    if (solve_linear(loosest)) {
        PetscReal solution = 0;
        check(VecNorm(update_, NORM_INFINITY, &solution));
        largest = std::max(largest, solution);
    }
    return team_->max(largest);
}

bool KrylovProblem::finish(const Eigen::VectorXd& x, std::vector<double>& solution) {
    check(VecPlaceArray(x_, x.data()));
    vectors_.take(x_, local_x_);
    check(VecResetArray(x_));
    for (std::size_t dof = 0; dof < solution.size(); ++dof) {
        if (fixed_[dof] == 0) {
            solution[dof] = local_x_[dof];
        }
    }
    return !team_->any(!x.allFinite());
}

}  // namespace thermocontact::petsc
