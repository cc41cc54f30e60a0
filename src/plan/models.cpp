#include "plan/models.h"

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

namespace thermocontact::plan {
namespace {

/// A cost of the pilots by their scale, which grows at least and at most so fast beyond the finest.
LogCurve cost_curve(const std::vector<const Pilot*>& pilots, const std::function<double(const Costs&)>& cost,
                    double least, double most) {
    std::map<double, double> smallest;
    for (const Pilot* pilot : pilots) {
        const double value = cost(pilot->costs);
        const auto [entry, is_new] = smallest.try_emplace(pilot->discretisation.scale, value);
        entry->second = std::min(entry->second, value);
    }
    std::vector<double> scales, values;
    for (const auto& [scale, value] : smallest) {
        scales.push_back(scale);
        values.push_back(value);
    }
    return {scales, values, std::clamp(LogCurve::last_slope(scales, values, least), least, most)};
}

void take_costs(SpaceModel& model, const std::vector<const Pilot*>& pilots, int dimension) {
    const double d = dimension;
    const auto curve = [&](const std::function<double(const Costs&)>& cost, double least, double most) {
        return cost_curve(pilots, cost, least, most);
    };
    // a factor's entries grow as N log N in the plane and N^(4/3) in space, its operations as N^(3/2) and N^2
    model.setup = curve([](const Costs& c) { return c.setup; }, d, 1.2 * d);
    model.factor =
        curve([](const Costs& c) { return c.factor / c.factorisations; }, d, dimension == 2 ? 3 : 6);
    // steps read the factor: small pilots have it in the caches, where a step grows less than with what is
    // beyond (measured from 3 to 90 thousand unknowns: by 1.8 to 2.0, then by 2.0 to 2.4; box: 2.6, 3.5, 4.3)
    model.step = curve([](const Costs& c) { return c.steps / c.attempts; }, dimension == 2 ? 2.3 : 3.5,
                       dimension == 2 ? 2.4 : 4);
    model.unknowns = curve([](const Costs& c) { return c.unknowns; }, d, d);
    model.end = curve([](const Costs& c) { return c.end; }, d, dimension == 2 ? 2.4 : 4);
    model.frame = curve([](const Costs& c) { return c.frame; }, d, d);
}

}  // namespace

TimeModel time_model(const Stepping& stepping, const Climbed& climbed) {
    std::vector<double> knobs, attempts, factorisations, damped;
    for (const Pilot* pilot : climbed.pilots) {
        knobs.push_back(time_knob(pilot->discretisation));
        attempts.push_back(pilot->costs.attempts);
        factorisations.push_back(pilot->costs.factorisations);
        damped.push_back(pilot->damped);
    }
    const double slope = stepping.adaptive ? LogCurve::last_slope(knobs, attempts, -1.0 / 3) : -1.0;
    return {stepping, climbed.error, LogCurve(knobs, attempts, slope), LogCurve(knobs, factorisations, 0),
            LogCurve(knobs, damped, 0)};
}

SpaceModel space_model(int dimension, const std::vector<const Pilot*>& pilots, ErrorCurve error) {
    const Discretisation& any = pilots.front()->discretisation;
    SpaceModel model{any.degree, any.grading, std::move(error), {}, {}, {}, {}, {}, {}};
    take_costs(model, pilots, dimension);
    return model;
}

void learn_costs(Models& models, const std::vector<const Pilot*>& pilots, int dimension) {
    for (SpaceModel& model : models.spaces) {
        std::vector<const Pilot*> of_kind;
        std::ranges::copy_if(pilots, std::back_inserter(of_kind), [&](const Pilot* pilot) {
            return kind_of_mesh(pilot->discretisation) == kind_of_mesh(model.degree, model.grading);
        });
        if (!of_kind.empty()) {
            take_costs(model, of_kind, dimension);
        }
    }
}

}  // namespace thermocontact::plan
