/// The momentum balance of one step (MODEL.md, 3): find w_n with
///
///   rho (w_n - w_{n-1}, v)/k + (V eps(w_n), eps(v)) + (E eps(u_n), eps(v)) - (theta_{n-1} M, eps(v))
///     + contact(u_n, w_n; v) + (k_s (u_n - u_s), v)_S = (f0, v) + (f1, v)_N,      u_n = u_{n-1} + k w_n,
///
/// S the sides that springs hold (model/springs.h).
///
/// That is backward Euler; in the other schemes w_n, u_n are the values at the stage, w_{n-1}, u_{n-1} are
/// w_hat, u_hat, and k is tau (step_rule.h).
#pragma once

#include <memory>
#include <optional>

#include "fem/traversal.h"
#include "march/balance.h"
#include "march/momentum_audit.h"
#include "march/step_error.h"
#include "march/step_rule.h"
#include "model/loads.h"
#include "model/plane_body.h"
#include "model/springs.h"
#include "parallel/team.h"

namespace thermocontact::march {

class Momentum {
  public:
    /// Assembles; `sources` are loads beside the scene's.
    Momentum(const scene::Scene& scene, const mesh::Mesh& mesh, const fem::Space& space,
             const fem::NodeGraph& graph, solve::Strategy& strategy, const model::ContactSurfaces& surfaces,
             const State& initial, const std::vector<model::Source>& sources);

    /// A step is begun, solved (again if the temperature changes) and accepted. The state changes when it is
    /// accepted; a step that is not leaves no trace. `state` is that at the begin of the step. Throws
    /// NumericsError where the system is singular.
    void begin(const StepRule& rule, const State& state);

    /// Heat of strain that is a multiple of the thermal stress' transpose: what one reads the other needs.
    struct StrainHeat {
        double factor;              ///< R = factor M
        const Nodal* displacement;  ///< known before the step is solved
        Nodal* source;              ///< (R : eps(u), eta), assembled; its size already
    };

    /// Solves with the temperature in the thermal stress, and computes the heat of strain beside if that is
    /// not null. Throws StepFailure.
    SolveReport solve(const std::vector<double>& temperature, const StrainHeat* heat = nullptr);

    /// Displacement and velocity at the end of the step, from solve().
    void complete(const State& state);

    /// Of the completed step: what it adds to the errors of the fields, and their sizes (step_control.h).
    /// None where no rate enters a balance: u without inertia, viscosity and friction, w without inertia.
    FieldError displacement_error(const State& state) const;
    FieldError deformation_error(const State& state) const;
    FieldError velocity_error(const State& state) const;

    /// The balances of energy and force over the completed step. Throws StepFailure where one is not kept to
    /// `limit` (audit_limit.h): such a step is not solved, whatever Newton's method said.
    void examine(const State& state, double limit);

    /// Moves the state's displacement and velocity, and what the scheme knows of their rates, to the end of
    /// the completed and examined step, and adds the step to the audit.
    void accept(State& state, const Scheme& scheme);

    /// Displacement and velocity at the stage, from solve(); their addresses stay.
    const std::vector<double>& stage_displacement() const { return stage_displacement_; }
    const std::vector<double>& stage_velocity() const { return stage_velocity_; }

    /// Takes up a state that accept() did not produce: the initial one, or an earlier one after a failure.
    void restart(const State& state);

    /// Ends the sums over the steps accepted since the last call, which led to `state`: norms, and every term
    /// of the energy and force balances (MODEL.md, 6).
    void close_audit(const State& state);
    /// Forgets them.
    void drop_audit() { audit_ = {}; }
    const Record& record() const { return record_; }
    double energy_residual() const { return energy_residual_; }  ///< relative
    double force_residual() const { return force_residual_; }    ///< relative

    /// ||w||_L2 and ||eps(u)||_L2 of a state.
    double velocity_norm(const std::vector<double>& w) const;
    double strain_norm(std::vector<double> u) const;

    /// Energies of a state, J.
    double kinetic_energy(const State& state) const;
    double strain_energy(const State& state) const;
    double spring_energy(const State& state) const;

