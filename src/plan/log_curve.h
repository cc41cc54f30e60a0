/// A positive quantity measured at some places, straight between them on logarithmic scales.
#pragma once

#include <vector>

namespace thermocontact::plan {

class LogCurve {
  public:
    LogCurve() = default;

    /// `values` at `places` (positive, in rising or falling order; at least one). Beyond the last place the
    /// curve goes on as value ~ place^slope_beyond, before the first as between the first two.
    LogCurve(std::vector<double> places, std::vector<double> values, double slope_beyond);

    double at(double place) const;

    /// Between the last two places: d log value / d log place; `fallback` where there is one only, or a value
    /// is 0.
    static double last_slope(const std::vector<double>& places, const std::vector<double>& values,
                             double fallback);

  private:
    std::vector<double> places_, values_;
    double slope_beyond_ = 0;
};

}  // namespace thermocontact::plan
