#include "march/step_error.h"

#include <cmath>

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

StepError step_error(const StepRule& rule, double curvature_lag, const std::vector<double>& y,
                     const std::vector<double>& y_new, const std::vector<double>& q,
                     const std::vector<double>& curvature) {
    StepError result;
    const double k = rule.step;
    const bool second = rule.order == 2 && curvature_lag > 0;
    const double factor = second ? 2.0 / 9 * k * k * k / (centre(rule) + curvature_lag) : k * k / 2;
    for (std::size_t i = 0; i < y.size(); ++i) {
        result.size = std::max({result.size, std::abs(y[i]), std::abs(y_new[i])});
        if (rule.lag >= 0) {
            const double bend = second_derivative(rule, y[i], y_new[i], q[i]);
            result.error = std::max(result.error, factor * std::abs(second ? bend - curvature[i] : bend));
        }
    }
    return result;
}

void renew_rates(const Scheme& scheme, const StepRule& rule, const std::vector<double>& y,
                 const std::vector<double>& y_new, std::vector<double>& q, std::vector<double>& curvature) {
    if (scheme.carries_curvature() && rule.lag >= 0) {
        curvature.resize(y.size());
        for (std::size_t i = 0; i < y.size(); ++i) {
            curvature[i] = second_derivative(rule, y[i], y_new[i], q[i]);
        }
    }
    if (scheme.carries_rates()) {
        renew_rate(rule, y, y_new, q);
    }
}

double curvature_lag(const StepRule& rule) {
    return rule.step - centre(rule);
}

}  // namespace thermocontact::march
