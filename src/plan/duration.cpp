#include "plan/duration.h"

#include <charconv>
#include <cmath>
#include <map>

#include "number.h"

namespace thermocontact::plan {

namespace {

constexpr double minute = 60, hour = 3600;

}  // namespace

std::optional<double> parse_duration(const std::string& text) {
    static const std::map<std::string, double> units = {
        {"", 1}, {"s", 1}, {"m", minute}, {"min", minute}, {"h", hour}};
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const auto unit = units.find(std::string(end, text.data() + text.size()));
    if (error != std::errc{} || unit == units.end()) {
        return std::nullopt;
    }
    const double seconds = value * unit->second;
    return std::isfinite(seconds) && seconds > 0 ? std::optional(seconds) : std::nullopt;
}

std::string about(double value) {
    if (!std::isfinite(value) || value == 0) {
        return short_text(value);
    }
    const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 1);
    return short_text(std::round(value / unit) * unit);
}

std::string duration_text(double seconds) {
    if (seconds >= 2 * hour) {
        return about(seconds / hour) + " h";
    }
    return seconds >= 2 * minute ? about(seconds / minute) + " min" : about(seconds) + " s";
}

}  // namespace thermocontact::plan
