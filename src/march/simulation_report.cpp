/// What a simulation tells of itself.
#include <algorithm>
#include <cmath>

#include "error.h"
#include "march/simulation.h"
#include "number.h"

namespace thermocontact::march {

std::vector<Balance*> Simulation::balances() {
    std::vector<Balance*> result;
    if (momentum_) {
        result.push_back(&momentum_->balance());
    }
    if (heat_) {
        result.push_back(&heat_->balance());
    }
    return result;
}

double Simulation::factor_seconds() const {
    return spent_.factor + (momentum_ ? momentum_->balance().factor_seconds() : 0) +
           (heat_ ? heat_->balance().factor_seconds() : 0);
}

int Simulation::factorisations() const {
    return spent_.factorisations + (momentum_ ? momentum_->balance().factorisations() : 0) +
           (heat_ ? heat_->balance().factorisations() : 0);
}

int Simulation::factorisations_keeping(std::size_t factors) const {
    return spent_.factorisations + (momentum_ ? momentum_->balance().factorisations_keeping(factors) : 0) +
           (heat_ ? heat_->balance().factorisations_keeping(factors) : 0);
}

int Simulation::cycles() const {
    return spent_.cycles + (momentum_ ? momentum_->balance().cycles() : 0) +
           (heat_ ? heat_->balance().cycles() : 0);
}

StepSeconds Simulation::step_seconds() const {
    StepSeconds seconds = spent_.steps;
    if (momentum_) {
        seconds.add(momentum_->seconds());
    }
    if (heat_) {
        seconds.add(heat_->seconds());
    }
    return seconds;
}

solve::FactorSize Simulation::factor_size() const {
    const solve::FactorSize momentum = momentum_ ? momentum_->balance().factor_size() : solve::FactorSize{},
                            heat = heat_ ? heat_->balance().factor_size() : solve::FactorSize{};
    return {momentum.entries + heat.entries, momentum.bytes + heat.bytes};
}

std::int64_t Simulation::contact_unknowns() const {
    const auto owned = [&](const std::vector<std::int32_t>& dofs, int components) {
        return static_cast<double>(std::ranges::count_if(dofs, [&](std::int32_t dof) {
            return part_.numbers.owns(static_cast<std::size_t>(dof / components));
        }));
    };
    const double here = (momentum_ ? owned(momentum_->balance().contact_dofs(), scene_->dimension) : 0) +
                        (heat_ ? owned(heat_->balance().contact_dofs(), 1) : 0);
    return std::llround(team().sum(here));
}

std::map<std::string, model::ContactMeasures> Simulation::contact_measures() {
    std::map<std::string, model::ContactMeasures> result;
    for (std::size_t i = 0; i < surfaces_.size(); ++i) {
        result[surfaces_[i]->name] = probes_[i]->measure(team());
    }
    return result;
}

void Simulation::give_up(const State& before, const Subdivision& parts, const std::string& reason) {
    take_up(before);
    const int step = state_.step + 1;
    std::string tried;
    if (parts.failures() > 0) {
        tried = "; tried " + std::to_string(parts.failures()) + " times, down to 1/" +
                std::to_string(static_cast<int>(1 / parts.smallest())) + " of the step";
        if (reason.find("; try ") == std::string::npos) {
            tried += std::string("; try more time.steps, ") +
                     (reason.starts_with("heat") ? "" : "a larger friction.regularisation, ") +
                     "or more solver.max_iterations";
        }
    }
    throw NumericsError("step " + std::to_string(step) + ", t = " +
                        short_text(scene_->time.end * step / scene_->time.steps) + ": " + reason + tried);
}

Record Simulation::norms() const {
    return {{"velocity_l2", momentum_ ? momentum_->velocity_norm(state_.velocity) : 0.0},
            {"displacement_strain_l2", momentum_ ? momentum_->strain_norm(state_.displacement) : 0.0},
            {"temperature_l2", heat_ ? heat_->temperature_norm(state_.temperature) : 0.0}};
}

Record Simulation::record() {
    Record row{{"step", state_.step},
               {"time", state_.time},
               {"newton_iterations", last_.momentum.iterations},
               {"heat_iterations", last_.heat.iterations},
               {"retries", last_.momentum.retries + last_.heat.retries},
               {"solves_at_round_off", last_.momentum.at_round_off + last_.heat.at_round_off},
               {"cycles", last_.cycles},
               {"failed_attempts", last_.failed_attempts},
               {"substeps", last_.parts}};
    if (control_) {
        double rejected = 0, largest = 0;
        for (const Attempt& attempt : last_.attempts) {
            rejected += attempt.outcome == Attempt::Outcome::rejected ? 1 : 0;
            largest = std::max(largest, is_taken(attempt) ? attempt.error : 0.0);
        }
        row.emplace_back("rejected_substeps", rejected);
        row.emplace_back("smallest_substep", last_.smallest_step);
        row.emplace_back("error_estimate", largest);
    }
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
    row.insert(row.end(), notes_.begin(), notes_.end());
    return row;
}

}  // namespace thermocontact::march
