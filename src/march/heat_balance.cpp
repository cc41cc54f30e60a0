/// Heat: its balance over the steps (MODEL.md, 6).
#include <algorithm>
#include <cmath>

#include "march/assembler.h"
#include "march/audit_limit.h"
#include "march/heat.h"
#include "march/vectors.h"
#include "stopwatch.h"

namespace thermocontact::march {

double Heat::storage_rate(std::size_t node) const {
    const double old = stored_[node], now = new_stored_[node], base = base_stored()[node];
    return (rule_.alpha * (now - old) - (base - old)) / rule_.tau;
}

Heat::BodyFlows Heat::flows_over(fem::NodeRange range) const {
    const StepRule rule = rule_;
    const double *old = stored_.data(), *now = new_stored_.data(), *base = base_stored().data(),
                 *load = load_->data();
    double storage = 0, storage_magnitude = 0, loads = 0, load_magnitude = 0, stored = 0;
#pragma omp simd reduction(+ : storage, storage_magnitude, loads, load_magnitude, stored)
    for (std::int32_t i = range.begin; i < range.end; ++i) {
        const double rate = (rule.alpha * (now[i] - old[i]) - (base[i] - old[i])) / rule.tau;
        storage += rate;
        storage_magnitude += std::abs(rate);
        loads += load[i];
        load_magnitude += std::abs(load[i]);
        stored += std::abs(now[i]);
    }
    return {{storage, storage_magnitude}, {loads, load_magnitude}, stored};
}

Heat::Flows Heat::flows() {
    multiply({{.matrix = pointer(capacity_), .x = &new_temperature(), .y = &new_stored_}});
    if (prescribed_rows_) {
        prescribed_rows_->multiply(stage_, conducted_);
    }
    balance_->contact().nodal_forces("conductance", outflow_);
    const auto body = traversal_.sum<BodyFlows>([this](fem::NodeRange range) { return flows_over(range); });
    const Sum outflow = sum_at_contact(outflow_);
    Flows here{.storage = body.storage.value,
               .outflow = outflow.value,
               .convection = 0,
               .reaction = 0,
               .load = body.load.value,
               .strain = strain_.value,
               .strain_rate = strain_rate_.value,
               .friction = friction_.value,
               .scale = body.storage.magnitude + outflow.magnitude + body.load.magnitude + strain_.magnitude +
                        strain_rate_.magnitude + friction_.magnitude +
                        worth_of_round_off(body.stored / rule_.tau)};
    if (exchange_) {
        multiply({{.matrix = pointer(exchange_), .x = &stage_, .y = &part_}});
        as_eigen(part_) -= as_eigen(*ambient_load_);
        const Sum convected = sum_over_nodes(part_);
        here.convection = convected.value;
        here.scale += convected.magnitude;
    }
    Sum reaction;
    for (const std::int32_t dof : balance_->prescribed().dofs()) {
        const auto i = static_cast<std::size_t>(dof);
        reaction.add(storage_rate(i) + conducted_[i] + outflow_[i] - (*load_)[i] - source_[i] +
                     (exchange_ ? part_[i] : 0.0));
    }
    here.reaction = reaction.value;
    here.scale += reaction.magnitude;
    return team_->summed(here);
}

void Heat::examine(double limit) {
    timed(audit_seconds_, [&] { step_flows_ = flows(); });
    const double residual = relative(step_flows_.difference(), step_flows_.scale);
    if (!(residual <= limit)) {
        const auto& f = step_flows_;
        throw StepFailure(
            balance_->name() + " balance: " +
            unkept_text("heat", residual, limit,
                        {{"storage (heat.capacity)", std::abs(f.storage)},
                         {"contact's flow (conductance.coefficient)", std::abs(f.outflow)},
                         {"convection", std::abs(f.convection)},
                         {"flow at prescribed temperatures (heat.conductivity)", std::abs(f.reaction)},
                         {"loads", std::abs(f.load)},
                         {"heat of strain (heat.strain_heating)", std::abs(f.strain)},
                         {"heat of strain rates (heat.strain_rate_heating)", std::abs(f.strain_rate)},
                         {"heat of friction", std::abs(f.friction)}},
                        "W"));
    }
}

void Heat::add_to_audit() {
    const Flows& now = step_flows_;
    const double duration = audit_.duration + rule_.step;
    const double weight = audit_.duration == 0 ? 1.0 : rule_.step / duration;
    for (double Flows::*flow :
         {&Flows::storage, &Flows::outflow, &Flows::convection, &Flows::reaction, &Flows::load,
          &Flows::strain, &Flows::strain_rate, &Flows::friction, &Flows::scale}) {
        audit_.mean.*flow =
            weight == 1.0 ? now.*flow : (1 - weight) * (audit_.mean.*flow) + weight * (now.*flow);
    }
    audit_.duration = duration;
}

double Heat::norm(double square) const {
    return std::sqrt(std::max(0.0, team_->sum(square) / capacity_density_.value_or(1.0)));
}

void Heat::close_audit(const State& state) {
    const Flows& mean = audit_.mean;
    heat_residual_ = relative(mean.difference(), mean.scale);
    record_ = {{"temperature_l2", capacity_density_ ? norm(as_eigen(state.temperature).dot(as_eigen(stored_)))
                                                    : temperature_norm(state.temperature)},
               {"heat_storage_rate", mean.storage},
               {"contact_heat_outflow", mean.outflow},
               {"prescribed_temperature_inflow", mean.reaction},
               {"load_heat_inflow", mean.load},
               {"strain_heat_inflow", mean.strain},
               {"strain_rate_heat_inflow", mean.strain_rate},
               {"friction_heat_inflow", mean.friction},
               {"convection_heat_outflow", mean.convection},
               {"heat_residual", heat_residual_}};
    drop_audit();
}

}  // namespace thermocontact::march
