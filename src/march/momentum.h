/// The momentum balance of one step (MODEL.md, 3): find w_n with
///
///   rho (w_n - w_{n-1}, v)/k + (V eps(w_n), eps(v)) + (E eps(u_n), eps(v)) - (theta_{n-1} M, eps(v))
///     + contact(u_n, w_n; v) = (f0, v) + (f1, v)_N,      u_n = u_{n-1} + k w_n.
#pragma once

#include <memory>
#include <optional>

#include "march/balance.h"
#include "march/momentum_audit.h"
#include "model/loads.h"
#include "parallel/team.h"

namespace thermocontact::march {

class Momentum {
  public:
    /// Assembles and factors for the step size k (s); `sources` are loads beside the scene's. Throws
    /// NumericsError where the system is singular.
    Momentum(const scene::Scene& scene, const mesh::Mesh& mesh, const fem::Space& space,
             const fem::NodeGraph& graph, solve::Strategy& strategy, const model::ContactSurfaces& surfaces,
             const State& initial, double k, const std::vector<model::Source>& sources);

    /// From the state at t_{n-1} to u_n and w_n at `time`; the temperature of `state` is the old one. The
    /// state changes only if the solve succeeds. Throws NumericsError.
    SolveReport advance(double time, State& state);

    /// Takes up a state that advance() did not produce: the initial one, or an earlier one after a failure.
    void restart(const State& state);

    /// Norms, and every term of the energy and force balances of the last step (MODEL.md, 6).
    const Record& record() const { return record_; }
    double energy_residual() const { return energy_residual_; }  ///< relative
    double force_residual() const { return force_residual_; }    ///< relative

    /// ||w||_L2 and ||eps(u)||_L2 of a state.
    double velocity_norm(const std::vector<double>& w) const;
    double strain_norm(std::vector<double> u) const;

    const Balance& balance() const { return *balance_; }

    /// Time spent in advance().
    StepSeconds seconds() const;

  private:
    struct Products {  ///< operators applied to a state [nodes][components]; zeros where absent
        std::vector<double> mass_w, stiffness_u;
    };

    void apply(const std::vector<double>& velocity, const std::vector<double>& displacement,
               Products& products);

    void set_right_hand_side(const std::vector<double>& load);
    MomentumForces collect_forces(const std::vector<double>& load);
    double norm(const fem::BlockMatrix& gram, const std::vector<double>& v) const;
    Energies energies(const State& old, const std::vector<double>& new_u);  ///< fills the inertia, too
    void audit(const std::vector<double>& load, const State& old, const std::vector<double>& new_u);

    const parallel::Team* team_;
    int dimension_;
    double step_;
    std::optional<double> density_;  ///< rho, where it is uniform
    std::optional<fem::BlockMatrix> mass_, damping_, stiffness_, coupling_;
    fem::BlockMatrix strain_gram_;
    std::optional<fem::BlockMatrix> velocity_gram_;  ///< without uniform density
    model::Loads loads_;
    std::vector<double> trial_, old_displacement_;  ///< w_n and u_{n-1}, which the contact forms read
    std::unique_ptr<Balance> balance_;
    Products old_, now_;                     ///< of the last state and of the one being computed
    std::vector<double> rhs_, deformation_;  ///< the latter: displacement less its mean
    std::vector<double> inertia_, viscous_, compliance_, friction_, reaction_;  ///< nodal forces of the step
    std::vector<double> thermal_;  ///< (theta_{n-1} M, eps(v)), assembled
    double audit_seconds_ = 0;
    Record record_;
    double energy_residual_ = 0, force_residual_ = 0;
};

}  // namespace thermocontact::march
