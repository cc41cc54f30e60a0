/// Momentum: the balances of energy and force over its steps (momentum_audit.h).
#include <algorithm>
#include <array>
#include <cmath>

#include "march/momentum.h"
#include "march/vectors.h"
#include "stopwatch.h"

namespace thermocontact::march {
namespace {

/// Nodes whose vectors stay in a core's own cache while all that is taken of them is summed.
constexpr std::int32_t tile = 1024;

/// What the scheme dissipates at one unknown, twice: `motion` is the change of the value over the step,
/// `force` that of the force, `carried` the force of y_hat less that of y (momentum_audit.h).
inline double twice_dissipated(const StepRule& rule, double motion, double stage, double force,
                               double carried) {
    const double lambda = rule.tau / (rule.alpha * rule.step);
    return (2 * rule.alpha - 1) * motion * force +
           2 * stage * ((1 / lambda - 1) * force - carried / (lambda * rule.alpha));
}

/// u_n - u_(n-1); of a body that has moved far, the difference would have fewer digits.
inline double motion_over(const StepRule& rule, double stage_velocity, double base, double old) {
    return (rule.tau * stage_velocity + (base - old)) / rule.alpha;
}

/// M times the rate at the stage, from M w at the begin and at the end of the step and M w_hat.
inline double inertia_of(const StepRule& rule, double old, double now, double base) {
    return (rule.alpha * (now - old) - (base - old)) / rule.tau;
}

}  // namespace

void Momentum::collect_boundary_forces() {
    balance_->contact().nodal_forces("compliance", compliance_);
    balance_->contact().nodal_forces("friction", friction_);
    if (!springs_.empty()) {
        std::ranges::fill(spring_, 0.0);
        springs_.add_forces(1, stage_displacement_, spring_);
    }
    for (const std::int32_t dof : balance_->prescribed().dofs()) {
        const auto i = static_cast<std::size_t>(dof);
        const double elastic =
            old_.stiffness_u[i] + rule_.alpha * (now_.stiffness_u[i] - old_.stiffness_u[i]);
        const double inertia = inertia_of(rule_, old_.mass_w[i], now_.mass_w[i], base().mass_w[i]);
        reaction_[i] =
            inertia + viscous_[i] + elastic - thermal_[i] + compliance_[i] + friction_[i] - (*load_)[i];
        reaction_[i] += springs_.empty() ? 0.0 : spring_[i];
    }
}

/// Displacements are taken less their mean: a shift has no energy, but times the sum of K u, which is
/// round-off, it may be more than all there is in a stiff body far from where it was meshed. At shared nodes
/// each process holds a part of M w and K u, so that the sums add up.
Momentum::BodySums Momentum::sums_over(fem::NodeRange range, const State& old) const {
    const auto d = static_cast<std::size_t>(dimension_);
    const StepRule rule = rule_;
    const double *w_old = old.velocity.data(), *w = new_velocity().data(), *w_stage = stage_velocity_.data(),
                 *u_old = old.displacement.data(), *u = new_displacement().data(),
                 *u_hat = rule.memory() == 0 ? u_old : base_displacement_.data(),
                 *mass_old = old_.mass_w.data(), *mass = now_.mass_w.data(), *mass_hat = base().mass_w.data(),
                 *stiff_old = old_.stiffness_u.data(), *stiff = now_.stiffness_u.data(),
                 *stiff_hat = base().stiffness_u.data(), *shape_old = old_.deformation.data(),
                 *shape = now_.deformation.data();
    std::array<double, std::size_t{3} * tile> inertia;
    const std::size_t first = static_cast<std::size_t>(range.begin) * d;
    double kinetic_old = 0, kinetic = 0, kinetic_numerical = 0, strain_old = 0, strain = 0,
           strain_numerical = 0, stored = 0, momentum = 0;
#pragma omp simd reduction(+ : kinetic_old, kinetic, kinetic_numerical, strain_old, strain, \
                               strain_numerical, stored, momentum)
    for (std::size_t i = first; i < static_cast<std::size_t>(range.end) * d; ++i) {
        const double shape_stage = shape_old[i] + rule.alpha * (shape[i] - shape_old[i]);
        kinetic_old += w_old[i] * mass_old[i];
        kinetic += w[i] * mass[i];
        kinetic_numerical += twice_dissipated(rule, w[i] - w_old[i], w_stage[i], mass[i] - mass_old[i],
                                              mass_hat[i] - mass_old[i]);
        strain_old += shape_old[i] * stiff_old[i];
        strain += shape[i] * stiff[i];
        strain_numerical +=
            twice_dissipated(rule, motion_over(rule, w_stage[i], u_hat[i], u_old[i]), shape_stage,
                             stiff[i] - stiff_old[i], stiff_hat[i] - stiff_old[i]);
        stored += std::abs(u[i] * stiff[i]);
        momentum += std::abs(mass[i]);
        inertia[i - first] = inertia_of(rule, mass_old[i], mass[i], mass_hat[i]);
    }
    const auto of = [&](const std::vector<double>& force) {
        return sum_up(force.data(), w_stage, dimension_, range);
    };
    return {{.kinetic_old = kinetic_old / 2,
             .kinetic = kinetic / 2,
             .kinetic_numerical = kinetic_numerical / 2,
             .strain_old = strain_old / 2,
             .strain = strain / 2,
             .strain_numerical = strain_numerical / 2,
             .stored = stored},
            sum_up(inertia.data(), w_stage + first, dimension_, {0, range.end - range.begin}),
            of(viscous_),
            of(thermal_),
            of(*load_),
            momentum};
}

