#include "march/step_rule.h"

#include <algorithm>

namespace thermocontact::march {

Scheme::Scheme(const scene::TimeSpec& time)
    : alpha_(time.spectral_radius ? 1 / (1 + *time.spectral_radius) : 1.0),
      second_order_(time.spectral_radius.has_value()),
      estimates_(time.tolerance.has_value()) {}

StepRule Scheme::rule(double begin, double end, double step, double last_step) const {
    const double late = alpha_ - 0.5, lag = last_step == 0 ? -1.0 : late * last_step;
    if (!second_order_ || last_step == 0) {
        return {begin, end, step, 1.0, step, lag, 1.0, 1};
    }
    const double tau = alpha_ * step * ((step / 2 + lag) / (alpha_ * step + lag));
    return {begin, end, step, alpha_, tau, lag, (step - late * step + lag) / (step / 2 + lag), 2};
}

void extrapolate(double seconds, const std::vector<double>& y, const std::vector<double>& q,
                 std::ptrdiff_t begin, std::ptrdiff_t end, std::vector<double>& result) {
    if (seconds == 0 || q.empty()) {
        std::copy(y.begin() + begin, y.begin() + end, result.begin() + begin);
        return;
    }
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
        result[i] = y[i] + seconds * q[i];
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
