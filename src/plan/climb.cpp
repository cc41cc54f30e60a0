#include "plan/climb.h"

#include <algorithm>

namespace thermocontact::plan {
namespace {

constexpr std::size_t fewest_levels = 3;  ///< for an observed order

Ladder ladder_of(const std::vector<const Pilot*>& pilots, Comparison& comparison, const Climb& how) {
    Ladder ladder;
    for (const Pilot* pilot : pilots) {
        ladder.knobs.push_back(how.knob(pilot->discretisation));
    }
    for (std::size_t i = 0; i + 1 < pilots.size(); ++i) {
        ladder.steps.push_back(comparison.difference(*pilots[i], *pilots[i + 1]));
        ladder.from_the_finest.push_back(comparison.difference(*pilots[i], *pilots.back()));
    }
    ladder.sizes = comparison.size(*pilots.back());
    return ladder;
}

}  // namespace

Climbed climb(Bench& bench, Comparison& comparison, const Climb& how) {
    Climbed result;
    for (int level = 0;; ++level) {
        const std::optional<Discretisation> next = how.level(level);
        const bool enough = result.pilots.size() >= fewest_levels;
        if (!next || (enough && how.growth * result.pilots.back()->costs.processor > how.seconds)) {
            break;
        }
        const Pilot* pilot = bench.run(*next);
        if (pilot == nullptr) {
            result.pilots.clear();
            continue;
        }
        result.pilots.push_back(pilot);
        if (result.pilots.size() < fewest_levels) {
            continue;
        }
        result.error = {ladder_of(result.pilots, comparison, how), how.highest_orders};
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
    Ladder ladder = ladder_of(climbed.pilots, comparison, how);
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
