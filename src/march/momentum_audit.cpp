#include "march/momentum_audit.h"

#include <cmath>

#include "fem/traversal.h"

namespace thermocontact::march {
namespace {

/// sum(left) - sum(right), and the sum of all magnitudes; `extra` belongs to the left but is not reported.
Audit difference_of(const Record& left, const Record& right, double extra) {
    double difference = extra, scale = std::abs(extra);
    for (const auto& [name, value] : left) {
        difference += value;
        scale += std::abs(value);
    }
    for (const auto& [name, value] : right) {
        difference -= value;
        scale += std::abs(value);
    }
    return {left, difference, scale};
}

/// Four nodes side by side, and then the others.
template <int components>
ForceSums sum_over(const double* force, const double* velocity, fem::NodeRange range) {
    constexpr int lanes = 4 * components;
    double power[lanes] = {}, magnitude[lanes] = {}, resultant[lanes] = {};
    const std::ptrdiff_t end = std::ptrdiff_t{range.end} * components;
    std::ptrdiff_t i = std::ptrdiff_t{range.begin} * components;
    for (; i + lanes <= end; i += lanes) {
#pragma omp simd
        for (int lane = 0; lane < lanes; ++lane) {
            const double value = force[i + lane];
            power[lane] += value * velocity[i + lane];
            magnitude[lane] += std::abs(value);
            resultant[lane] += value;
        }
    }
    for (int lane = 0; i < end; ++i, ++lane) {
        power[lane] += force[i] * velocity[i];
        magnitude[lane] += std::abs(force[i]);
        resultant[lane] += force[i];
    }
    ForceSums sums;
    for (int lane = 0; lane < lanes; ++lane) {
        sums.power += power[lane];
        sums.magnitude += magnitude[lane];
        sums.resultant[static_cast<std::size_t>(lane % components)] += resultant[lane];
    }
    return sums;
}

}  // namespace

ForceSums sum_up(const double* force, const double* velocity, int components, fem::NodeRange range) {
    return components == 2 ? sum_over<2>(force, velocity, range) : sum_over<3>(force, velocity, range);
}

ForceSums sum_up(const double* force, const double* velocity, int components,
                 std::span<const std::int32_t> nodes) {
    ForceSums sums;
    for (const std::int32_t node : nodes) {
        fem::add_doubles(sums, sum_up(force, velocity, components, {node, node + 1}));
    }
    return sums;
}

void MomentumAudit::add(double step, const Energies& of_step, const MomentumSums& of_forces,
                        double scale_of_energy) {
    energy_scale += scale_of_energy;
    if (duration == 0) {
        duration = step;
        energies = of_step;
        sums = of_forces;
        return;
    }
    energies.kinetic = of_step.kinetic;
    energies.strain = of_step.strain;
    energies.stored = of_step.stored;
    energies.kinetic_numerical += of_step.kinetic_numerical;
    energies.spring = of_step.spring;
    energies.strain_numerical += of_step.strain_numerical;
    energies.spring_numerical += of_step.spring_numerical;
    energies.anchors += of_step.anchors;
    const double before = duration / (duration + step), now = step / (duration + step);
    for (ForceSums MomentumSums::*force :
         {&MomentumSums::inertia, &MomentumSums::viscous, &MomentumSums::thermal, &MomentumSums::compliance,
          &MomentumSums::friction, &MomentumSums::load, &MomentumSums::reaction, &MomentumSums::spring}) {
        ForceSums& mean = sums.*force;
        const ForceSums& last = of_forces.*force;
        mean.power = before * mean.power + now * last.power;
        mean.magnitude = before * mean.magnitude + now * last.magnitude;
        for (std::size_t c = 0; c < mean.resultant.size(); ++c) {
            mean.resultant[c] = before * mean.resultant[c] + now * last.resultant[c];
        }
    }
    sums.foundation_power = before * sums.foundation_power + now * of_forces.foundation_power;
    sums.momentum_rate = before * sums.momentum_rate + now * of_forces.momentum_rate;
    sums.spring_parts = before * sums.spring_parts + now * of_forces.spring_parts;
    duration += step;
}

Audit audit_energy(const Energies& energies, const MomentumSums& sums, double step) {
    const auto work = [&](const ForceSums& force) { return step * force.power; };
    const double foundation_work = step * sums.foundation_power;
    const Record left{{"kinetic_energy", energies.kinetic},
                      {"strain_energy", energies.strain},
                      {"spring_energy", energies.spring},
                      {"kinetic_numerical_dissipation", energies.kinetic_numerical},
                      {"strain_numerical_dissipation", energies.strain_numerical},
                      {"spring_numerical_dissipation", energies.spring_numerical},
                      {"viscous_dissipation", work(sums.viscous)},
                      {"compliance_work", work(sums.compliance)},
                      {"friction_dissipation", work(sums.friction) + foundation_work}};
    const Record right{{"load_work", work(sums.load)},
                       {"thermal_work", work(sums.thermal)},
                       {"reaction_work", work(sums.reaction)},
                       {"foundation_work", foundation_work},
                       {"anchor_work", energies.anchors}};
    const double stored_before = energies.kinetic_old + energies.strain_old + energies.spring_old;
    Audit audit = difference_of(left, right, -stored_before);
    audit.scale += worth_of_round_off(energies.stored);
    audit.terms.insert(audit.terms.end(), right.begin(), right.end());
    return audit;
}

Audit audit_forces(const MomentumSums& sums, int components) {
    Audit audit{{}, 0.0, 0.0};
    // the magnitude of what is summed: loads that balance each other still count. Inner forces are not
    // summed, but a node's balance is solved beside them
    audit.scale = sums.inertia.magnitude + sums.compliance.magnitude + sums.friction.magnitude +
                  sums.load.magnitude + sums.reaction.magnitude + sums.spring.magnitude +
                  worth_of_round_off(sums.momentum_rate + sums.viscous.magnitude + sums.thermal.magnitude +
                                     sums.spring_parts);
    for (std::size_t c = 0; c < static_cast<std::size_t>(components); ++c) {
        const std::string axis(1, "xyz"[c]);
        const double inertia = sums.inertia.resultant[c], load = sums.load.resultant[c],
                     contact = sums.compliance.resultant[c] + sums.friction.resultant[c],
                     reaction = sums.reaction.resultant[c], spring = sums.spring.resultant[c];
        audit.difference += std::abs(inertia + contact + spring - load - reaction);
        audit.terms.insert(audit.terms.end(), {{"inertia_force_" + axis, inertia},
                                               {"contact_force_" + axis, contact},
                                               {"spring_force_" + axis, spring},
                                               {"load_force_" + axis, load},
                                               {"reaction_force_" + axis, reaction}});
    }
    return audit;
}

}  // namespace thermocontact::march