    const model::Springs& springs() const { return springs_; }
    /// (theta M, eps(v)); null without.
    const fem::BlockMatrix* coupling() const { return coupling_ ? &*coupling_ : nullptr; }

    Balance& balance() { return *balance_; }
    const Balance& balance() const { return *balance_; }

    /// Time spent in solve() and accept().
    StepSeconds seconds() const;

  private:
    struct Products {  ///< operators applied to a state [nodes][components]; zeros where absent
        std::vector<double> mass_w, stiffness_u;
        std::vector<double> deformation;  ///< displacement less its mean
    };

    void apply(const std::vector<double>& velocity, const std::vector<double>& displacement,
               Products& products);
    void apply_to_new_state();
    fem::PlaneProducts plane_products(const std::vector<double>& velocity, Products& products);
    void multiply(std::initializer_list<fem::Product> products) {
        traversal_.multiply({products.begin(), products.size()});
    }

    const std::vector<double>& new_velocity() const {
        return rule_.ends_at_stage() ? stage_velocity_ : new_velocity_;
    }
    const std::vector<double>& new_displacement() const {
        return rule_.ends_at_stage() ? stage_displacement_ : new_displacement_;
    }
    /// Products of w_hat and u_hat.
    const Products& base() const { return rule_.memory() == 0 ? old_ : base_; }
    void collect_boundary_forces();
    /// What a range of nodes adds up to, of the forces in the body.
    struct BodySums {
        Energies energies;
        ForceSums inertia, viscous, thermal, load;
        double momentum = 0;  ///< sum of |M w|, N s
    };
    BodySums sums_over(fem::NodeRange range, const State& old) const;
    void add_boundary(MomentumSums& sums);
    void add_springs(Energies& energies, MomentumSums& sums, const State& old);
    double motion_of(std::size_t i, const State& old) const;
    std::string what_is_lost(const std::string& which, double residual, double limit) const;
    bool rates_matter() const;
    /// (E eps(u), eps(u))^(1/2).
    double elastic_norm(std::vector<double> u) const;
    double norm(const fem::BlockMatrix& gram, const std::vector<double>& v) const;

    const parallel::Team* team_;
    int dimension_;
    const mesh::Mesh* mesh_;
    const model::ContactSurfaces* surfaces_;
    std::optional<double> density_;  ///< rho, where it is uniform
    std::optional<fem::BlockMatrix> mass_, damping_, stiffness_, coupling_;
    std::optional<model::PlaneBody> plane_;          ///< stiffness and damping are in it, too
    std::optional<fem::BlockMatrix> strain_gram_;    ///< without that
    std::optional<fem::BlockMatrix> velocity_gram_;  ///< without uniform density
    model::Loads loads_;
    model::Springs springs_;

    // of the step at hand
    StepRule rule_{};
    const std::vector<double>* load_ = nullptr;
    std::vector<double> stage_velocity_, base_displacement_;  ///< w_s and u_hat, which the contact forms read
    std::vector<double> stage_displacement_;  ///< old from accept() to solve() where the step ends there
    std::vector<double> base_velocity_;
    std::vector<double> new_displacement_;  ///< at the end of the step, where that is not the stage
    std::vector<double> new_velocity_;      ///< at the end of the step
    std::unique_ptr<Balance> balance_;
    fem::Traversal traversal_;
    std::vector<std::int32_t> contact_nodes_, prescribed_nodes_;  ///< where forces of the boundary act
    Products old_, base_, now_;  ///< of the state, of w_hat and u_hat, and of the new state
    std::vector<double> rhs_;
    std::vector<double> viscous_, compliance_, friction_, reaction_;  ///< at the stage
    std::vector<double> thermal_;                                     ///< (theta M, eps(v)), assembled
    std::vector<double> spring_;                                      ///< at the stage; empty without springs
    double strain_square_ = 0;  ///< of the new state, |eps(u)|^2, of this process

    MomentumAudit audit_;
    Energies step_energies_;  ///< of the step that was examined
    MomentumSums step_sums_;  ///< likewise
    double step_energy_scale_ = 0;
    double audit_seconds_ = 0;
    Record record_;
    double energy_residual_ = 0, force_residual_ = 0;
};

}  // namespace thermocontact::march
