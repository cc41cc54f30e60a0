/// Simulation: its state as a whole, on whatever number of processes, and going on from it.
#include <string>
#include <type_traits>
#include <utility>

#include "error.h"
#include "march/simulation.h"
#include "parallel/whole.h"

namespace thermocontact::march {

/// Makes everything that is computed from a state agree with `state`.
void Simulation::take_up(State state) {
    state_ = std::move(state);
    if (momentum_) {
        momentum_->restart(state_);
        momentum_->drop_audit();
    }
    if (heat_) {
        heat_->restart(state_);
        heat_->drop_audit();
    }
    model::update(surfaces_, part_.space, state_.time);
}

/// Which numbers the rows of a state's member have.
const parallel::NodeNumbers& Simulation::numbers_of(const std::string& member) const {
    return member == "friction_multiplier" ? part_.facet_numbers : part_.numbers;
}

State Simulation::whole_state() const {
    State state = state_;
    visit_members(state, [&](const std::string& name, auto& member) {
        if constexpr (std::is_same_v<decltype(member), Nodal&>) {
            member = parallel::to_whole(numbers_of(name), team(), member);
        }
    });
    return state;
}

Snapshot Simulation::snapshot() const {
    Snapshot snapshot{whole_state(), totals_, {}, bisections_};
    if (momentum_) {
        snapshot.kept["momentum"] = momentum_->balance().kept_systems();
    }
    if (heat_) {
        snapshot.kept["heat"] = heat_->balance().kept_systems();
    }
    return snapshot;
}

void Simulation::resume(const Snapshot& snapshot) {
    State state = snapshot.state;
    visit_members(state, [&](const std::string& name, auto& member) {
        if constexpr (std::is_same_v<decltype(member), Nodal&>) {
            const parallel::NodeNumbers& numbers = numbers_of(name);
            const auto rows = static_cast<std::size_t>(numbers.total());
            if (member.empty()) {
                return;
            }
            if (rows == 0 || member.size() % rows != 0) {
                throw SceneError("the checkpoint's " + name + " has " + std::to_string(member.size()) +
                                 " numbers, which do not fit the " + std::to_string(rows) +
                                 (&numbers == &part_.numbers ? " nodes" : " facets") + " of the mesh");
            }
            member = parallel::from_whole(numbers, member);
        }
    });
    take_up(std::move(state));
    totals_ = snapshot.totals;
    first_step_ = state_.step;
    const auto go_on = [&](const std::string& name, Balance& balance) {
        if (const auto found = snapshot.kept.find(name); found != snapshot.kept.end()) {
            balance.take_up(found->second);
        }
    };
    if (momentum_) {
        go_on("momentum", momentum_->balance());
    }
    if (heat_) {
        go_on("heat", heat_->balance());
    }
}

Simulation::Legacy Simulation::legacy() const {
    return {first_step_, factor_seconds(), factorisations(), cycles(), step_seconds()};
}

void Simulation::succeed(const Snapshot& snapshot, const Legacy& legacy) {
    resume(snapshot);
    first_step_ = legacy.first_step;
    spent_ = legacy;
}

}  // namespace thermocontact::march
