/// Heat: its balance over the steps (MODEL.md, 6).
#include <cmath>

#include "march/assembler.h"
#include "march/audit_limit.h"
#include "march/heat.h"
#include "march/vectors.h"
#include "stopwatch.h"

namespace thermocontact::march {

Heat::Flows Heat::flows() {
    product(capacity_, new_temperature_, new_stored_);
    product(conduction_, stage_, conducted_);
    balance_->contact().nodal_forces("conductance", outflow_);
    const auto stored = as_eigen(std::as_const(stored_)), load = as_eigen(*load_),
               source = as_eigen(std::as_const(source_)), outflow = as_eigen(std::as_const(outflow_));
    const Eigen::VectorXd storage =
        (rule_.alpha * (as_eigen(std::as_const(new_stored_)) - stored) - (as_eigen(base_stored()) - stored)) /
        rule_.tau;
    Eigen::VectorXd residual = storage + as_eigen(std::as_const(conducted_)) + outflow - load - source;
    Flows here{.storage = storage.sum(),
               .outflow = outflow.sum(),
               .convection = 0,
               .reaction = 0,
               .load = load.sum(),
               .strain = strain_.value,
               .strain_rate = strain_rate_.value,
               .friction = friction_.value,
               .scale = storage.lpNorm<1>() + outflow.lpNorm<1>() + load.lpNorm<1>() + strain_.magnitude +
                        strain_rate_.magnitude + friction_.magnitude +
                        worth_of_round_off(as_eigen(std::as_const(new_stored_)).lpNorm<1>() / rule_.tau)};
    if (exchange_) {
        exchange_->multiply(stage_, part_);
        as_eigen(part_) -= as_eigen(*ambient_load_);
        const auto convected = as_eigen(std::as_const(part_));
        residual += convected;
        here.convection = convected.sum();
        here.scale += convected.lpNorm<1>();
    }
    for (const std::int32_t dof : balance_->prescribed().dofs()) {
        here.reaction += residual[dof];
        here.scale += std::abs(residual[dof]);
    }
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

void Heat::close_audit(const State& state) {
    const Flows& mean = audit_.mean;
    heat_residual_ = relative(mean.difference(), mean.scale);
    record_ = {{"temperature_l2",
                capacity_density_ ? norm(state.temperature, stored_) : temperature_norm(state.temperature)},
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
