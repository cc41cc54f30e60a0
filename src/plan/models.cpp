#include "plan/models.h"

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

#include "march/kept_factors.h"

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

/// What a cost grows with beyond the finest pilot: at least and at most as these powers of the scale.
struct Growth {
    double least, most;
};

/// By the axes that are refined, 1 to 3. A factor's entries grow as N, N log N and N^(4/3), its operations as
/// N, N^(3/2) and N^2. Steps read the factor: small pilots have it in the caches, where a step grows less
/// than with what is beyond (measured in the plane, from 3 to 90 thousand unknowns: by 1.8 to 2.0, then
/// by 2.0 to 2.4; in space by 2.6, 3.5, 4.3). So do small factors: in space, from 43 to 340 thousand
/// unknowns, the time to make one grew by the power 5.8.
constexpr Growth growth_of_factor[] = {{1, 1.2}, {2, 3}, {5, 6}};
constexpr Growth growth_of_entries[] = {{1, 1.2}, {2, 2.4}, {3, 4}};
constexpr Growth growth_of_step[] = {{1, 1.2}, {2.3, 2.4}, {3.5, 4}};

void take_costs(SpaceModel& model, const std::vector<const Pilot*>& pilots, int axes) {
    const double d = axes;
    const auto curve = [&](const std::function<double(const Costs&)>& cost, const Growth& growth) {
        return cost_curve(pilots, cost, growth.least, growth.most);
    };
    const Growth factor = growth_of_factor[axes - 1], entries = growth_of_entries[axes - 1],
                 step = growth_of_step[axes - 1];
    model.setup = curve([](const Costs& c) { return c.setup; }, {d, 1.2 * d});
    model.factor = curve([](const Costs& c) { return c.factor / c.factorisations; }, factor);
    model.step = curve([](const Costs& c) { return c.steps / c.attempts; }, step);
    model.unknowns = curve([](const Costs& c) { return c.unknowns; }, {d, d});
    model.factor_bytes = curve([](const Costs& c) { return c.factor_bytes; }, entries);
    model.end = curve([](const Costs& c) { return c.end; }, step);
    model.frame = curve([](const Costs& c) { return c.frame; }, {d, d});
}

}  // namespace

int refined_axes(const scene::Scene& scene) {
    const auto refined = std::ranges::count_if(scene.mesh.cells, [](int count) { return count > 1; });
    return scene.mesh.file || refined == 0 ? scene.dimension : static_cast<int>(refined);
}

TimeModel time_model(const Stepping& stepping, const Climbed& climbed) {
    std::vector<double> knobs, attempts, damped;
    std::vector<std::vector<double>> factorisations(march::adaptive_factors);  // by how many are kept
    for (const Pilot* pilot : climbed.pilots) {
        knobs.push_back(time_knob(pilot->discretisation));
        attempts.push_back(pilot->costs.attempts);
        for (std::size_t i = 0; i < factorisations.size(); ++i) {
            factorisations[i].push_back(pilot->costs.factorisations_keeping[i]);
        }
        damped.push_back(pilot->damped);
    }
    const double slope = stepping.adaptive ? LogCurve::last_slope(knobs, attempts, -1.0 / 3) : -1.0;
    TimeModel model{
        stepping, climbed.error, LogCurve(knobs, attempts, slope), {}, LogCurve(knobs, damped, 0)};
    for (const std::vector<double>& counts : factorisations) {
        const double growth = stepping.adaptive ? LogCurve::last_slope(knobs, counts, 0) : 0;
        model.factorisations.emplace_back(knobs, counts, std::clamp(growth, std::min(slope, 0.0), 0.0));
    }
    return model;
}

SpaceModel space_model(int axes, const std::vector<const Pilot*>& pilots, ErrorCurve error) {
    const Discretisation& any = pilots.front()->discretisation;
    SpaceModel model{any.degree, any.grading, std::move(error), {}, {}, {}, {}, {}, {}, 0, any.stretch};
    take_costs(model, pilots, axes);
    return model;
}

void learn_costs(Models& models, const std::vector<const Pilot*>& pilots, int axes) {
    for (SpaceModel& model : models.spaces) {
        std::vector<const Pilot*> of_kind;
        std::ranges::copy_if(pilots, std::back_inserter(of_kind), [&](const Pilot* pilot) {
            return kind_of_mesh(pilot->discretisation) ==
                   kind_of_mesh(model.degree, model.grading, model.stretch);
        });
        if (!of_kind.empty()) {
            take_costs(model, of_kind, axes);
        }
    }
}

}  // namespace thermocontact::plan
