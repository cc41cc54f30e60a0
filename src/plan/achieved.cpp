#include "plan/achieved.h"

#include <algorithm>

#include "number.h"
#include "plan/near_choice.h"

namespace thermocontact::plan {
namespace {

/// As the run and the pilot that it is compared with have it.
void offer_instead(Achieved& result, const Plan& plan, const scene::Scene& scene) {
    const Discretisation& own = plan.chosen->discretisation;
    Models models = near_only(plan.models);
    std::vector<double> factors;
    for (std::size_t c = 0; c < result.errors.size(); ++c) {
        const double predicted = combined(plan.chosen->space[c], plan.chosen->time[c], models.sum);
        factors.push_back(predicted > 0 ? result.errors[c] / predicted : 1.0);
    }
    space_of(models, own).error.correct(factors);
    time_of(models, own).error.correct(factors);
    constexpr double any_time = 1e12;
    result.instead = cheapest(models, aim_of_accuracy * *plan.request.accuracy, {any_time, most_unknowns()});
    if (result.instead) {
        result.settings = settings(scene, result.instead->discretisation);
    }
    result.models = std::move(models);
}

}  // namespace

std::optional<Achieved> achieved(const Plan& plan, Bench& bench, const Pilot& run) {
    Comparison comparison(bench.scene(), plan.request.of);
    const Discretisation own = plan.chosen->discretisation;
    const Discretisation half = coarser_in_time(coarser_in_space(own));
    const bool refinable = plan.models.refinable;
    const bool halved = time_knob(half) != time_knob(own) && (half.scale != own.scale || !refinable);
    const Pilot* other = bench.run(halved ? half : finer(own, refinable));
    if (other == nullptr) {
        return std::nullopt;
    }
    const Pilot &coarse = halved ? *other : run, &fine = halved ? run : *other;
    const std::vector<double> apart = comparison.difference(coarse, fine), size = comparison.size(fine);
    const std::vector<double> foreseen = difference(plan.models, coarse.discretisation, fine.discretisation);
    Achieved result{{}, 0, halved};
    for (std::size_t c = 0; c < size.size(); ++c) {
        const double predicted = combined(plan.chosen->space[c], plan.chosen->time[c], plan.models.sum);
        const double relative = size[c] > 0 ? apart[c] / size[c] : 0.0;
        result.errors.push_back(foreseen[c] > 0 ? relative * predicted / foreseen[c] : predicted);
    }
    result.error = *std::ranges::max_element(result.errors);
    if (plan.request.accuracy && result.error > *plan.request.accuracy) {
        offer_instead(result, plan, bench.scene());
    }
    return result;
}

std::optional<Plan> after_miss(const Plan& plan, const Achieved& achieved, double seconds) {
    if (!achieved.instead || achieved.instead->seconds > seconds) {
        return std::nullopt;
    }
    Plan next = plan;
    next.models = achieved.models;
    next.chosen = achieved.instead;
    next.settings = achieved.settings;
    next.cheaper = next.better = std::nullopt;
    next.remarks = {"a run before this one erred by " + short_text(achieved.error) + ", as estimated"};
    return next;
}

}  // namespace thermocontact::plan
