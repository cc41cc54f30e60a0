#include "plan/log_curve.h"

#include <cmath>
#include <utility>

namespace thermocontact::plan {

LogCurve::LogCurve(std::vector<double> places, std::vector<double> values, double slope_beyond)
    : places_(std::move(places)), values_(std::move(values)), slope_beyond_(slope_beyond) {}

double LogCurve::at(double place) const {
    const std::size_t last = places_.size() - 1;
    const bool rising = last > 0 && places_[last] > places_[0];
    const auto beyond = [&](std::size_t i) { return rising ? place >= places_[i] : place <= places_[i]; };
    if (last == 0 || beyond(last)) {
        return values_[last] * std::pow(place / places_[last], slope_beyond_);
    }
    std::size_t i = 0;
    while (i + 1 < last && beyond(i + 1)) {
        ++i;
    }
    const double share = std::log(place / places_[i]) / std::log(places_[i + 1] / places_[i]);
    if (values_[i] <= 0 || values_[i + 1] <= 0) {
        return values_[i] + share * (values_[i + 1] - values_[i]);
    }
    return values_[i] * std::pow(values_[i + 1] / values_[i], share);
}

double LogCurve::last_slope(const std::vector<double>& places, const std::vector<double>& values,
                            double fallback) {
    const std::size_t count = places.size();
    if (count < 2 || values[count - 1] <= 0 || values[count - 2] <= 0) {
        return fallback;
    }
    return std::log(values[count - 1] / values[count - 2]) / std::log(places[count - 1] / places[count - 2]);
}

}  // namespace thermocontact::plan
