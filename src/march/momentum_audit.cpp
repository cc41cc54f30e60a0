#include "march/momentum_audit.h"

#include <cmath>

#include "march/vectors.h"

namespace thermocontact::march {
namespace {

/// sum(left) - sum(right) against the sum of all magnitudes; `extra` belongs to the left but is not reported.
double relative_difference(const Record& left, const Record& right, double extra) {
    double difference = extra, scale = std::abs(extra);
    for (const auto& [name, value] : left) {
        difference += value;
        scale += std::abs(value);
    }
    for (const auto& [name, value] : right) {
        difference -= value;
        scale += std::abs(value);
    }
    return scale > 0 ? std::abs(difference) / scale : 0.0;
}

}  // namespace

Audit audit_energy(const Energies& energies, const MomentumForces& forces, const Eigen::VectorXd& velocity,
                   double step) {
    const auto work = [&](const ConstVectorMap& force) { return step * velocity.dot(force); };
    const Record left{{"kinetic_energy", energies.kinetic},
                      {"strain_energy", energies.strain},
                      {"kinetic_numerical_dissipation", energies.kinetic_numerical},
                      {"strain_numerical_dissipation", energies.strain_numerical},
                      {"viscous_dissipation", work(forces.viscous)},
                      {"compliance_work", work(forces.compliance)},
                      {"friction_dissipation", work(forces.friction)}};
    const Record right{{"load_work", work(forces.load)},
                       {"thermal_work", work(forces.thermal)},
                       {"reaction_work", work(forces.reaction)}};
    Audit audit{left, relative_difference(left, right, -energies.kinetic_old - energies.strain_old)};
    audit.terms.insert(audit.terms.end(), right.begin(), right.end());
    return audit;
}

Audit audit_forces(const MomentumForces& forces, int components) {
    Audit audit{{}, 0.0};
    const Eigen::VectorXd inertias = resultant(forces.inertia, components);
    const Eigen::VectorXd contacts =
        resultant(forces.compliance, components) + resultant(forces.friction, components);
    const Eigen::VectorXd loads = resultant(forces.load, components);
    const Eigen::VectorXd reactions = resultant(forces.reaction, components);
    // the magnitude of what is summed: loads that balance each other still count
    const double scale = forces.inertia.lpNorm<1>() + forces.compliance.lpNorm<1>() +
                         forces.friction.lpNorm<1>() + forces.load.lpNorm<1>() + forces.reaction.lpNorm<1>();
    double difference = 0;
    for (int c = 0; c < components; ++c) {
        const std::string axis(1, "xyz"[c]);
        const double inertia = inertias[c], contact = contacts[c], load = loads[c], reaction = reactions[c];
        difference += std::abs(inertia + contact - load - reaction);
        audit.terms.insert(audit.terms.end(), {{"inertia_force_" + axis, inertia},
                                               {"contact_force_" + axis, contact},
                                               {"load_force_" + axis, load},
                                               {"reaction_force_" + axis, reaction}});
    }
    audit.residual = scale > 0 ? difference / scale : 0.0;
    return audit;
}

}  // namespace thermocontact::march
