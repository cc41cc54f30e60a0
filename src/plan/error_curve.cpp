#include "plan/error_curve.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace thermocontact::plan {
namespace {

struct Fit {
    double order;
    double difference;  ///< d
    double cosine;      ///< c
};

/// Of the runs i, i + 1 and the finest.
double cosine_at(const Ladder& ladder, std::size_t component, std::size_t i) {
    const double first = ladder.steps[i][component], both = ladder.from_the_finest[i][component];
    const double later = ladder.from_the_finest[i + 1][component];
    const double product = 2 * first * later;
    const double excess = both * both - first * first - later * later;
    return product > 0 ? std::min(std::abs(excess / product), 1.0) : 1.0;
}

double cosine_of(const Ladder& ladder, std::size_t component) {
    const std::size_t count = ladder.steps.size();
    double largest = 0;
    for (std::size_t i = count - std::min<std::size_t>(count, 3); i + 1 < count; ++i) {
        largest = std::max(largest, cosine_at(ladder, component, i));
    }
    return largest;
}

/// e, where E is so many times that.
double error_left(double difference, double ratio, double cosine) {
    const double excess = ratio * ratio - 1;
    return difference * (cosine + std::sqrt(cosine * cosine + excess)) / excess;
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
}

/// Of one component.
Fit fit(const Ladder& ladder, std::size_t component, double lowest, double highest) {
    const std::size_t count = ladder.steps.size();
    const auto difference = [&](std::size_t i) { return ladder.steps[i][component]; };
    const double last = difference(count - 1);
    if (count < 2 || last <= 0) {
        return {last <= 0 ? highest : highest / 2, last, 1};
    }
    std::vector<double> slopes;
    for (std::size_t i = count - std::min(count, slopes_looked_at + 1); i + 1 < count; ++i) {
        slopes.push_back(difference(i) > 0 ? std::log(difference(i) / difference(i + 1)) /
                                                 std::log(ladder.knobs[i] / ladder.knobs[i + 1])
                                           : lowest_order);
    }
    const double order = std::clamp(median(std::move(slopes)), lowest, highest);
    const double expected =
        difference(count - 2) * std::pow(ladder.knobs[count - 1] / ladder.knobs[count - 2], order);
    const double taken = expected > last ? std::sqrt(expected * last) : last;
    return {order, taken, cosine_of(ladder, component)};
}

}  // namespace

double error_beside(double finer, double difference, double cosine) {
    return std::sqrt(finer * finer + difference * difference + 2 * cosine * finer * difference);
}

double difference_between(double coarser, double finer, double cosine) {
    const double more = std::max(0.0, coarser * coarser - finer * finer);
    return std::sqrt(cosine * cosine * finer * finer + more) - cosine * finer;
}

ErrorCurve::ErrorCurve(std::size_t components)
    : orders_(components, 0.0), cosines_(components, 1.0), factors_(components, 0.0) {
    curves_.assign(components, LogCurve({1.0}, {0.0}, 0.0));
}

ErrorCurve::ErrorCurve(const Ladder& ladder, const std::vector<double>& highest_orders,
                       const std::vector<double>& lowest_orders)
    : factors_(highest_orders.size(), 1.0), coarsest_(ladder.knobs.front()), finest_(ladder.knobs.back()) {
    const std::size_t last = ladder.steps.size() - 1;
    for (std::size_t c = 0; c < highest_orders.size(); ++c) {
        const double lowest = lowest_orders.empty() ? lowest_order : std::max(lowest_order, lowest_orders[c]);
        const auto [order, difference, cosine] = fit(ladder, c, lowest, highest_orders[c]);
        const double ratio = ladder.knobs[last] / ladder.knobs[last + 1];
        const double size = ladder.sizes[c] > 0 ? ladder.sizes[c] : 1.0;
        const double left = error_left(difference, std::pow(ratio, order), cosine);
        std::vector<double> errors;
        for (const std::vector<double>& apart : ladder.from_the_finest) {
            errors.push_back(error_beside(left, apart[c], cosine) / size);
        }
        errors.push_back(left / size);
        for (std::size_t i = 0; i < ladder.from_reference.size(); ++i) {
            errors[i] = error_beside(ladder.left_in_reference[c], ladder.from_reference[i][c], cosine) / size;
        }
        curves_.emplace_back(ladder.knobs, errors, order);
        orders_.push_back(order);
        cosines_.push_back(cosine);
    }
}

std::vector<double> ErrorCurve::at(double knob) const {
    std::vector<double> result;
    for (std::size_t c = 0; c < curves_.size(); ++c) {
        result.push_back(factors_[c] * curves_[c].at(knob));
    }
    return result;
}

std::vector<double> ErrorCurve::between(double coarser, double finer) const {
    const std::vector<double> large = at(coarser), small = at(finer);
    std::vector<double> result;
    for (std::size_t c = 0; c < cosines_.size(); ++c) {
        result.push_back(difference_between(large[c], small[c], cosines_[c]));
    }
    return result;
}

double ErrorCurve::largest_at(double knob) const {
    const std::vector<double> errors = at(knob);
    return errors.empty() ? 0.0 : *std::ranges::max_element(errors);
}

void ErrorCurve::correct(const std::vector<double>& factors) {
    for (std::size_t c = 0; c < factors_.size(); ++c) {
        factors_[c] *= factors[c];
    }
}

}  // namespace thermocontact::plan
