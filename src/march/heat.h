/// The heat balance of one step (MODEL.md, 3): find theta_n with
///
///   c (theta_n - theta_{n-1}, eta)/k + (K grad theta_n, grad eta) + int_C k_c(u_n.n - g) phi_L(theta_n -
///   theta_F) eta
///     = (q0, eta) + (heat flux, eta)_N + (R : eps(u_{n-1}), eta).
#pragma once

#include <memory>
#include <optional>

#include "march/balance.h"
#include "model/loads.h"
#include "parallel/team.h"

namespace thermocontact::march {

class Heat {
  public:
    /// Assembles and factors for the step size k (s); `sources` are loads beside the scene's. The contact
    /// forms read the displacement of `state`, which must keep its address. Throws NumericsError where the
    /// system is singular.
    Heat(const scene::Scene& scene, const mesh::Mesh& mesh, const fem::Space& space,
         const fem::NodeGraph& graph, solve::Strategy& strategy, const model::ContactSurfaces& surfaces,
         const State& state, double k, const std::vector<model::Source>& sources);

    /// From theta_{n-1} to theta_n at `time`; the displacement of `state` is already the new one. The
    /// temperature changes only if the solve succeeds. Throws NumericsError.
    SolveReport advance(double time, State& state);

    /// Norm, and every term of the heat balance of the last step (MODEL.md, 6).
    const Record& record() const { return record_; }
    double heat_residual() const { return heat_residual_; }  ///< relative

    /// ||theta||_L2.
    double temperature_norm(const std::vector<double>& theta) const;

    const Balance& balance() const { return *balance_; }

    /// Time spent in advance().
    StepSeconds seconds() const;

  private:
    void audit(const std::vector<double>& load);

    /// ||theta||_L2 from the product with the capacity matrix, which is c times the Gram matrix, or, without
    /// capacity, with the Gram matrix itself.
    double norm(const std::vector<double>& theta, const std::vector<double>& product) const;

    const parallel::Team* team_;
    double step_;
    std::optional<double> capacity_density_;  ///< c, where it is uniform
    std::optional<fem::BlockMatrix> capacity_, conduction_, strain_heating_;
    std::optional<fem::BlockMatrix> gram_;  ///< without uniform capacity
    model::Loads loads_;
    std::vector<double> trial_;            ///< theta_n, which the contact forms read
    std::vector<double> no_displacement_;  ///< for contact forms of a scene without mechanics
    std::unique_ptr<Balance> balance_;
    std::vector<double> stored_, new_stored_;  ///< C theta_{n-1} and C theta_n
    std::vector<double> outflow_;              ///< contact conductance, assembled
    std::vector<double> conducted_;            ///< K theta_n
    std::vector<double> strain_source_;        ///< R : eps(u_{n-1}), assembled
    double audit_seconds_ = 0;
    Record record_;
    double heat_residual_ = 0;
};

}  // namespace thermocontact::march
