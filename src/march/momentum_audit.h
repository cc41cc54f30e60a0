/// The identities that a momentum step must satisfy (MODEL.md, 6), term by term.
#pragma once

#include <array>

#include "march/state.h"
#include "march/vectors.h"

namespace thermocontact::march {

/// Nodal forces of the discrete balance [nodes][components]:
/// inertia + viscous + elastic - thermal + compliance + friction - load = reaction (on prescribed dofs, else
/// 0).
struct MomentumForces {
    ConstVectorMap inertia, viscous, elastic, thermal, compliance, friction, load, reaction;
};

/// One force summed over the nodes.
struct ForceSums {
    double power = 0;                   ///< with the velocity, W
    double magnitude = 0;               ///< sum of |f| over all nodes and components, N
    std::array<double, 3> resultant{};  ///< N
};

struct MomentumSums {
    ForceSums inertia, viscous, thermal, compliance, friction, load, reaction;
};

/// Sums of all forces in one pass over the nodes; velocity [nodes][components].
MomentumSums sum_up(const MomentumForces& forces, const ConstVectorMap& velocity, int components);

/// Energies before and after the step (J), and the parts that the implicit scheme dissipates by itself.
struct Energies {
    double kinetic_old = 0, kinetic = 0, kinetic_numerical = 0;
    double strain_old = 0, strain = 0, strain_numerical = 0;
};

/// Named terms, and their sum relative to their magnitudes.
struct Audit {
    Record terms;
    double residual;
};

/// KE_n - KE_{n-1} + rho/2 |w_n - w_{n-1}|^2 + SE_n - SE_{n-1} + k^2/2 (E eps(w_n), eps(w_n)) + viscous +
/// compliance
/// + friction = loads + thermal + reactions, each as work over the step.
Audit audit_energy(const Energies& energies, const MomentumSums& sums, double step);

/// Per component: inertia + contact = loads + reactions; relative to the nodal magnitudes of these forces.
Audit audit_forces(const MomentumSums& sums, int components);

}  // namespace thermocontact::march
