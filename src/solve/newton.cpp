#include "solve/newton.h"

#include <cmath>
#include <limits>

#include "solve/condition.h"
#include "solve/cycle.h"
#include "solve/line_search.h"
#include "solve/secants.h"

namespace thermocontact::solve {
namespace {

constexpr double good_rate = 0.1;  ///< of contraction: few iterations are left
constexpr double worst_rate = 0.5;
/// New factors take as long as this part of the unknowns' number of iterations with old ones: n^3 (2/3)
/// operations, of products of matrices, for n^2 numbers read. Measured, of 514 unknowns: 3.0 ms for 0.12 ms.
constexpr double iterations_per_unknown = 1.0 / 20;
constexpr double smallest_pivot = 1e-14;  ///< of the terms that it is the sum of; below is round-off

}  // namespace

const char* describe(NewtonEnd end) {
    switch (end) {
        case NewtonEnd::converged:
            return "converged";
        case NewtonEnd::too_many_iterations:
            return "too many Newton iterations";
        case NewtonEnd::cycling:
            return "contact states that recur";
        case NewtonEnd::line_search_failed:
            return "the line search found no descent";
        case NewtonEnd::not_finite:
            return "a value that is not finite";
        case NewtonEnd::singular:
            return "a singular Newton matrix";
        case NewtonEnd::not_solved:
            return "a linear system that its iteration did not solve";
        case NewtonEnd::not_reached:
            return "the value asked for was not reached";
    }
    return "";
}

void NonlinearTerm::add_derivative(const Eigen::VectorXd& x, Eigen::MatrixXd& matrix) {
    visit_derivative(x, [&](std::span<const std::int32_t> unknowns, std::span<const double> values) {
        const std::size_t n = unknowns.size();
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < n; ++j) {
                if (unknowns[i] >= 0 && unknowns[j] >= 0) {
                    matrix(unknowns[i], unknowns[j]) += values[i * n + j];
                }
            }
        }
    });
}

/// S x + F(x) - s.
void Newton::Residual::balance(const Eigen::VectorXd& s) {
    value = linear + nonlinear - s;
    norm = value.norm();
    linear_norm = linear.norm();
    nonlinear_norm = nonlinear.norm();
    const double scale = linear_norm + nonlinear_norm + s.norm();
    relative = scale > 0 ? norm / scale : norm;
}

Newton::Residual Newton::residual(Eigen::VectorXd linear, bool by_product, const Eigen::VectorXd& s,
                                  NonlinearTerm& F, const Eigen::VectorXd& x) {
    Residual result;
    result.linear = std::move(linear);
    result.by_product = by_product;
    F.evaluate(x, result.nonlinear);
    result.balance(s);
    return result;
}

bool Newton::factor(const Eigen::MatrixXd& S, NonlinearTerm& F, const Eigen::VectorXd& x) {
    derivative_ = S;
    F.add_derivative(x, derivative_);
    return factor_derivative(S);
}

/// A pivot u_kk = t_kk - sum l_kj u_jk is known to some epsilon (|L| |U|)_kk, the sum of its terms'
/// magnitudes (N. J. Higham, Accuracy and Stability of Numerical Algorithms, 9.3): below that a matrix as
/// near as rounding is singular. Other than the largest entry of its row, which for a slipping point is mu
/// c_n beside the body's stiffness against slip, this takes rows and columns in any units.
bool Newton::factor_derivative(const Eigen::MatrixXd& S) {
    of_contact_ = (derivative_ - S).sparseView();
    factors_.compute(derivative_);
    ++factorisations_;
    age_ = {};
    const Eigen::MatrixXd& lu = factors_.matrixLU();
    has_factors_ = true;
    for (Eigen::Index k = 0; k < lu.rows() && has_factors_; ++k) {
        const double pivot = std::abs(lu(k, k));
        const double terms = pivot + lu.row(k).head(k).cwiseAbs().dot(lu.col(k).head(k).cwiseAbs());
        has_factors_ = pivot > smallest_pivot * terms;
    }
    return has_factors_;
}

std::optional<KeptDerivative> Newton::kept_derivative(const Eigen::MatrixXd& S) const {
    if (!has_factors_) {
        return std::nullopt;
    }
    KeptDerivative kept{.unknowns = S.rows(), .age = age_};
    for (Eigen::Index i = 0; i < S.size(); ++i) {
        if (const double value = derivative_.data()[i]; value != S.data()[i]) {
            kept.entries.push_back(i);
            kept.values.push_back(value);
        }
    }
    return kept;
}

void Newton::take_up(const Eigen::MatrixXd& S, const KeptDerivative& kept) {
    if (kept.unknowns != S.rows() || S.size() == 0) {
        return;
    }
    derivative_ = S;
    for (std::size_t i = 0; i < kept.entries.size(); ++i) {
        derivative_.data()[kept.entries[i]] = kept.values[i];
    }
    factor_derivative(S);
    age_ = kept.age;
}

std::optional<double> Newton::condition(const Eigen::VectorXd& x) const {
    if (!has_factors_) {
        return std::nullopt;
    }
    return skeel_condition(
        [&](const Eigen::VectorXd& v) -> Eigen::VectorXd { return factors_.solve(v); },
        [&](const Eigen::VectorXd& v) -> Eigen::VectorXd { return factors_.transpose().solve(v); },
        derivative_.cwiseAbs() * x.cwiseAbs(), x);
}

bool Newton::is_round_off(const Eigen::VectorXd& x, NonlinearTerm& F, const Residual& current) const {
    if (!may_be_round_off(current.relative, current.value.lpNorm<1>(), current.nonlinear.lpNorm<1>(),
                          options_.tolerance)) {
        return false;
    }
    return current.norm <= round_off(x, F);
}

