#include "solve/condensed_problem.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace thermocontact::solve {
namespace {

bool all_finite(const std::vector<double>& values) {
    return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

/// Backward error (refinement.h) that may be left: what Newton's method is asked for on the contact unknowns,
/// but not less than what rounding leaves of a defect (up to 243 terms a row in space, whose errors add up at
/// random to some 16 epsilon), and not more than 1e-12 however loose Newton's tolerance is: its last update
/// (polish) leaves round-off as well. The fields are then off by at most 1e-12 times the condition number,
/// and so are, relative to the forces, single nodes' balances; sums of these cancel (audits below 1e-12
/// measured).
double allowed_error(double tolerance) {
    return std::clamp(tolerance, 64 * std::numeric_limits<double>::epsilon(), 1e-12);
}

/// A pass takes far more off the defect; where it does not, the factor is too coarse for the system.
constexpr double least_contraction = 0.1;

}  // namespace

CondensedProblem::CondensedProblem(const StepProblemInput& input, std::span<const std::int32_t> interior,
                                   std::shared_ptr<Workers> workers, Storage storage)
    : matrix_(&input.matrix),
      make_system_([&matrix = input.matrix, &fixed = input.fixed, &contact = input.contact_nodes, interior,
                    workers](Storage kind) {
          return CondensedSystem(matrix, fixed, contact, interior, workers, kind);
      }),
      system_(make_system_(storage)),
      newton_(input.newton) {
    if (storage == Storage::words) {
        correction_.emplace(Correction{
            Defect(input.matrix, input.fixed,
                   [workers](int count, const std::function<void(int)>& task) { workers->run(count, task); }),
            allowed_error(input.newton.tolerance)});
    }
}

Eigen::VectorXd CondensedProblem::on_contact(const std::vector<double>& values) const {
    Eigen::VectorXd x(static_cast<Eigen::Index>(contact_dofs().size()));
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        x[i] = values[static_cast<std::size_t>(contact_dofs()[static_cast<std::size_t>(i)])];
    }
    return x;
}

Eigen::VectorXd CondensedProblem::begin(const std::vector<double>& rhs, const std::vector<double>& start) {
    if (!correction_) {
        rhs_ = system_.condense(rhs);
        return on_contact(start);
    }
    correction_->rhs = &rhs;
    correction_->defect.take(rhs, start);
    condense_defect(start);
    return correction_->start;
}

/// A (start + d) + F = r condenses to S (x - start) + F(x) = the condensed defect of the start value.
void CondensedProblem::condense_defect(const std::vector<double>& solution) {
    correction_->start = on_contact(solution);
    rhs_ = system_.condense(correction_->defect.value());
    if (rhs_.size() > 0) {
        rhs_.noalias() += system_.schur_complement() * correction_->start;
    }
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

void CondensedProblem::write_contact(const Eigen::VectorXd& x, std::vector<double>& solution) const {
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        solution[static_cast<std::size_t>(contact_dofs()[static_cast<std::size_t>(i)])] = x[i];
    }
}

bool CondensedProblem::finish(const Eigen::VectorXd& x, std::vector<double>& solution) {
    if (!correction_) {
        return system_.expand(x, solution);
    }
    const bool finite = system_.add_expanded(x - correction_->start, solution);
    write_contact(x, solution);
    return finite;
}

/// In contact rows A w lacks F, of which the condensed problem knows to be s - S x: what the passes lose
/// shows there, what Newton's method leaves does not.
double CondensedProblem::backward_error(const Eigen::VectorXd& x, const std::vector<double>& solution) {
    correction_->defect.take(*correction_->rhs, solution);
    Eigen::VectorXd forces = rhs_;
    if (x.size() > 0) {
        forces.noalias() -= system_.schur_complement() * x;
    }
    return correction_->defect.backward_error(*correction_->rhs, solution, contact_dofs(),
                                              {forces.data(), static_cast<std::size_t>(forces.size())});
}

/// From now on. Neither S nor the order of its unknowns changes.
void CondensedProblem::use_doubles() {
    system_ = make_system_(Storage::doubles);
    correction_.reset();
    too_coarse_ = true;
}

std::optional<KeptDerivative> CondensedProblem::kept_derivative() const {
    std::optional<KeptDerivative> kept = newton_.kept_derivative(system_.schur_complement());
    if (too_coarse_) {
        kept = kept.value_or(KeptDerivative{});
        kept->in_doubles = true;
    }
    return kept;
}

void CondensedProblem::take_up(const KeptDerivative& derivative) {
    if (derivative.in_doubles && correction_) {
        use_doubles();
    }
    newton_.take_up(system_.schur_complement(), derivative);
}

NewtonResult CondensedProblem::refine(NonlinearTerm& F, Eigen::VectorXd& x, std::vector<double>& solution) {
    NewtonResult result{NewtonEnd::converged, 0, 0.0};
    double before = std::numeric_limits<double>::infinity();
    while (correction_) {
        const double error = backward_error(x, solution);
        if (error <= correction_->allowed) {
            return result;
        }
        if (!(error < least_contraction * before)) {
            const std::vector<double>& rhs = *correction_->rhs;
            use_doubles();
            rhs_ = system_.condense(rhs);
        } else {
            condense_defect(solution);
        }
        ++corrections_;
        before = error;
        const int iterations = result.iterations;
        result = solve(F, x);
        result.iterations += iterations;
        if (result.end != NewtonEnd::converged || !finish(x, solution)) {
            return {result.end == NewtonEnd::converged ? NewtonEnd::not_finite : result.end, iterations, 0.0};
        }
    }
    return result;
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
    return std::make_unique<CondensedProblem>(input, orders_.without(input.contact_nodes), workers_,
                                              storage_);
}

}  // namespace thermocontact::solve
