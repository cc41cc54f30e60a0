/// Momentum: the balances of energy and force over its steps (momentum_audit.h).
#include <algorithm>
#include <cmath>

#include "march/momentum.h"
#include "stopwatch.h"

namespace thermocontact::march {
namespace {

/// What the scheme dissipates at one unknown, twice: `motion` is the change of the value over the step,
/// `force` that of the force, `carried` the force of y_hat less that of y (momentum_audit.h).
double twice_dissipated(const StepRule& rule, double motion, double stage, double force, double carried) {
    const double lambda = rule.tau / (rule.alpha * rule.step);
    return (2 * rule.alpha - 1) * motion * force +
           2 * stage * ((1 / lambda - 1) * force - carried / (lambda * rule.alpha));
}

}  // namespace

MomentumForces Momentum::collect_forces() {
    balance_->contact().nodal_forces("compliance", compliance_);
    balance_->contact().nodal_forces("friction", friction_);
    const std::vector<double>& base_mass_w = base().mass_w;
    for (std::size_t i = 0; i < inertia_.size(); ++i) {
        const double mass_change = now_.mass_w[i] - old_.mass_w[i];
        inertia_[i] = (rule_.alpha * mass_change - (base_mass_w[i] - old_.mass_w[i])) / rule_.tau;
    }
    if (!springs_.empty()) {
        std::ranges::fill(spring_, 0.0);
        springs_.add_forces(1, stage_displacement_, spring_);
    }
    for (const std::int32_t dof : balance_->prescribed().dofs()) {
        const auto i = static_cast<std::size_t>(dof);
        const double elastic =
            old_.stiffness_u[i] + rule_.alpha * (now_.stiffness_u[i] - old_.stiffness_u[i]);
        reaction_[i] =
            inertia_[i] + viscous_[i] + elastic - thermal_[i] + compliance_[i] + friction_[i] - (*load_)[i];
        reaction_[i] += springs_.empty() ? 0.0 : spring_[i];
    }
    const auto view = [](const std::vector<double>& v) { return as_eigen(v); };
    return {view(inertia_),  view(viscous_), view(thermal_),  view(compliance_),
            view(friction_), view(*load_),   view(reaction_), view(spring_)};
}

/// Displacements are taken less that of the first node: a shift has no energy, but times the sum of K u,
/// which is round-off, it may be more than all there is in a stiff body far from where it was meshed.
Energies Momentum::energies(const State& old) const {
    Energies sums;  // at shared nodes each process holds a part of M w and K u, so that the sums add up
    const Products& base = this->base();
    const auto d = static_cast<std::size_t>(dimension_);
    for (std::size_t i = 0, c = 0; i < stage_velocity_.size(); ++i, c = c + 1 < d ? c + 1 : 0) {
        const double mass_change = now_.mass_w[i] - old_.mass_w[i],
                     stiffness_change = now_.stiffness_u[i] - old_.stiffness_u[i];
        const double motion = motion_of(i, old);
        sums.kinetic_old += old.velocity[i] * old_.mass_w[i];
        sums.kinetic += new_velocity_[i] * now_.mass_w[i];
        sums.kinetic_numerical +=
            twice_dissipated(rule_, new_velocity_[i] - old.velocity[i], stage_velocity_[i], mass_change,
                             base.mass_w[i] - old_.mass_w[i]);
        sums.strain_old += (old.displacement[i] - old.displacement[c]) * old_.stiffness_u[i];
        sums.strain += (new_displacement_[i] - new_displacement_[c]) * now_.stiffness_u[i];
        sums.stored += std::abs(new_displacement_[i] * now_.stiffness_u[i]);
        sums.strain_numerical +=
            twice_dissipated(rule_, motion, stage_displacement_[i] - stage_displacement_[c], stiffness_change,
                             base.stiffness_u[i] - old_.stiffness_u[i]);
    }
    for (double Energies::*sum : {&Energies::kinetic_old, &Energies::kinetic, &Energies::kinetic_numerical,
                                  &Energies::strain_old, &Energies::strain, &Energies::strain_numerical}) {
        sums.*sum /= 2;
    }
    const model::Springs::Work work =
        springs_.work({old.displacement, stage_displacement_, new_displacement_,
                       [&](std::size_t i) { return motion_of(i, old); },
                       [&](std::size_t i) { return rule_.step * stage_velocity_[i]; }});
    sums.spring_old = work.old;
    sums.spring = work.now;
    sums.spring_numerical = work.numerical;
    sums.anchors = work.of_anchors;
    sums.stored += springs_.parts(new_displacement_).energy;
    return team_->summed(sums);
}

/// u_n - u_(n-1); of a body that has moved far, the difference would have fewer digits.
double Momentum::motion_of(std::size_t i, const State& old) const {
    return (rule_.tau * stage_velocity_[i] + (base_displacement_[i] - old.displacement[i])) / rule_.alpha;
}

void Momentum::examine(const State& state, double limit) {
    timed(audit_seconds_, [&] {
        apply_to_new_state();
        const MomentumForces forces = collect_forces();
        MomentumSums sums = sum_up(forces, as_eigen(std::as_const(stage_velocity_)), dimension_);
        sums.foundation_power = balance_->contact().power_of_foundations();
        sums.momentum_rate = as_eigen(std::as_const(now_.mass_w)).lpNorm<1>() / rule_.tau;
        step_energies_ = energies(state);
        sums.spring_parts = springs_.parts(stage_displacement_).force;
        step_sums_ = team_->summed(sums);
    });
    const Audit energy = audit_energy(step_energies_, step_sums_, rule_.step);
    step_energy_scale_ = energy.scale;
    for (const auto& [which, residual] :
         {std::pair("energy", energy.residual()),
          std::pair("forces", audit_forces(step_sums_, dimension_).residual())}) {
        if (!(residual <= limit)) {
            throw StepFailure(what_is_lost(which, residual, limit));
        }
    }
}

std::string Momentum::what_is_lost(const std::string& which, double residual, double limit) const {
    const MomentumSums& sums = step_sums_;
    return balance_->name() + " balance: " +
           unkept_text(which, residual, limit,
                       {{"inertia (material.density)", sums.inertia.magnitude},
                        {"viscous forces (material.viscosity)", sums.viscous.magnitude},
                        {"thermal stress (heat.thermal_stress)", sums.thermal.magnitude},
                        {"contact pressure (compliance.stiffness)", sums.compliance.magnitude},
                        {"friction (friction.coefficient)", sums.friction.magnitude},
                        {"springs (spring.stiffness)", sums.spring.magnitude},
                        {"loads", sums.load.magnitude},
                        {"forces at prescribed displacements", sums.reaction.magnitude}},
                       "N");
}

void Momentum::close_audit(const State& state) {
    const Audit energy = audit_energy(audit_.energies, audit_.sums, audit_.duration);
    const Audit force = audit_forces(audit_.sums, dimension_);
    energy_residual_ = relative(energy.difference, audit_.energy_scale);
    force_residual_ = force.residual();
    // |w|^2 = 2 KE / rho spares a product
    const double speed = std::sqrt(2 * audit_.energies.kinetic / density_.value_or(1.0));
    record_ = {{"velocity_l2", density_ ? speed : velocity_norm(state.velocity)},
               {"displacement_strain_l2", std::sqrt(std::max(0.0, team_->sum(strain_square_)))}};
    record_.insert(record_.end(), energy.terms.begin(), energy.terms.end());
    record_.emplace_back("energy_residual", energy_residual_);
    record_.insert(record_.end(), force.terms.begin(), force.terms.end());
    record_.emplace_back("force_residual", force_residual_);
    drop_audit();
}

}  // namespace thermocontact::march