/// Forces that act at few nodes.
void Momentum::add_boundary(MomentumSums& sums) {
    const auto at = [&](const std::vector<double>& force, const std::vector<std::int32_t>& nodes) {
        return sum_up(force.data(), stage_velocity_.data(), dimension_, nodes);
    };
    sums.compliance = at(compliance_, contact_nodes_);
    sums.friction = at(friction_, contact_nodes_);
    sums.reaction = at(reaction_, prescribed_nodes_);
    sums.foundation_power = balance_->contact().power_of_foundations();
}

void Momentum::add_springs(Energies& energies, MomentumSums& sums, const State& old) {
    if (springs_.empty()) {
        return;
    }
    const model::Springs::Work work =
        springs_.work({old.displacement, stage_displacement_, new_displacement(),
                       [&](std::size_t i) { return motion_of(i, old); },
                       [&](std::size_t i) { return rule_.step * stage_velocity_[i]; }});
    energies.spring_old = work.old;
    energies.spring = work.now;
    energies.spring_numerical = work.numerical;
    energies.anchors = work.of_anchors;
    energies.stored += springs_.parts(new_displacement()).energy;
    sums.spring_parts = springs_.parts(stage_displacement_).force;
    const auto nodes = static_cast<std::int32_t>(spring_.size()) / dimension_;
    sums.spring = sum_up(spring_.data(), stage_velocity_.data(), dimension_, {0, nodes});
}

double Momentum::motion_of(std::size_t i, const State& old) const {
    return motion_over(rule_, stage_velocity_[i], base_displacement_[i], old.displacement[i]);
}

void Momentum::examine(const State& state, double limit) {
    timed(audit_seconds_, [&] {
        apply_to_new_state();
        collect_boundary_forces();
        BodySums body = traversal_.sum<BodySums>([&](fem::NodeRange range) {
            BodySums sums;
            for (std::int32_t begin = range.begin; begin < range.end; begin += tile) {
                fem::add_doubles(sums, sums_over({begin, std::min(begin + tile, range.end)}, state));
            }
            return sums;
        });
        MomentumSums sums;
        sums.inertia = body.inertia;
        sums.viscous = body.viscous;
        sums.thermal = body.thermal;
        sums.load = body.load;
        sums.momentum_rate = body.momentum / rule_.tau;
        add_boundary(sums);
        add_springs(body.energies, sums, state);
        step_energies_ = team_->summed(body.energies);
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
