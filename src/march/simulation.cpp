#include "march/simulation.h"

#include <algorithm>
#include <cmath>

#include "error.h"
#include "fem/both_ways.h"
#include "march/audit_limit.h"
#include "march/course.h"
#include "mesh/shapes.h"
#include "model/law_samples.h"
#include "model/nodal.h"
#include "parallel/together.h"
#include "solve/available_memory.h"

namespace thermocontact::march {

namespace {

constexpr int most_coupling_iterations = 50;

parallel::Part make_part(const scene::Scene& scene, const parallel::Backend* backend,
                         const mesh::Mesh* given) {
    const parallel::Team& team = parallel::team_of(backend);
    const parallel::Phase phase(backend, "mesh");
    mesh::Mesh mesh = given != nullptr ? *given : mesh::make_mesh(scene.mesh);
    fem::Space space = fem::make_space(mesh, scene.degree);
    return parallel::take_part(std::move(mesh), std::move(space), team.size(), team.rank());
}

}  // namespace

Simulation::Simulation(const scene::Scene& scene, const model::Sources& sources,
                       const parallel::Backend* backend, const mesh::Mesh* mesh)
    : scene_(&scene),
      part_(make_part(scene, backend, mesh)),
      graph_(fem::make_node_graph(part_.space)),
      surfaces_(
          parallel::together(parallel::team_of(backend),
                             [&] { return model::make_contact_surfaces(scene, part_.mesh, part_.space); })),
      choice_(choose_strategy(scene, graph_, part_, surfaces_, backend, solve::available_memory())),
      scheme_(scene.time) {
    const parallel::Phase phase(backend, "assembly");
    parallel::together(team(), [&] {
        model::check_own_tensors(scene, part_.mesh);
        initialise();
    });
    if (scene.material) {
        momentum_.emplace(scene, part_.mesh, part_.space, graph_, *choice_.strategy, surfaces_, state_,
                          sources.mechanical);
    }
    if (scene.heat) {
        heat_.emplace(scene, part_.mesh, part_.space, graph_, *choice_.strategy, surfaces_, state_,
                      stage_motion(), sources.thermal);
    }
    if (momentum_ && heat_ && momentum_->coupling() != nullptr && heat_->strain_heating() != nullptr &&
        !scheme_.second_order()) {
        strain_heat_factor_ = fem::factor_of_transposed(*momentum_->coupling(), *heat_->strain_heating());
    }
    look_for_free_motions();
    prepare();
    const model::ContactState contact{scene.material ? &state_.displacement : &no_motion_,
                                      scene.material ? &state_.velocity : &no_motion_, &state_.temperature};
    for (const auto& surface : surfaces_) {
        probes_.push_back(std::make_unique<model::ContactProbe>(*surface, part_.mesh, part_.space,
                                                                scene.dimension, contact));
    }
}

/// The systems of equal steps, that of the first one last: what is singular is so before the first step.
void Simulation::prepare() {
    if (control_) {
        if (momentum_) {
            momentum_->balance().keep(adaptive_factors);
        }
        if (heat_) {
            heat_->balance().keep(adaptive_factors);
        }
    }
    const double k = rule(Subdivision(state_.halvings)).step;
    for (const double last_step : {k, 0.0}) {
        const double tau = scheme_.rule(0.0, k, k, last_step).tau;
        if (momentum_) {
            momentum_->balance().use(tau);
        }
        if (heat_) {
            heat_->balance().use(tau);
        }
    }
}

void Simulation::initialise() {
    if (scene_->time.tolerance) {
        control_ = {*scene_->time.tolerance};
    }
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
    // kept where a part may succeed before one fails, or where what follows its acceptance may: steps with
    // rates end beyond their stage, and the expressions there are evaluated last (accept())
    std::optional<State> before;
    if (scheme_.carries_rates()) {
        before = state_;
    }
    Subdivision parts(state_.halvings);
    StepCounts counts;
    const int cycles_before = cycles();
    while (!parts.done()) {
        const StepRule rule = this->rule(parts);
        try {
            solve(rule, counts);
            require_held();
            settle(rule, parts, counts);
        } catch (const StepFailure& failure) {
            if (!before) {
                before = state_;
            }
            note_failure(rule, counts);
            if (!parts.fail()) {
                give_up(*before, parts, failure.what());
            }
        } catch (const NumericsError& error) {
            give_up(before ? *before : State(state_), parts, error.what());
        }
    }
    ++state_.step;
    state_.halvings = control_ ? parts.halvings() : 0;
    counts.failed_attempts = parts.failures();
    counts.cycles = cycles() - cycles_before;
    counts.smallest_step = parts.smallest() * scene_->time.end / scene_->time.steps;
    count_step(counts);
}

StepRule Simulation::rule(const Subdivision& parts) const {
    const scene::TimeSpec& time = scene_->time;
    return scheme_.rule(state_.time, time.end * (state_.step + parts.end()) / time.steps,
                        time.end / time.steps * parts.length(), state_.last_step);
}

/// The state does not change.
void Simulation::solve(const StepRule& rule, StepCounts& counts) {
    parallel::together(team(), [&] { model::update(surfaces_, part_.space, rule.stage_time()); });
    if (momentum_) {
        momentum_->begin(rule, state_);
    }
    if (heat_) {
        heat_->begin(rule, state_);
    }
    solve_balances(counts);
    if (momentum_) {
        momentum_->complete(state_);
    }
    if (heat_) {
        heat_->complete(state_);
    }
}

/// The state has not changed where it throws.
void Simulation::accept(const StepRule& rule, StepCounts& counts) {
    const double limit = audit_limit(scene_->solver.tolerance);
    if (momentum_) {
        momentum_->examine(state_, limit);
    }
    if (heat_) {
        heat_->examine(limit);
    }
    if (momentum_) {
        momentum_->accept(state_, scheme_);
    }
    if (heat_) {
        heat_->accept(state_, scheme_);
    }
    state_.even_steps = even_steps(rule, state_);
    state_.even_step = rule.step;
    state_.time = rule.end;
    state_.last_step = scheme_.carries_rates() ? rule.step : 0;
    state_.curvature_lag = curvature_lag(scheme_, rule);
    if (rule.stage_time() != rule.end) {
        parallel::together(team(), [&] { model::update(surfaces_, part_.space, rule.end); });
    }
    ++counts.parts;
}

/// Of the momentum balance; null without.
model::Motion Simulation::stage_motion() const {
    return momentum_ ? model::Motion{&momentum_->stage_displacement(), &momentum_->stage_velocity()}
                     : model::Motion{};
}

/// Momentum takes the temperature that is known before the step, heat the motion: of the last state in the
/// paper's scheme, where its strain may be taken together with the temperature; in those of second order the
/// expected temperature and the motion just computed.
void Simulation::solve_balances(StepCounts& counts) {
    if (momentum_ && heat_ && scene_->time.coupling_tolerance) {
        solve_coupled(counts);
        return;
    }
    std::optional<Momentum::StrainHeat> together;
    if (strain_heat_factor_) {
        together = {*strain_heat_factor_, &state_.displacement, &heat_->source_of_strain()};
    }
    if (momentum_) {
        counts.momentum.add(momentum_->solve(heat_ ? heat_->expected_temperature() : no_heat_,
                                             together ? &*together : nullptr));
    }
    if (heat_) {
        const bool just_computed = momentum_ && scheme_.second_order();
        counts.heat.add(heat_->solve(
            just_computed ? stage_motion() : model::Motion{&state_.displacement, &state_.velocity},
            together.has_value()));
    }
}

/// Both balances in turn, each with what the other has just computed, until the temperature at the stage no
/// longer changes.
void Simulation::solve_coupled(StepCounts& counts) {
    const double tolerance = *scene_->time.coupling_tolerance;
    std::vector<double> temperature = heat_->expected_temperature();
    for (int iteration = 0; iteration < most_coupling_iterations; ++iteration) {
        counts.momentum.add(momentum_->solve(temperature));
        counts.heat.add(heat_->solve(stage_motion()));
        const std::vector<double>& next = heat_->stage_temperature();
        double change[2] = {0, 0};  // of the largest temperature, and that itself
        for (std::size_t i = 0; i < next.size(); ++i) {
            change[0] = std::max(change[0], std::abs(next[i] - temperature[i]));
            change[1] = std::max(change[1], std::abs(next[i]));
        }
        team().max(change);
        if (change[0] <= tolerance * change[1]) {
            return;
        }
        temperature = next;
    }
    throw StepFailure("momentum and heat balance: the coupling did not converge in " +
                      std::to_string(most_coupling_iterations) + " iterations");
}

void Simulation::note(const Look& look) {
    const auto cells = static_cast<int>(part_.cells);
    totals_.looks += look.looks;
    totals_.repeated_steps += look.repeated;
    totals_.coarser_meshes += look.coarser;
    totals_.beyond_mesh_tolerance += look.beyond;
    totals_.error_in_space = std::max(totals_.error_in_space, look.error);
    totals_.last_error_in_space = look.error;
    totals_.fewest_cells = totals_.fewest_cells == 0 ? cells : std::min(totals_.fewest_cells, cells);
    totals_.most_cells = std::max(totals_.most_cells, cells);
    state_.deformation_energy = look.deformation_energy;
    state_.heat_energy = look.heat_energy;
}

Simulation::Stored Simulation::stored() const {
    Stored stored;
    if (momentum_) {
        stored.kinetic = momentum_->kinetic_energy(state_);
        stored.strain = momentum_->strain_energy(state_);
        stored.spring = momentum_->spring_energy(state_);
    }
    if (heat_) {
        stored.heat = heat_->content(state_);
    }
    return stored;
}

void Simulation::count_step(const StepCounts& counts) {
    last_ = counts;
    balances_.clear();
    if (momentum_) {
        momentum_->close_audit(state_);
        balances_.insert(balances_.end(), momentum_->record().begin(), momentum_->record().end());
        totals_.energy_residual = std::max(totals_.energy_residual, momentum_->energy_residual());
        totals_.force_residual = std::max(totals_.force_residual, momentum_->force_residual());
    }
    if (heat_) {
        heat_->close_audit(state_);
        balances_.insert(balances_.end(), heat_->record().begin(), heat_->record().end());
        totals_.heat_residual = std::max(totals_.heat_residual, heat_->heat_residual());
    }
    const int iterations = counts.momentum.iterations + counts.heat.iterations;
    totals_.iterations += iterations;
    totals_.max_iterations_in_a_step = std::max(totals_.max_iterations_in_a_step, iterations);
    totals_.retries += counts.momentum.retries + counts.heat.retries;
    for (const SolveReport& report : {counts.momentum, counts.heat}) {
        totals_.at_round_off += report.at_round_off;
        totals_.round_off_residual = std::max(totals_.round_off_residual, report.round_off_residual);
    }
    totals_.cycles += counts.cycles;
    totals_.failed_attempts += counts.failed_attempts;
    count_attempts(counts);
    if (control_ ? counts.failed_attempts > 0 : counts.parts > 1) {
        ++totals_.divided_steps;
        totals_.parts += counts.parts;
    }
    totals_.smallest_step = totals_.smallest_step == 0
                                ? counts.smallest_step
                                : std::min(totals_.smallest_step, counts.smallest_step);
}

}  // namespace thermocontact::march
