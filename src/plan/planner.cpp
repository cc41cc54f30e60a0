#include "plan/planner.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "error.h"
#include "plan/climb.h"
#include "plan/duration.h"
#include "plan/models.h"
#include "plan/report.h"
#include "solve/available_memory.h"

namespace thermocontact::plan {
namespace {

constexpr double longest = 3600;            ///< s, of a run that is planned without a budget
constexpr double share_of_pilot = 0.015;    ///< of the budget, that one pilot of a ladder may take
constexpr double seconds_of_pilot = 0.5;    ///< where there is no budget
constexpr double share_near_choice = 0.4;   ///< of the chosen run's time, for the pilots near it
constexpr double bytes_an_unknown = 2100;   ///< of newton-krylov, the leaner strategy (solve/forecast.h)
constexpr double margin_of_time = 0.8;      ///< of the budget: predictions of time err, too
constexpr double longest_near_choice = 10;  ///< s, for the same
constexpr double most_correction = 4;
constexpr int most_levels = 24, approaches = 3;
constexpr double offers_apart = 3.1622776601683795;  ///< half a digit

const std::vector<Stepping>& steppings() {
    // the one that damps nothing first: others may have to be judged by it
    static const std::vector<Stepping> all = {{"midpoint", false},          {"bdf2", false},
                                              {"generalized-alpha", false}, {"bdf2", true},
                                              {"backward-euler", false},    {"backward-euler", true}};
    return all;
}

/// Whether motions go on for ever: those that a scheme damps are then missing in what it converges to as long
/// as its steps do not resolve them, and its differences do not show it.
bool is_undamped(const scene::Scene& scene) {
    const auto damps = [](const std::optional<scene::Material>& material) {
        return material && material->viscosity;
    };
    return scene.material && scene.material->density && !damps(scene.material) &&
           std::ranges::none_of(scene.regions,
                                [&](const auto& entry) { return damps(entry.second.material); });
}

double order_of(const Stepping& stepping) {
    const double order = stepping.scheme == "backward-euler" ? 1 : 2;
    return stepping.adaptive ? order / (order + 1)
                             : order;  // the tolerance is one step's, which errs as k^(order + 1)
}

/// Cells that the mesh of the pilots in time has at least: contact is to open and close at many points.
int cells_in_time(int dimension) {
    return dimension == 2 ? 200 : 60;
}

int scale_in_time(const scene::Scene& scene) {
    if (scene.mesh.file) {
        return 1;
    }
    const std::vector<int> coarsest = coarsest_cells(scene);
    for (int scale = 1;; scale *= 2) {
        const std::vector<int> cells = scaled_cells(coarsest, scene.mesh.cells, scale);
        const double total = std::accumulate(cells.begin(), cells.end(), 1.0, std::multiplies<>());
        if (total >= cells_in_time(scene.dimension)) {
            return scale;
        }
    }
}

double seconds_without_output(Models models, const Discretisation& choice) {
    models.frames = 0;
    return assess(models, choice).seconds;
}

}  // namespace

Planner::Planner(Bench& bench, Request request, bool budget_counts_pilots)
    : bench_(&bench), comparison_(bench.scene(), request.of), counts_pilots_(budget_counts_pilots) {
    plan_.request = request;
    plan_.components = comparison_.components();
    plan_.models.sum = request.of == Quantity::norms ? Sum::squares : Sum::plain;
    const scene::Scene& scene = bench.scene();
    plan_.models.refinable = !scene.mesh.file;
    if (scene.mesh.file) {
        plan_.remarks.emplace_back(
            "the mesh is a file's and stays as it is: the error of space is not controlled");
    } else if (std::ranges::count(scene.mesh.cells, 1) > 0) {
        plan_.remarks.emplace_back("axes with one cell keep it: the error across is not controlled");
    }
    const bool graded = std::ranges::any_of(scene.mesh.grading, [](const scene::Grading& grading) {
        return grading.lower != 1 || grading.upper != 1;
    });
    if (graded && scene.mesh.cell == "simplex") {
        plan_.remarks.emplace_back(
            "graded triangles and tetrahedra are not nested: differences are those of "
            "interpolated solutions");
    }
    plan_.models.frames = scene.output.fields.empty() ? 0 : frames_of(scene);
}

double Planner::pilot_allowance() const {
    return plan_.request.budget ? std::min(share_of_pilot * *plan_.request.budget, 20 * seconds_of_pilot)
                                : seconds_of_pilot;
}

/// What either source may leave in its finest pilot: less than that need not be known.
double Planner::goal() const {
    return plan_.request.accuracy ? *plan_.request.accuracy / 4 : 0.0;
}

Limits Planner::limits() const {
    const double spent = counts_pilots_ ? bench_->seconds() : 0.0;
    const double seconds = plan_.request.budget ? margin_of_time * (*plan_.request.budget - spent) : longest;
    return {seconds, solve::available_memory() / bytes_an_unknown};
}

std::vector<double> Planner::highest_orders_in_space(int degree) const {
    std::vector<double> orders;
    for (const std::string& component : plan_.components) {
        orders.push_back(component == "strain" ? degree : degree + 1);
    }
    return orders;
}

Climb Planner::climb_of(const Stepping& stepping, double allowance) const {
    const scene::Scene& scene = bench_->scene();
    const int degree = plan_.models.refinable ? 1 : scene.degree;
    const int scale = scale_in_time(scene);
    const auto level = [stepping, degree, scale](int number) -> std::optional<Discretisation> {
        const int steps = stepping.adaptive ? adaptive_steps : instants << std::min(number, most_levels);
        const double tolerance = first_tolerance / std::pow(tolerance_ratio, number);
        return number < (stepping.adaptive ? most_levels / 4 : most_levels)
                   ? std::optional(Discretisation{degree, scale, stepping, steps, tolerance})
                   : std::nullopt;
    };
    return {level, time_knob, std::vector<double>(plan_.components.size(), order_of(stepping)),
            2,     goal(),    allowance};
}

void Planner::climb_in_time() {
    const bool undamped = is_undamped(bench_->scene());
    double allowance = pilot_allowance();
    std::optional<Climbed> faithful;  // where the scene damps nothing: by the scheme that does not, either
    std::vector<std::string> unresolved;
    for (const Stepping& stepping : steppings()) {
        // where material damps, contact starts fast motions on every mesh that only midpoint keeps
        const bool rings = !undamped && stepping.scheme == "midpoint";
        if (rings || !bench_->can(stepping)) {
            continue;
        }
        const Climb how = climb_of(stepping, allowance);
        Climbed climbed = climb(*bench_, comparison_, how);
        if (climbed.pilots.empty()) {
            continue;
        }
        if (faithful) {
            climbed.error = error_against(climbed, *faithful, comparison_, how);
        } else if (undamped && stepping.scheme == "midpoint") {
            faithful = climbed;
        }
        if (climbed.pilots.back()->damped > most_damped) {
            unresolved.push_back(describe(stepping));
            continue;
        }
        plan_.models.times.push_back(time_model(stepping, climbed));
        if (climbed.error.largest_at(climbed.error.finest()) <= goal()) {  // no need to follow what is dearer
            allowance = std::min(allowance, 2 * climbed.pilots.back()->costs.processor);
        }
    }
    if (plan_.models.times.empty() && unresolved.empty()) {
        throw NumericsError("plan: no pilot could be run; the last one failed: " + bench_->failure());
    }
    if (!unresolved.empty()) {
        plan_.remarks.push_back(
            "left out, as more than a tenth of the energy is lost to steps that do not resolve "
            "the motions: " +
            list(unresolved));
    }
}

void Planner::add_space(int degree, const Stepping& stepping, int steps, double tolerance) {
    const auto level = [&](int number) -> std::optional<Discretisation> {
        return number < most_levels / 2
                   ? std::optional(Discretisation{degree, 1 << number, stepping, steps, tolerance})
                   : std::nullopt;
    };
    const auto knob = [](const Discretisation& choice) { return 1.0 / choice.scale; };
    const int d = bench_->scene().dimension;
    const double growth = std::pow(2.0, 1.2 * d);
    const Climbed climbed =
        climb(*bench_, comparison_,
              {level, knob, highest_orders_in_space(degree), growth, goal(), 2 * pilot_allowance()});
    if (!climbed.pilots.empty()) {
        plan_.models.spaces.push_back(space_model(degree, d, climbed.pilots, climbed.error));
    }
}

/// With the cheapest stepping that errs little: an error of space that only shows where time is resolved is
/// not to be missed.
void Planner::climb_in_space() {
    double few = plan_.request.accuracy ? *plan_.request.accuracy / 2 : std::numeric_limits<double>::max();
    for (const TimeModel& time : plan_.models.times) {
        if (!plan_.request.accuracy) {
            few = std::min(few, 4 * time.error.largest_at(time.error.finest()));
        }
    }
    const TimeModel* best = nullptr;
    double fewest = 0, knob = 0;
    for (const TimeModel& time : plan_.models.times) {
        double at = time.error.coarsest();
        while (at > time.error.finest() * 1.01 && time.error.largest_at(at) > few) {
            at /= time.stepping.adaptive ? tolerance_ratio : 2;
        }
        const double cost =
            time.attempts.at(at) * std::max(1.0, time.error.largest_at(at) / std::max(few, 1e-12));
        if (best == nullptr || cost < fewest) {
            best = &time, fewest = cost, knob = at;
        }
    }
    const Stepping stepping = best->stepping;
    const int steps = stepping.adaptive ? adaptive_steps : static_cast<int>(std::lround(1 / knob));
    const double tolerance = stepping.adaptive ? knob : 0;
    if (!plan_.models.refinable) {
        const Discretisation only{bench_->scene().degree, 1, stepping, steps, tolerance};
        if (const Pilot* pilot = bench_->run(only)) {
            plan_.models.spaces.push_back(space_model(only.degree, bench_->scene().dimension, {pilot},
                                                      ErrorCurve(plan_.components.size())));
        }
    } else {
        add_space(1, stepping, steps, tolerance);
        add_space(2, stepping, steps, tolerance);
    }
    if (plan_.models.spaces.empty()) {
        throw NumericsError("plan: no pilot could be run; the last one failed: " + bench_->failure());
    }
}

std::optional<Option> Planner::choose(double accuracy_factor) const {
    if (plan_.request.accuracy) {
        return cheapest(plan_.models, aim_of_accuracy * accuracy_factor * *plan_.request.accuracy, limits());
    }
    Limits affordable = limits();
    affordable.seconds /= accuracy_factor;  // of a budget, the offers are of other times
    return most_accurate(plan_.models, affordable);
}

/// Compares the models with pilots at half the cells and half the steps of `option`; false where these would
/// cost too much.
bool Planner::correct_near(const Option& option) {
    const Discretisation chosen = option.discretisation;
    const Discretisation middle = coarser_in_time(coarser_in_space(chosen));
    const Discretisation in_space = coarser_in_space(middle), in_time = coarser_in_time(middle);
    double seconds = 0;
    for (const Discretisation& choice : {middle, in_space, in_time}) {
        seconds += seconds_without_output(plan_.models, choice);
    }
    const double of_choice = seconds_without_output(plan_.models, chosen);
    const double share = std::min(share_near_choice * of_choice, longest_near_choice);
    if (seconds > std::max(share, 2 * pilot_allowance())) {
        return false;
    }
    const Pilot* reference = bench_->run(middle);
    learn_costs(plan_.models, bench_->pilots(), bench_->scene().dimension);
    const auto factors = [&](const Discretisation& choice, auto error_of) {
        std::vector<double> result(plan_.components.size(), 1.0);
        const Pilot* pilot = bench_->run(choice);
        if (reference == nullptr || pilot == nullptr) {
            return result;
        }
        const std::vector<double> found = comparison_.difference(*pilot, *reference);
        const std::vector<double> size = comparison_.size(*reference);
        const std::vector<double> coarse = error_of(choice), fine = error_of(middle);
        for (std::size_t c = 0; c < result.size(); ++c) {
            const double expected = (coarse[c] - fine[c]) * size[c];
            result[c] = expected > 0 && found[c] > 0
                            ? std::clamp(found[c] / expected, 1 / most_correction, most_correction)
                            : 1.0;
        }
        return result;
    };
    const auto space = [&](const Discretisation& choice) { return assess(plan_.models, choice).space; };
    const auto time = [&](const Discretisation& choice) { return assess(plan_.models, choice).time; };
    if (in_space.scale != middle.scale) {
        const std::vector<double> found = factors(in_space, space);
        for (SpaceModel& model : plan_.models.spaces) {
            model.error.correct(found);
        }
    }
    if (time_knob(in_time) != time_knob(middle)) {
        const std::vector<double> found = factors(in_time, time);
        for (TimeModel& model : plan_.models.times) {
            model.error.correct(found);
        }
    }
    return true;
}

void Planner::approach() {
    for (int i = 0; i < approaches; ++i) {
        const std::optional<Option> option = choose(1);
        if (!option || !correct_near(*option)) {
            return;
        }
        const double now = assess(plan_.models, option->discretisation).error;
        if (std::abs(std::log(now / option->error)) < std::log(1.2)) {
            return;
        }
    }
}

void Planner::refuse() {
    plan_.best = most_accurate(plan_.models, limits());
    if (!plan_.request.accuracy || !plan_.best) {
        plan_.refusal = "the pilots leave no time for a run; a larger budget is needed";
        return;
    }
    const Limits bounds = limits();
    plan_.refusal = "an error of " + about(*plan_.request.accuracy) + " cannot be promised: with " +
                    duration_text(bounds.seconds) + " and memory for " + about(bounds.unknowns) +
                    " unknowns the error of " + largest_source(plan_.components, *plan_.best) +
                    " is what remains";
}

Plan Planner::make() {
    climb_in_time();
    if (plan_.models.times.empty()) {
        plan_.refusal = "the motions of this scene are not resolved by as many steps as pilots can take";
    } else {
        climb_in_space();
        approach();
        plan_.chosen = choose(1);
    }
    if (plan_.chosen) {
        plan_.cheaper = choose(offers_apart);
        plan_.better = choose(1 / offers_apart);
    } else if (plan_.refusal.empty()) {
        refuse();
    }
    if (const std::optional<Option>& shown = plan_.chosen ? plan_.chosen : plan_.best) {
        plan_.settings = settings(bench_->scene(), shown->discretisation);
    }
    plan_.pilots = bench_->runs();
    plan_.pilot_seconds = bench_->seconds();
    return plan_;
}

}  // namespace thermocontact::plan