double Newton::round_off(const Eigen::VectorXd& x, NonlinearTerm& F) const {
    if (derivative_.size() == 0) {
        return 0;  // no iteration was allowed yet: nothing is known of T
    }
    Eigen::VectorXd noise = derivative_.cwiseAbs() * x.cwiseAbs();
    F.add_sensitivity(x, noise);
    return std::numeric_limits<double>::epsilon() * noise.norm();
}

void Newton::polish(const Eigen::MatrixXd& S, const Eigen::VectorXd& s, NonlinearTerm& F, Eigen::VectorXd& x,
                    Residual& current) {
    if (!has_factors_ || current.norm == 0) {
        return;
    }
    Eigen::VectorXd candidate = x - factors_.solve(current.value);
    Residual next = residual(S * candidate, true, s, F, candidate);
    if (current.by_product ? next.norm < current.norm : next.relative <= options_.tolerance) {
        x = std::move(candidate);
        current = std::move(next);
    }
}

/// Factors that are kept pay until what they cost beyond the iterations of the first solve with them is what
/// new ones cost; the solution just found is where those serve best.
void Newton::weigh_factors(const Eigen::MatrixXd& S, NonlinearTerm& F, const Eigen::VectorXd& x,
                           int iterations) {
    if (age_.first_iterations < 0) {
        age_.first_iterations = iterations;
    }
    age_.more_iterations += std::max(0, iterations - age_.first_iterations);
    if (age_.more_iterations > iterations_per_unknown * static_cast<double>(x.size())) {
        factor(S, F, x);
    }
}

NewtonResult Newton::solve(const Eigen::MatrixXd& S, const Eigen::VectorXd& s, NonlinearTerm& F,
                           Eigen::VectorXd& x) {
    const int factored = factorisations_;
    const NewtonResult result = iterate(S, s, F, x);
    if (result.end != NewtonEnd::converged) {
        has_factors_ = false;  // so that a retry goes the same way whatever was tried before
    } else if (has_factors_ && factorisations_ == factored) {
        weigh_factors(S, F, x, result.iterations);
    }
    return result;
}

NewtonUpdate Newton::update(const Residual& current) const {
    NewtonUpdate update{-factors_.solve(current.value), -current.value};
    update.linear -= of_contact_ * update.step;
    return update;
}

/// Whether, at this rate, the kept factors reach the tolerance sooner than new ones.
bool Newton::worth_keeping(double rate, const Residual& next, int iteration) const {
    if (!(rate <= worst_rate)) {
        return false;
    }
    const double left = std::log(options_.tolerance / next.relative) / std::log(rate);
    return rate <= good_rate || (left <= iterations_per_unknown * static_cast<double>(next.value.size()) &&
                                 iteration + left <= options_.max_iterations / 2.0);
}

NewtonResult Newton::iterate(const Eigen::MatrixXd& S, const Eigen::VectorXd& s, NonlinearTerm& F,
                             Eigen::VectorXd& x) {
    Residual current = residual(S * x, true, s, F, x);
    const auto renew = [&] {
        if (!current.by_product) {
            current.linear.noalias() = S * x;
            current.by_product = true;
            current.balance(s);
        }
    };
    CycleDetector cycle;
    Secants secants;
    for (int iteration = 0;; ++iteration) {
        if (current.relative <= options_.tolerance) {
            const double hoped = current.norm;
            polish(S, s, F, x, current);
            if (current.norm > hoped) {  // sums of changes were all that it promised
                polish(S, s, F, x, current);
            }
        }
        if (current.relative <= options_.tolerance || iteration == options_.max_iterations) {
            renew();
        }
        if (!std::isfinite(current.norm)) {
            return {NewtonEnd::not_finite, iteration, current.relative};
        }
        if (current.relative <= options_.tolerance) {
            return {NewtonEnd::converged, iteration, current.relative};
        }
        const auto stalled = [&](NewtonEnd end) -> NewtonResult {
            renew();
            if (is_round_off(x, F, current)) {
                return {NewtonEnd::converged, iteration, current.relative, true};
            }
            return {end, iteration, current.relative, false,
                    current.relative * round_off(x, F) / current.norm};
        };
        if (iteration == options_.max_iterations) {
            return stalled(NewtonEnd::too_many_iterations);
        }
        if (cycle.returns({current.norm, current.linear_norm, current.nonlinear_norm})) {
            return stalled(NewtonEnd::cycling);
        }
        if (has_factors_) {
            NewtonUpdate taken = secants.improved(update(current));
            Eigen::VectorXd candidate = x + taken.step;
            Residual next = residual(current.linear + taken.linear, false, s, F, candidate);
            if (worth_keeping(next.norm / current.norm, next, iteration)) {
                secants.take(std::move(taken));
                x = std::move(candidate);
                current = std::move(next);
                continue;
            }
        }
        renew();
        secants.forget();
        if (!factor(S, F, x)) {
            return {NewtonEnd::singular, iteration, current.relative};
        }
        NewtonUpdate newton = update(current);
        const Eigen::VectorXd& direction = newton.step;
        Eigen::VectorXd candidate;
        Residual next;
        double taken = 0;
        const auto attempt = [&](double length) -> LineResidual {
            taken = length;
            candidate = x + length * direction;
            next = residual(S * candidate, true, s, F, candidate);
            return {next.norm, direction.dot(next.value)};
        };
        const LineResidual start{current.norm, direction.dot(current.value)};
        if (!line_search(
                start, [&] { return is_round_off(x, F, current); }, attempt)) {
            return stalled(NewtonEnd::line_search_failed);
        }
        if (taken == 1) {
            secants.take(std::move(newton));
        }
        x = std::move(candidate);
        current = std::move(next);
    }
}

}  // namespace thermocontact::solve
