#include "march/step_rule.h"

namespace thermocontact::march {

Scheme::Scheme(const scene::TimeSpec& time)
    : alpha_(time.spectral_radius ? 1 / (1 + *time.spectral_radius) : 1.0),
      second_order_(time.spectral_radius.has_value()) {}

StepRule Scheme::rule(double begin, double end, double step, double last_step) const {
    if (!second_order_ || last_step == 0) {
        return {begin, end, step, 1.0, step, 1.0};
    }
    const double late = alpha_ - 0.5, lag = late * last_step;
    const double tau = alpha_ * step * ((step / 2 + lag) / (alpha_ * step + lag));
    return {begin, end, step, alpha_, tau, (step - late * step + lag) / (step / 2 + lag)};
}

void extrapolate(double seconds, const std::vector<double>& y, const std::vector<double>& q,
                 std::vector<double>& result) {
    result = y;
    for (std::size_t i = 0; i < q.size(); ++i) {
        result[i] += seconds * q[i];
    }
}

void renew_rate(const StepRule& rule, const std::vector<double>& y, const std::vector<double>& y_new,
                std::vector<double>& q) {
    q.resize(y.size(), 0.0);
    for (std::size_t i = 0; i < y.size(); ++i) {
        q[i] += rule.steering * ((y_new[i] - y[i]) / rule.step - q[i]);
    }
}

}  // namespace thermocontact::march
