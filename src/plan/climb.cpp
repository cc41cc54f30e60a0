#include "plan/climb.h"

#include <algorithm>

namespace thermocontact::plan {
namespace {

constexpr std::size_t fewest_levels = 3;  ///< for an observed order

Ladder ladder_of(const std::vector<const Pilot*>& pilots, Comparison& comparison,
                 const std::function<double(const Discretisation&)>& knob) {
    Ladder ladder;
    for (const Pilot* pilot : pilots) {
        ladder.knobs.push_back(knob(pilot->discretisation));
    }
    for (std::size_t i = 0; i + 1 < pilots.size(); ++i) {
        ladder.steps.push_back(comparison.difference(*pilots[i], *pilots[i + 1]));
        ladder.from_the_finest.push_back(comparison.difference(*pilots[i], *pilots.back()));
    }
    ladder.sizes = comparison.size(*pilots.back());
    return ladder;
}

}  // namespace

ErrorCurve error_of(const std::vector<const Pilot*>& pilots, Comparison& comparison,
                    const std::function<double(const Discretisation&)>& knob,
                    const std::vector<double>& highest_orders, const std::vector<double>& lowest_orders) {
    return {ladder_of(pilots, comparison, knob), highest_orders, lowest_orders};
}

Climbed climb(Bench& bench, Comparison& comparison, const Climb& how) {
    Climbed result;
    bool failed = false;
    double last = 0;  // s that the last one took
    for (int level = 0;; ++level) {
        const std::optional<Discretisation> next = how.level(level);
        const bool bounded = failed || result.pilots.size() >= fewest_levels;
        if (!next || (bounded && how.growth * last > how.seconds)) {
            break;
        }
        const double begin = bench.seconds();
        const Pilot* pilot = bench.run(*next);
        if (pilot == nullptr) {
            result.pilots.clear();
            failed = true;
            last = bench.seconds() - begin;
            continue;
        }
        last = pilot->costs.processor;
        result.pilots.push_back(pilot);
        if (result.pilots.size() < fewest_levels) {
            continue;
        }
        result.error = error_of(result.pilots, comparison, how.knob, how.highest_orders);
        if (result.error.largest_at(result.error.finest()) <= how.goal && pilot->damped <= most_damped) {
            break;
        }
    }
    if (result.pilots.size() < fewest_levels) {
        result.pilots.clear();
    }
    return result;
}

ErrorCurve error_against(const Climbed& climbed, const Climbed& reference, Comparison& comparison,
                         const Climb& how) {
    const Pilot& other = *reference.pilots.back();
    Ladder ladder = ladder_of(climbed.pilots, comparison, how.knob);
    ladder.sizes = comparison.size(other);
    for (const Pilot* pilot : climbed.pilots) {
        ladder.from_reference.push_back(comparison.difference(*pilot, other));
    }
    ladder.left_in_reference = reference.error.at(reference.error.finest());
    for (std::size_t c = 0; c < ladder.sizes.size(); ++c) {
        ladder.left_in_reference[c] *= ladder.sizes[c];
    }
    return {ladder, how.highest_orders};
}

}  // namespace thermocontact::plan
