#include "march/simulation.h"

#include <algorithm>
#include <cmath>

#include "error.h"
#include "mesh/shapes.h"
#include "model/nodal.h"
#include "number.h"
#include "solve/condensed_problem.h"

namespace thermocontact::march {

namespace {

parallel::Part make_part(const scene::Scene& scene, const parallel::Backend* backend) {
    const parallel::Alone alone;
    const parallel::Team& team = backend != nullptr ? backend->team() : alone;
    const parallel::Phase phase(backend, "mesh");
    mesh::Mesh mesh = mesh::make_mesh(scene.mesh);
    fem::Space space = fem::make_space(mesh, scene.degree);
    return parallel::take_part(std::move(mesh), std::move(space), team.size(), team.rank());
}

std::unique_ptr<solve::Strategy> choose(const scene::Scene& scene, const fem::NodeGraph& graph,
                                        const parallel::Part& part, const parallel::Backend* backend) {
    const bool several = backend != nullptr && backend->team().size() > 1;
    if (several && scene.solver.strategy == "condensed") {
        throw SceneError("solver.strategy = \"condensed\" runs on one process, and mpirun started " +
                         std::to_string(backend->team().size()) +
                         "; expected \"newton-krylov\" or \"auto\", or a start without mpirun");
    }
    if (several || scene.solver.strategy == "newton-krylov") {
        return backend->newton_krylov(part);
    }
    return std::make_unique<solve::Condensed>(graph);
}

}  // namespace

Simulation::Simulation(const scene::Scene& scene, const model::Sources& sources,
                       const parallel::Backend* backend)
    : scene_(&scene),
      part_(make_part(scene, backend)),
      graph_(fem::make_node_graph(part_.space)),
      strategy_(choose(scene, graph_, part_, backend)),
      surfaces_(model::make_contact_surfaces(scene, part_.mesh, part_.space)) {
    const parallel::Phase phase(backend, "assembly");
    initialise();
    const double k = scene.time.end / scene.time.steps;
    if (scene.material) {
        momentum_.emplace(scene, part_.mesh, part_.space, graph_, *strategy_, surfaces_, state_, k,
                          sources.mechanical);
        factor_seconds_ += momentum_->balance().factor_seconds();
    }
    if (scene.heat) {
        heat_.emplace(scene, part_.mesh, part_.space, graph_, *strategy_, surfaces_, state_, k,
                      sources.thermal);
        factor_seconds_ += heat_->balance().factor_seconds();
    }
    const model::ContactState contact{scene.material ? &state_.displacement : &no_motion_,
                                      scene.material ? &state_.velocity : &no_motion_, &state_.temperature};
    for (const auto& surface : surfaces_) {
        probes_.push_back(std::make_unique<model::ContactProbe>(*surface, part_.mesh, part_.space,
                                                                scene.dimension, contact));
    }
}

void Simulation::initialise() {
    const int d = scene_->dimension;
    if (scene_->material) {
        state_.displacement = model::interpolate(part_.space, scene_->initial.displacement, d, 0.0);
        state_.velocity = model::interpolate(part_.space, scene_->initial.velocity, d, 0.0);
    } else {
        no_motion_.assign(part_.space.nodes.size() * static_cast<std::size_t>(d), 0.0);
    }
    if (scene_->heat) {
        std::vector<scene::Expression> temperature;
        if (scene_->initial.temperature) {
            temperature.push_back(*scene_->initial.temperature);
        }
        state_.temperature = model::interpolate(part_.space, temperature, 1, 0.0);
    }
}

void Simulation::advance() {
    const int step = state_.step + 1;
    const double time = scene_->time.end * step / scene_->time.steps;
    const State before = state_;
    SolveReport momentum, heat;
    try {
        model::update(surfaces_, part_.space, time);
        if (momentum_) {
            momentum = momentum_->advance(time, state_);
        }
        if (heat_) {
            heat = heat_->advance(time, state_);
        }
    } catch (const NumericsError& error) {
        restore(before);
        throw NumericsError("step " + std::to_string(step) + ", t = " + short_text(time) + ": " +
                            error.what());
    }
    state_.step = step;
    state_.time = time;
    momentum_report_ = momentum;
    heat_report_ = heat;
    count_step();
}

void Simulation::restore(const State& before) {
    state_ = before;
    if (momentum_) {
        momentum_->restart(state_);
    }
    model::update(surfaces_, part_.space, before.time);
}

void Simulation::count_step() {
    balances_.clear();
    if (momentum_) {
        balances_.insert(balances_.end(), momentum_->record().begin(), momentum_->record().end());
        totals_.energy_residual = std::max(totals_.energy_residual, momentum_->energy_residual());
        totals_.force_residual = std::max(totals_.force_residual, momentum_->force_residual());
    }
    if (heat_) {
        balances_.insert(balances_.end(), heat_->record().begin(), heat_->record().end());
        totals_.heat_residual = std::max(totals_.heat_residual, heat_->heat_residual());
    }
    const int iterations = momentum_report_.iterations + heat_report_.iterations;
    totals_.iterations += iterations;
    totals_.max_iterations_in_a_step = std::max(totals_.max_iterations_in_a_step, iterations);
    totals_.retries += momentum_report_.retries + heat_report_.retries;
}

StepSeconds Simulation::step_seconds() const {
    StepSeconds seconds;
    if (momentum_) {
        seconds.add(momentum_->seconds());
    }
    if (heat_) {
        seconds.add(heat_->seconds());
    }
    return seconds;
}

std::int64_t Simulation::factor_entries() const {
    return (momentum_ ? momentum_->balance().factor_entries() : 0) +
           (heat_ ? heat_->balance().factor_entries() : 0);
}

std::size_t Simulation::contact_unknowns() const {
    return (momentum_ ? momentum_->balance().contact_unknowns() : 0) +
           (heat_ ? heat_->balance().contact_unknowns() : 0);
}

std::map<std::string, model::ContactMeasures> Simulation::contact_measures() {
    std::map<std::string, model::ContactMeasures> result;
    for (std::size_t i = 0; i < surfaces_.size(); ++i) {
        result[surfaces_[i]->name] = probes_[i]->measure(team());
    }
    return result;
}

Record Simulation::norms() const {
    return {{"velocity_l2", momentum_ ? momentum_->velocity_norm(state_.velocity) : 0.0},
            {"displacement_strain_l2", momentum_ ? momentum_->strain_norm(state_.displacement) : 0.0},
            {"temperature_l2", heat_ ? heat_->temperature_norm(state_.temperature) : 0.0}};
}

Record Simulation::record() {
    Record row{{"step", state_.step},
               {"time", state_.time},
               {"newton_iterations", momentum_report_.iterations},
               {"heat_iterations", heat_report_.iterations},
               {"retries", momentum_report_.retries + heat_report_.retries}};
    row.insert(row.end(), balances_.begin(), balances_.end());
    if (!surfaces_.empty()) {
        double area = 0, closed = 0, slipping = 0, deepest = 0;
        for (const auto& [name, measures] : contact_measures()) {
            area += measures.area;
            closed += measures.contact_fraction * measures.area;
            slipping += measures.slip_fraction * measures.area;
            deepest = std::max(deepest, measures.max_penetration);
        }
        row.emplace_back("contact_fraction", closed / area);
        row.emplace_back("slip_fraction", slipping / area);
        row.emplace_back("max_penetration", deepest);
    }
    return row;
}

}  // namespace thermocontact::march
