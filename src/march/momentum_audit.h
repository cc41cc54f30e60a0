/// The identities that a momentum step must satisfy (MODEL.md, 6), term by term.
#pragma once

#include <array>
#include <span>

#include "fem/block_rows.h"
#include "march/audit_limit.h"
#include "march/state.h"

namespace thermocontact::march {

/// One force summed over the nodes.
struct ForceSums {
    double power = 0;                   ///< with the velocity, W
    double magnitude = 0;               ///< sum of |f| over all nodes and components, N
    std::array<double, 3> resultant{};  ///< N
};

/// The discrete balance: inertia + viscous + elastic - thermal + compliance + friction + spring - load =
/// reaction (on prescribed dofs, else 0); elastic and spring force enter the energy audit through their
/// energies.
struct MomentumSums {
    ForceSums inertia, viscous, thermal, compliance, friction, load, reaction, spring;
    double foundation_power = 0;  ///< of sigma_t with v_F, W: what moving foundations do on the body
    double momentum_rate = 0;     ///< sum of |M w|/tau over all nodes and components, N
    double spring_parts = 0;      ///< sum of |K_s u| over them, N (model/springs.h)
};

/// Sums over the nodes of a range; force and velocity [nodes][components].
ForceSums sum_up(const double* force, const double* velocity, int components, fem::NodeRange range);

/// The same over the listed nodes.
ForceSums sum_up(const double* force, const double* velocity, int components,
                 std::span<const std::int32_t> nodes);

/// Energies before and after the step (J), and the parts that the scheme dissipates by itself.
struct Energies {
    double kinetic_old = 0, kinetic = 0, kinetic_numerical = 0;
    double strain_old = 0, strain = 0, strain_numerical = 0;
    double spring_old = 0, spring = 0, spring_numerical = 0;
    double anchors = 0;  ///< work of those who move the springs' far ends (model/springs.h)
    double stored = 0;   ///< sum of |u| (|E eps(u)| + |K_s u|) over all nodes and components
};

/// Named terms, what their sum should not be, and the magnitude of what is summed (audit_limit.h).
struct Audit {
    Record terms;
    double difference, scale;

    double residual() const { return relative(difference, scale); }
};

/// KE_n - KE_{n-1} + D(M, w) + SE_n - SE_{n-1} + D(E, u) + viscous + compliance + friction
///   + what springs store and the scheme dissipates of it
///   = loads + thermal + reactions + foundations + anchors, each as work over the step; powers are those at
///   the stage.
///
/// Friction dissipates -sigma_t.(w - v_F): its power with w and what the foundation does, sigma_t.v_F.
///
/// The numerical dissipation D(A, y) of a field y with the form A, KE = A(w, w)/2, SE = A(u, u)/2, is what
/// the stage's power k A(y_s, r_s) exceeds the change of the energy by (step_rule.h; d = (y_n - y_{n-1})/k):
///
///   D = (alpha - 1/2) A(y_n - y_{n-1}, y_n - y_{n-1}) + k (1/lambda - 1) A(y_s, d - q),  lambda = tau/(alpha
///   k).
///
/// Backward Euler: 1/2 A(y_n - y_{n-1}, y_n - y_{n-1}). Midpoint: 0. With 0 < rho < 1 and bdf2 the second
/// part, an exchange with the energy in the scheme's memory, has either sign in a single step.
Audit audit_energy(const Energies& energies, const MomentumSums& sums, double step);

/// Per component: inertia + contact + springs = loads + reactions; relative to the nodal magnitudes of these
/// forces.
Audit audit_forces(const MomentumSums& sums, int components);

/// What the steps since the last row of the history have added up to.
struct MomentumAudit {
    double duration = 0;      ///< s
    Energies energies;        ///< the first old ones, the last new ones, and the sum of what was dissipated
    MomentumSums sums;        ///< means over the time
    double energy_scale = 0;  ///< sum of those of the steps: between two rows energy may come and go

    void add(double step, const Energies& of_step, const MomentumSums& of_forces, double scale_of_energy);
};

}  // namespace thermocontact::march
