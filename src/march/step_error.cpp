#include "march/step_error.h"

#include <cstddef>

namespace thermocontact::march {
namespace {

/// y'' of one unknown.
double second_derivative(const StepRule& rule, double y, double y_new, double q) {
    return ((y_new - y) / rule.step - q) / (rule.step / 2 + rule.lag);
}

/// From the begin of the step to where its y'' holds, s.
double centre(const StepRule& rule) {
    return (rule.step / 2 - rule.lag) / 2;
}

}  // namespace

double error_constant(double alpha) {
    const double late = alpha - 0.5;
    return alpha / (2 * alpha - 0.5) * (1.5 * late * late + alpha * (1 - alpha) / 2 - 1.0 / 24);
}

int estimate_order(const StepRule& rule, double curvature_lag) {
    return rule.order == 2 && curvature_lag > 0 ? 2 : 1;
}

std::vector<double> error_estimate(const StepRule& rule, double curvature_lag, const std::vector<double>& y,
                                   const std::vector<double>& y_new, const std::vector<double>& q,
                                   const std::vector<double>& curvature) {
    if (!rule.has_rate()) {
        return {};
    }
    const double k = rule.step;
    const bool third = estimate_order(rule, curvature_lag) == 2;
    const double factor =
        third ? error_constant(rule.alpha) * k * k * k / (centre(rule) + curvature_lag) : k * k / 2;
    std::vector<double> result(y.size());
    for (std::size_t i = 0; i < y.size(); ++i) {
        const double bend = second_derivative(rule, y[i], y_new[i], q[i]);
        result[i] = factor * (third ? bend - curvature[i] : bend);
    }
    return result;
}

void renew_rates(const Scheme& scheme, const StepRule& rule, const std::vector<double>& y,
                 const std::vector<double>& y_new, std::vector<double>& q, std::vector<double>& curvature) {
    if (curvature_lag(scheme, rule) > 0) {
        curvature.resize(y.size());
        for (std::size_t i = 0; i < y.size(); ++i) {
            curvature[i] = second_derivative(rule, y[i], y_new[i], q[i]);
        }
    }
    if (scheme.carries_rates()) {
        renew_rate(rule, y, y_new, q);
    }
}

double curvature_lag(const Scheme& scheme, const StepRule& rule) {
    return scheme.carries_curvature() && rule.has_rate() ? rule.step - centre(rule) : 0.0;
}

}  // namespace thermocontact::march
