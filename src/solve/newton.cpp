#include "solve/newton.h"

#include <cmath>
#include <limits>

#include "solve/condition.h"
#include "solve/cycle.h"
#include "solve/line_search.h"
#include "solve/secants.h"

namespace thermocontact::solve {
namespace {

constexpr double kept_factors_rate = 0.1;  ///< the least contraction that makes old factors worth keeping
constexpr double smallest_pivot = 1e-14;   ///< of the terms that it is the sum of; below is round-off

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

Newton::Residual Newton::residual(const Eigen::MatrixXd& S, const Eigen::VectorXd& s, NonlinearTerm& F,
                                  const Eigen::VectorXd& x) {
    linear_.noalias() = S * x;
    F.evaluate(x, nonlinear_);
    Eigen::VectorXd value = linear_ + nonlinear_ - s;
    const double norm = value.norm();
    const double linear_norm = linear_.norm(), nonlinear_norm = nonlinear_.norm();
    const double scale = linear_norm + nonlinear_norm + s.norm();
    return {std::move(value), norm, scale > 0 ? norm / scale : norm, linear_norm, nonlinear_norm};
}

bool Newton::factor(const Eigen::MatrixXd& S, NonlinearTerm& F, const Eigen::VectorXd& x) {
    derivative_ = S;
    F.add_derivative(x, derivative_);
    return factor_derivative();
}

/// A pivot u_kk = t_kk - sum l_kj u_jk is known to some epsilon (|L| |U|)_kk, the sum of its terms'
/// magnitudes (N. J. Higham, Accuracy and Stability of Numerical Algorithms, 9.3): below that a matrix as
/// near as rounding is singular. Other than the largest entry of its row, which for a slipping point is mu
/// c_n beside the body's stiffness against slip, this takes rows and columns in any units.
bool Newton::factor_derivative() {
    factors_.compute(derivative_);
    ++factorisations_;
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
    KeptDerivative kept{S.rows(), {}, {}};
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
    factor_derivative();
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

bool Newton::is_round_off(const Eigen::VectorXd& x, NonlinearTerm& F, const Residual& current) {
    F.evaluate(x, nonlinear_);
    if (!may_be_round_off(current.relative, current.value.lpNorm<1>(), nonlinear_.lpNorm<1>(),
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
    Residual next = residual(S, s, F, candidate);
    if (next.norm < current.norm) {
        x = std::move(candidate);
        current = std::move(next);
    }
}

NewtonResult Newton::solve(const Eigen::MatrixXd& S, const Eigen::VectorXd& s, NonlinearTerm& F,
                           Eigen::VectorXd& x) {
    const NewtonResult result = iterate(S, s, F, x);
    if (result.end != NewtonEnd::converged) {
        has_factors_ = false;  // so that a retry goes the same way whatever was tried before
    }
    return result;
}

NewtonResult Newton::iterate(const Eigen::MatrixXd& S, const Eigen::VectorXd& s, NonlinearTerm& F,
                             Eigen::VectorXd& x) {
    Residual current = residual(S, s, F, x);
    CycleDetector cycle;
    Secants secants;
    for (int iteration = 0;; ++iteration) {
        if (!std::isfinite(current.norm)) {
            return {NewtonEnd::not_finite, iteration, current.relative};
        }
        if (current.relative <= options_.tolerance) {
            polish(S, s, F, x, current);
            return {NewtonEnd::converged, iteration, current.relative};
        }
        const auto stalled = [&](NewtonEnd end) -> NewtonResult {
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
            Eigen::VectorXd step = secants.improved(-factors_.solve(current.value));
            Eigen::VectorXd candidate = x + step;
            Residual next = residual(S, s, F, candidate);
            if (next.norm <= kept_factors_rate * current.norm) {
                secants.take(std::move(step));
                x = std::move(candidate);
                current = std::move(next);
                continue;
            }
        }
        secants.forget();
        if (!factor(S, F, x)) {
            return {NewtonEnd::singular, iteration, current.relative};
        }
        const Eigen::VectorXd direction = -factors_.solve(current.value);
        Eigen::VectorXd candidate;
        Residual next;
        double taken = 0;
        const auto attempt = [&](double length) -> LineResidual {
            taken = length;
            candidate = x + length * direction;
            next = residual(S, s, F, candidate);
            return {next.norm, direction.dot(next.value)};
        };
        const LineResidual start{current.norm, direction.dot(current.value)};
        if (!line_search(
                start, [&] { return is_round_off(x, F, current); }, attempt)) {
            return stalled(NewtonEnd::line_search_failed);
        }
        if (taken == 1) {
            secants.take(direction);
        }
        x = std::move(candidate);
        current = std::move(next);
    }
}

}  // namespace thermocontact::solve
