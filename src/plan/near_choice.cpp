#include "plan/near_choice.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "plan/climb.h"
#include "plan/models.h"
#include "plan/orders.h"
#include "plan/proportions.h"
#include "plan/shapes_near.h"

namespace thermocontact::plan {
namespace {

constexpr double share_in_space = 0.7;  ///< of the time: there the pilots are as large as the run
constexpr double reach = 1.5;           ///< of the finest pilot's cells or steps, that a choice may have
constexpr double most_correction = 4;
constexpr double share_of_shapes = 0.5;
constexpr double too_hopeful = 1.5;  ///< a price so many times that foreseen: other meshes are looked for
constexpr std::size_t fewest_rungs = 3;
constexpr double most_apart_in_space = 4, most_apart_in_time = 1.25 * tolerance_ratio;  ///< knobs of rungs
constexpr int large_scale = 32, halved_scale = 8;
/// In time differences go up and down, as contact opens and closes in this step or in that: an order is to be
/// the median of three.
constexpr std::size_t most_in_space = 4, most_in_time = 5;
constexpr int fewest_scales[] = {4, 2};  ///< of a mesh on which steps are compared, by degree

using Change = std::function<Discretisation(const Discretisation&)>;
using Rungs = std::vector<Discretisation>;  ///< coarse to fine

/// In one direction, space or time.
struct Direction {
    Change coarser, finer;
    std::function<double(const Discretisation&)> knob;
    Change cheaper;  ///< in the other direction, in which all rungs are alike
    std::size_t most_rungs;
    double most_apart;  ///< the knobs of two rungs
};

double space_knob(const Discretisation& choice) {
    return 1.0 / choice.scale;
}

/// As many as there are, and not so far apart that nothing is told of an order.
Rungs rungs_below(const Discretisation& finest, const Direction& direction) {
    Rungs rungs{finest};
    while (rungs.size() < direction.most_rungs) {
        const Discretisation next = direction.coarser(rungs.front());
        const double apart = direction.knob(next) / direction.knob(rungs.front());
        if (apart <= 1 || apart > direction.most_apart) {
            break;
        }
        rungs.insert(rungs.begin(), next);
    }
    return rungs;
}

/// The ladders that may be climbed, the one that tells most first.
std::vector<Rungs> ladders(const Discretisation& choice, const Direction& direction) {
    const Discretisation twice = direction.finer(choice);
    std::vector<Rungs> result;
    for (const Discretisation& finest : {direction.finer(twice), twice, choice, direction.coarser(choice)}) {
        const bool needed = direction.knob(finest) >= direction.knob(twice) ||
                            rungs_below(twice, direction).size() < fewest_rungs;
        for (const Discretisation& at :
             {direction.cheaper(finest), direction.cheaper(direction.cheaper(finest))}) {
            Rungs rungs = rungs_below(at, direction);
            if (needed && rungs.size() >= fewest_rungs) {
                result.push_back(std::move(rungs));
            }
        }
    }
    return result;
}

/// Infinite where memory does not hold one.
double seconds_of(const Study& study, const Rungs& rungs) {
    double seconds = 0;
    for (const Discretisation& choice : rungs) {
        if (!study.bench->fits(choice)) {
            return std::numeric_limits<double>::infinity();
        }
        seconds += study.bench->has(choice) ? 0 : seconds_without_output(study.models, choice);
    }
    return seconds;
}

std::optional<Rungs> affordable(const Study& study, const std::vector<Rungs>& candidates, double seconds) {
    for (const Rungs& rungs : candidates) {
        if (seconds_of(study, rungs) <= seconds) {
            return rungs;
        }
    }
    return std::nullopt;
}

/// Empty where one of them fails.
std::vector<const Pilot*> run(Bench& bench, const Rungs& rungs) {
    std::vector<const Pilot*> pilots;
    for (const Discretisation& choice : rungs) {
        const Pilot* pilot = bench.run(choice);
        if (pilot == nullptr) {
            return {};
        }
        pilots.push_back(pilot);
    }
    return pilots;
}

/// [components]: the difference found of that foreseen.
std::vector<double> ratios(Study& study, const Pilot& coarse, const Pilot& fine) {
    const std::vector<double> found = study.comparison.difference(coarse, fine);
    const std::vector<double> size = study.comparison.size(fine);
    const std::vector<double> foreseen = difference(study.models, coarse.discretisation, fine.discretisation);
    std::vector<double> result;
    for (std::size_t c = 0; c < found.size(); ++c) {
        const double expected = foreseen[c] * size[c];
        result.push_back(expected > 0 && found[c] > 0
                             ? std::clamp(found[c] / expected, 1 / most_correction, most_correction)
                             : 1.0);
    }
    return result;
}

/// Large meshes with a few cells more, as can be halved thrice: prime factors are no rungs.
Discretisation halving(Discretisation choice) {
    if (choice.scale >= large_scale) {
        choice.scale = (choice.scale + halved_scale - 1) / halved_scale * halved_scale;
    }
    return choice;
}

Direction in_space() {
    return {coarser_in_space, finer_in_space, space_knob,
            coarser_in_time,  most_in_space,  most_apart_in_space};
}

/// Steps are not compared on the very coarsest meshes, whose contact opens and closes at a few points.
Direction in_time() {
    const Change cheaper = [](Discretisation choice) {
        const int fewest = fewest_scales[choice.degree - 1];
        choice.scale = choice.scale <= fewest ? choice.scale : std::max(fewest, coarser(choice.scale));
        return choice;
    };
    return {coarser_in_time, finer_in_time, time_knob, cheaper, most_in_time, most_apart_in_time};
}

/// Meshes are compared in equal steps, in which all err alike in time: adaptive ones are others on each mesh.
Discretisation in_equal_steps(const Models& models, Discretisation choice) {
    const Stepping equal{choice.stepping.scheme, false};
    const bool known = std::ranges::any_of(
        models.times, [&](const TimeModel& time) { return describe(time.stepping) == describe(equal); });
    if (choice.stepping.adaptive && known) {
        constexpr int unit = 4 * instants;  // can be halved twice
        const double attempts = time_of(models, choice).attempts.at(time_knob(choice));
        choice.stepping = equal;
        choice.steps = unit * static_cast<int>(std::ceil(attempts / unit));
        choice.tolerance = 0;
    }
    return choice;
}

/// Where contact ends errors fall as stairs do, and a short ladder may stand on one: its order is not taken
/// to be less than half of the one that pilots far away show.
std::vector<double> lowest_of(const ErrorCurve& far) {
    std::vector<double> result = far.orders();
    for (double& order : result) {
        order /= 2;
    }
    return result;
}

void learn_space(Study& study, const std::vector<const Pilot*>& pilots) {
    const Discretisation& finest = pilots.back()->discretisation;
    SpaceModel& model = space_of(study.models, finest);
    const std::vector<double> highest = highest_in_space(study.comparison.components(), finest.degree);
    model.error = error_of(pilots, study.comparison, space_knob, highest, lowest_of(model.error));
    model.near = space_knob(finest);
}

/// What a run takes longer than was foreseen lets more time be spent on meshes that need less: half of what
/// it takes on the option's, as long as there is time for such at all. Of other gradings, which coarse pilots
/// have shown, no better is to be expected.
void learn_shapes(Study& study, const Option& option, const std::vector<const Pilot*>& pilots) {
    const Bench& bench = *study.bench;
    const double price = price_of(study, {space_of(study.models, option.discretisation)});
    if (price <= too_hopeful * (study.request.accuracy ? option.seconds : option.error)) {
        return;
    }
    const double begin = bench.seconds();
    const double seconds = std::min({study.seconds_for_shapes, share_of_shapes * seconds_for_pilots(study),
                                     share_of_shapes * (study.request.accuracy ? price : option.seconds)});
    const auto left = [&] { return seconds - (bench.seconds() - begin); };
    const Pilot& finest = learn_proportions(study, pilots, left());
    learn_gradings(study, finest, left());
    study.seconds_for_shapes -= bench.seconds() - begin;
    std::erase_if(study.models.spaces,
                  [](const SpaceModel& space) { return space.near == 0 && !space.grading.empty(); });
}

/// Where the scene damps nothing, runs that do not resolve its motions agree on what is wrong: the curve,
/// which is of differences to a scheme that damps nothing either, keeps its shape.
void learn_time(Study& study, const std::vector<const Pilot*>& pilots) {
    const Discretisation& finest = pilots.back()->discretisation;
    TimeModel& model = time_of(study.models, finest);
    if (is_undamped(study.bench->scene())) {
        model.error.correct(ratios(study, *pilots.end()[-2], *pilots.back()));
    } else {
        const std::vector<double> highest = highest_in_time(study.comparison.components(), finest.stepping);
        model = time_model(finest.stepping, {pilots, error_of(pilots, study.comparison, time_knob, highest,
                                                              lowest_of(model.error))});
    }
    model.near = time_knob(finest);
}

/// Errors of schemes of second order go with the power 2/3 of the tolerance, with the power 2 of steps.
double reach_in_time(const Stepping& stepping) {
    return stepping.adaptive ? std::pow(reach, 3) : reach;
}

}  // namespace

bool learn_near(Study& study, const Option& option, double seconds) {
    Bench& bench = *study.bench;
    const int runs = bench.runs();
    const double begin = bench.seconds();
    if (study.models.refinable) {
        const auto rungs = affordable(
            study, ladders(halving(in_equal_steps(study.models, option.discretisation)), in_space()),
            share_in_space * seconds);
        if (const std::vector<const Pilot*> pilots = rungs ? run(bench, *rungs) : std::vector<const Pilot*>{};
            !pilots.empty()) {
            learn_space(study, pilots);
            learn_shapes(study, option, pilots);
        }
    }
    const double left = seconds - (bench.seconds() - begin);
    const auto rungs = affordable(study, ladders(option.discretisation, in_time()), left);
    if (const std::vector<const Pilot*> pilots = rungs ? run(bench, *rungs) : std::vector<const Pilot*>{};
        !pilots.empty()) {
        learn_time(study, pilots);
    }
    learn_costs(study.models, bench.pilots(), refined_axes(bench.scene()));
    return bench.runs() > runs;
}

bool is_near(const Models& models, const Discretisation& choice) {
    const double space = space_of(models, choice).near, time = time_of(models, choice).near;
    const bool space_told = !models.refinable || (space > 0 && space_knob(choice) * reach >= space);
    return space_told && time > 0 && time_knob(choice) * reach_in_time(choice.stepping) >= time;
}

Models near_only(Models models) {
    const auto keep = [](auto& of) {
        if (std::ranges::any_of(of, [](const auto& model) { return model.near > 0; })) {
            std::erase_if(of, [](const auto& model) { return model.near == 0; });
        }
    };
    keep(models.spaces);
    keep(models.times);
    return models;
}

}  // namespace thermocontact::plan
