#include "plan/pilot.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "march/kept_factors.h"
#include "output/conditioning.h"
#include "output/fields.h"
#include "output/vtu.h"
#include "stopwatch.h"

namespace thermocontact::plan {
namespace {

constexpr double long_frame = 0.02;  ///< s: one that need not be timed again

double peak_pressure(march::Simulation& simulation) {
    double peak = 0;
    for (std::size_t i = 0; i < simulation.surfaces().size(); ++i) {
        const model::FacetFields fields = simulation.probe(i).fields();
        if (const auto pressure = fields.find("pressure"); pressure != fields.end()) {
            for (const double value : pressure->second) {
                peak = std::max(peak, value);
            }
        }
    }
    return peak;
}

double value_of(Quantity quantity, march::Simulation& simulation) {
    if (quantity == Quantity::peak_pressure) {
        return peak_pressure(simulation);
    }
    if (quantity == Quantity::temperature) {
        return *std::ranges::max_element(simulation.state().temperature);
    }
    double force = 0, closed = 0, area = 0;
    for (const auto& [name, measures] : simulation.contact_measures()) {
        force += measures.normal_force;
        closed += measures.contact_fraction * measures.area;
        area += measures.area;
    }
    return quantity == Quantity::contact_force ? force : closed / area;
}

double end_seconds(march::Simulation& simulation) {
    const Stopwatch stopwatch;
    static_cast<void>(output::conditions(simulation));
    return stopwatch.seconds();
}

double frame_seconds(const scene::Scene& scene, march::Simulation& simulation) {
    if (scene.output.fields.empty()) {
        return 0;
    }
    output::FieldGrids grids(scene, simulation);
    double least = 0;
    for (const bool again : {false, true}) {  // the first time takes longer, as all memory is new
        const Stopwatch stopwatch;
        static_cast<void>(output::to_vtu(grids.body()));
        if (grids.has_contact()) {
            static_cast<void>(output::to_vtu(grids.contact()));
        }
        least = again ? std::min(least, stopwatch.seconds()) : stopwatch.seconds();
        if (least > long_frame) {
            break;
        }
    }
    return least;
}

}  // namespace

bool is_undamped(const scene::Scene& scene) {
    const auto damps = [](const std::optional<scene::Material>& material) {
        return material && material->viscosity;
    };
    return scene.material && scene.material->density && !damps(scene.material) &&
           std::ranges::none_of(scene.regions,
                                [&](const auto& entry) { return damps(entry.second.material); });
}

void Recorder::note(march::Simulation& simulation, const march::Record& row) {
    double energy = 0;
    for (const auto& [name, value] : row) {
        if (name == "kinetic_numerical_dissipation" || name == "strain_numerical_dissipation") {
            dissipated_ += value;
        } else if (name == "kinetic_energy" || name == "strain_energy") {
            energy += value;
        }
        if (name == "strain_energy") {
            largest_strain_energy_ = std::max(largest_strain_energy_, value);
        }
    }
    largest_energy_ = std::max(largest_energy_, energy);
    attempts_ += std::max<int>(1, static_cast<int>(simulation.attempts().size()));
    const march::State& state = simulation.state();
    if (state.step * std::int64_t{instants} % steps_ != 0) {
        return;
    }
    if (quantity_ == Quantity::norms) {
        frames_.push_back({state.displacement, state.velocity, state.temperature});
    } else {
        frames_.push_back({{}, {}, {}, value_of(quantity_, simulation)});
    }
}

Pilot run_pilot(const scene::Scene& scene, const Discretisation& discretisation, Quantity quantity,
                const parallel::Backend* backend, const std::function<void()>& check) {
    const Stopwatch stopwatch;
    const std::clock_t start = std::clock();
    march::Simulation simulation(scene, {}, backend);
    Costs costs;
    costs.factor = simulation.factor_seconds();
    costs.setup = stopwatch.seconds() - costs.factor;
    Recorder recorder(quantity, scene.time.steps);
    while (!simulation.finished()) {
        simulation.advance();
        recorder.note(simulation, simulation.record());
        check();
    }
    costs.processor = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    const double later_factors = simulation.factor_seconds() - costs.factor;
    costs.steps = stopwatch.seconds() - costs.setup - costs.factor - later_factors;
    costs.factor += later_factors;
    costs.factorisations = simulation.factorisations();
    for (std::size_t kept = 1; kept <= march::adaptive_factors; ++kept) {
        costs.factorisations_keeping.push_back(simulation.factorisations_keeping(kept));
    }
    costs.attempts = recorder.attempts();
    // as on a graded mesh, whose columns are not shared
    costs.factor_bytes = sizeof(double) * static_cast<double>(simulation.factor_size().entries);
    costs.unknowns =
        static_cast<double>(simulation.displacement_unknowns() + simulation.temperature_unknowns());
    costs.end = end_seconds(simulation);
    costs.frame = frame_seconds(scene, simulation);
    return {discretisation, recorder.frames(), costs, recorder.damped(is_undamped(scene))};
}

}  // namespace thermocontact::plan
