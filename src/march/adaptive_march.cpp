#include "march/adaptive_march.h"

#include "error.h"
#include "mesh/shapes.h"
#include "model/nodal.h"

namespace thermocontact::march {
namespace {

constexpr double progress = 0.97;  ///< of the error, less than which repeating a step has to leave

}  // namespace

AdaptiveMarch::AdaptiveMarch(const scene::Scene& scene, const model::Sources& sources,
                             const parallel::Backend* backend, const Snapshot* earlier)
    : scene_(&scene), sources_(sources), backend_(backend) {
    if (scene.mesh.refinement) {
        control_.emplace(scene);
        auto base = std::make_shared<const mesh::Mesh>(mesh::make_mesh(scene.mesh));
        on_ = std::make_shared<const fem::ForestSpace>(
            earlier != nullptr ? mesh::Forest(base, earlier->bisections) : mesh::Forest(base), scene.degree);
    }
    simulation_ = std::make_unique<Simulation>(scene, sources_, backend_, on_ ? &on_->mesh : nullptr);
    if (on_) {
        simulation_->note(on_->forest.bisections());
    }
    if (earlier != nullptr) {
        simulation_->resume(*earlier);
    }
}

void AdaptiveMarch::advance() {
    jump_ = {};
    if (!control_) {
        simulation_->advance();
        return;
    }
    if (!control_->is_due(simulation_->state().step)) {
        simulation_->advance();
        annotate(0);
        return;
    }
    const Before before{simulation_->snapshot(), on_, simulation_->stored()};
    const Simulation::Legacy legacy = simulation_->legacy();
    try {
        advance_looking(before);
    } catch (const NumericsError&) {
        if (on_ != before.on || !simulation_) {
            put_back(before, legacy);
        }
        throw;
    }
}

void AdaptiveMarch::advance_looking(const Before& before) {
    Simulation::Look look;
    const State& state = before.snapshot.state;
    if (state.step > 0) {
        const MeshControl::Verdict verdict =
            known_ && known_->step == state.step ? known_->verdict : control_->judge(*on_, state);
        if (auto forest = control_->coarser(*on_, verdict)) {
            look.coarser += change_to(std::move(*forest), before) ? 1 : 0;
        }
    }
    MeshControl::Verdict verdict;
    for (double last_error = 0;; last_error = verdict.error) {
        simulation_->advance();
        ++look.looks;
        verdict = control_->judge(*on_, simulation_->whole_state());
        if (!control_->is_too_coarse(verdict)) {
            break;
        }
        const bool hopeless = last_error > 0 && verdict.error > progress * last_error;
        auto forest =
            hopeless || look.looks == MeshControl::most_tries ? std::nullopt : control_->finer(*on_, verdict);
        if (!forest || !change_to(std::move(*forest), before)) {
            look.beyond = 1;
            break;
        }
        ++look.repeated;
    }
    look.error = verdict.error;
    look.deformation_energy = verdict.deformation_energy;
    look.heat_energy = verdict.heat_energy;
    simulation_->note(look);
    known_ = {simulation_->state().step, std::move(verdict)};
    annotate(look.looks);
}

/// A simulation on the other mesh takes over, at the begin of the step. Where only processes and PETSc that
/// this program has not could solve on it, the state after the step stays as it is: false.
bool AdaptiveMarch::change_to(mesh::Forest forest, const Before& before) {
    auto next = std::make_shared<const fem::ForestSpace>(std::move(forest), scene_->degree);
    const Simulation::Legacy legacy = simulation_->legacy();
    std::unique_ptr<Simulation> fresh;
    try {
        fresh = std::make_unique<Simulation>(*scene_, sources_, backend_, &next->mesh);
    } catch (const parallel::BackendNeeded&) {
        control_->limit_to(on_->forest.cell_count());
        return false;
    }
    fresh->succeed(carried(before, *next, *fresh), legacy);
    fresh->note(next->forest.bisections());
    jump_ = {};
    if (before.snapshot.state.step > 0) {
        const Simulation::Stored now = fresh->stored();
        jump_ = {now.kinetic - before.stored.kinetic, now.strain - before.stored.strain,
                 now.spring - before.stored.spring, now.heat - before.stored.heat};
    }
    simulation_ = std::move(fresh);
    on_ = std::move(next);
    ++mesh_number_;
    known_.reset();
    return true;
}

void AdaptiveMarch::put_back(const Before& before, const Simulation::Legacy& legacy) {
    on_ = before.on;
    ++mesh_number_;
    known_.reset();
    simulation_ = std::make_unique<Simulation>(*scene_, sources_, backend_, &on_->mesh);
    simulation_->succeed(before.snapshot, legacy);
    simulation_->note(on_->forest.bisections());
}

Snapshot AdaptiveMarch::carried(const Before& before, const fem::ForestSpace& to,
                                const Simulation& fresh) const {
    Snapshot result{before.snapshot.state, before.snapshot.totals};
    State& state = result.state;
    if (state.step == 0) {
        state = fresh.whole_state();
        return result;
    }
    state.friction_multiplier.clear();
    const fem::NestedTransfer transfer(*before.on, to);
    visit_members(state, [&](const std::string&, auto& member) {
        if constexpr (std::is_same_v<decltype(member), Nodal&>) {
            if (!member.empty()) {
                member = transfer(member, static_cast<int>(member.size() / before.on->space.nodes.size()));
            }
        }
    });
    if (scene_->material) {
        model::Prescribed::displacement(*scene_, to.mesh, to.space).apply(state.time, state.displacement);
    }
    if (scene_->heat) {
        model::Prescribed::temperature(*scene_, to.mesh, to.space).apply(state.time, state.temperature);
    }
    return result;
}

void AdaptiveMarch::annotate(int looks) {
    simulation_->annotate({{"cells", static_cast<double>(on_->forest.cell_count())},
                           {"mesh_looks", looks},
                           {"error_in_space", simulation_->totals().last_error_in_space},
                           {"kinetic_energy_of_remeshing", jump_.kinetic},
                           {"strain_energy_of_remeshing", jump_.strain},
                           {"spring_energy_of_remeshing", jump_.spring},
                           {"heat_of_remeshing", jump_.heat}});
}

}  // namespace thermocontact::march
