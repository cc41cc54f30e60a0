#include "plan/planner.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plan/duration.h"
#include "plan/near_choice.h"
#include "plan/report.h"
#include "plan/space_study.h"
#include "plan/time_study.h"

namespace thermocontact::plan {
namespace {

constexpr double share_near_choice = 0.5;    ///< of the chosen run's time, for the pilots near it
constexpr double longest_near_choice = 120;  ///< s, for the same
constexpr double margin_of_time = 0.8;       ///< of the budget: predictions of time err, too
constexpr int approaches = 8;
constexpr double nearly_met = 2;       ///< times what was asked
constexpr double worse_but_known = 2;  ///< a budget's error that is rather taken than one that is hoped for
constexpr double offers_apart = 3.1622776601683795;    ///< half a digit
constexpr double shares_left[] = {1.0 / 4, 1.0 / 32};  ///< of the accuracy, in the pilots; the second where
                                                       ///< the first promise nothing

/// Of memory and time without end.
constexpr Limits no_limits{1e12, 1e15};

/// The cheapest that errs by `aim` at most. More steps than that needs may take less time, if they are
/// factored more rarely: then the most accurate.
std::optional<Option> cheapest_of_all(const Models& models, double aim, const Limits& limits) {
    if (auto found = cheapest(models, aim, limits)) {
        return found;
    }
    auto best = most_accurate(models, limits);
    return best && best->error <= aim ? best : std::nullopt;
}

}  // namespace

Planner::Planner(Bench& bench, const Request& request, bool budget_counts_pilots)
    : study_(begin_study(bench, request, shares_left[0])), counts_pilots_(budget_counts_pilots) {}

Limits Planner::limits() const {
    const Request& request = study_.request;
    const double spent = counts_pilots_ ? study_.bench->seconds() : 0.0;
    return {request.budget ? margin_of_time * (*request.budget - spent) : longest_run, most_unknowns()};
}

std::optional<Option> Planner::choose(const Models& models, double accuracy_factor) const {
    if (study_.request.accuracy) {
        const double asked = accuracy_factor * *study_.request.accuracy;
        const auto aimed = cheapest(models, aim_of_accuracy * asked, limits());
        return aimed ? aimed : cheapest_of_all(models, least_aim * asked, limits());
    }
    Limits affordable = limits();
    affordable.seconds /= accuracy_factor;  // of a budget, the offers are of other times
    return most_accurate(models, affordable);
}

/// For pilots near a choice that takes so long.
double Planner::seconds_near(const Option& option) const {
    const double of_run = seconds_without_output(study_.models, option.discretisation);
    return std::min(share_near_choice * of_run, longest_near_choice);
}

/// Where nothing is foreseen to meet the accuracy: what misses it by no more than models far from it err by.
std::optional<Option> Planner::nearly() const {
    const std::optional<Option> best =
        study_.request.accuracy ? most_accurate(study_.models, limits()) : std::nullopt;
    return best && best->error <= nearly_met * *study_.request.accuracy ? best : std::nullopt;
}

/// The choice is of many candidates, and of those not looked at closely the most hopeful: it is looked at,
/// chosen again, and so on. Where time is up, only what was looked at counts,
/// in a budget as long as that is not far worse.
void Planner::approach() {
    const double begin = study_.bench->seconds();
    for (int i = 0; i < approaches; ++i) {
        std::optional<Option> option = choose(study_.models, 1);
        if (!option) {
            option = nearly();
        }
        if (!option || is_near(study_.models, option->discretisation)) {
            return;
        }
        // in all they may take a share of what is the best of those that are known
        const std::optional<Option> known = choose(near_only(study_.models), 1);
        const double own = seconds_near(*option);
        const double of_shapes = longest_for_shapes - study_.seconds_for_shapes;
        const double spent = study_.bench->seconds() - begin - of_shapes;
        const double left = std::max(own, known ? seconds_near(*known) : 0) - spent;
        if (!learn_near(study_, *option, std::min({own, left, seconds_for_pilots(study_)}))) {
            break;
        }
    }
    const Models near = near_only(study_.models);
    const std::optional<Option> known = choose(near, 1), hoped = choose(study_.models, 1);
    if (study_.request.accuracy || (known && hoped && known->error <= worse_but_known * hoped->error)) {
        study_.models = near;
    }
}

void Planner::refuse(Plan& plan) const {
    plan.best = most_accurate(study_.models, limits());
    if (!study_.request.accuracy || !plan.best) {
        plan.refusal = "the pilots leave no time for a run; a larger budget is needed";
        return;
    }
    const Limits bounds = limits();
    plan.refusal = "an error of " + about(*study_.request.accuracy) + " cannot be promised: with " +
                   duration_text(bounds.seconds) + " and memory for " + about(bounds.unknowns) +
                   " unknowns the error of " + largest_source(study_.comparison.components(), *plan.best) +
                   " is what remains";
    Models boundless = study_.models;
    boundless.memory = std::numeric_limits<double>::infinity();
    if (const std::optional<Option> any =
            cheapest(boundless, least_aim * *study_.request.accuracy, no_limits)) {
        plan.refusal +=
            "; foreseen are " + duration_text(any->seconds) + " and " + about(any->unknowns) + " unknowns";
    }
}

void Planner::choose_all(Plan& plan) const {
    plan.chosen = choose(study_.models, 1);
    if (plan.chosen) {
        plan.cheaper = choose(study_.models, offers_apart);
        plan.better = choose(study_.models, 1 / offers_apart);
    } else {
        refuse(plan);
    }
    if (const std::optional<Option>& shown = plan.chosen ? plan.chosen : plan.best) {
        plan.settings = settings(study_.bench->scene(), shown->discretisation);
    }
}

void Planner::study(Plan& plan) {
    study_time(study_);
    if (study_.models.times.empty()) {
        plan.refusal = "the motions of this scene are not resolved by as many steps as pilots can take";
        return;
    }
    study_space(study_);
    approach();
    choose_all(plan);
}

Plan Planner::make() {
    Plan plan;
    for (const double share : shares_left) {
        study_ = begin_study(*study_.bench, study_.request, share);
        plan = Plan{};
        study(plan);
        // coarse pilots may see less order than there is
        if (plan.chosen || !study_.request.accuracy || study_.models.times.empty()) {
            break;
        }
    }
    plan.request = study_.request;
    plan.components = study_.comparison.components();
    plan.models = study_.models;
    plan.remarks = study_.remarks;
    if (plan.chosen && !is_near(plan.models, plan.chosen->discretisation)) {
        plan.remarks.emplace_back(
            "pilots nearly as fine as what is chosen would have taken too long: its error is extrapolated");
    }
    plan.pilots = study_.bench->runs();
    plan.pilot_seconds = study_.bench->seconds();
    return plan;
}

}  // namespace thermocontact::plan
