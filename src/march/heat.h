/// The heat balance of one step (MODEL.md, 3): find theta_n with
///
///   c (theta_n - theta_{n-1}, eta)/k + (K grad theta_n, grad eta) + int_C k_c(u_n.n - g) phi_L(theta_n -
///   theta_F) eta
///     + int_N h (theta_n - theta_a) eta
///     = (q0, eta) + (heat flux, eta)_N + (R : eps(u_{n-1}) + R' : eps(w_{n-1}), eta)
///     + int_C share -sigma_t.(w_n - v_F) eta.
///
/// Solved for theta_n - theta_ref; theta_ref is 0, or near the solution where its last bit matters (solve()).
///
/// That is backward Euler with lagged coupling; in the other schemes theta_n and u_n are the values at the
/// stage, theta_{n-1} is theta_hat, k is tau (step_rule.h), and the strain heating takes u_n and w_n, just
/// computed, as the heat of friction always does.
#pragma once

#include <cmath>
#include <memory>
#include <optional>

#include "fem/matrix_rows.h"
#include "fem/traversal.h"
#include "march/balance.h"
#include "march/step_error.h"
#include "march/step_rule.h"
#include "model/friction_heat.h"
#include "model/loads.h"
#include "parallel/team.h"

namespace thermocontact::march {

class Heat {
  public:
    /// Assembles; `sources` are loads beside the scene's. The contact forms read displacement and velocity at
    /// the stage from `stage_motion`.
    Heat(const scene::Scene& scene, const mesh::Mesh& mesh, const fem::Space& space,
         const fem::NodeGraph& graph, solve::Strategy& strategy, const model::ContactSurfaces& surfaces,
         const State& initial, const model::Motion& stage_motion, const std::vector<model::Source>& sources);

    /// A step is begun, solved and accepted, as that of Momentum.
    void begin(const StepRule& rule, const State& state);

    /// Solves with the motion in the strain heating (not read without); that in the contact is the one at the
    /// stage, just computed. `strain_heat_known`: source_of_strain() holds the heat of strain already. Throws
    /// StepFailure.
    SolveReport solve(const model::Motion& motion, bool strain_heat_known = false);

    Nodal& source_of_strain() { return source_; }
    /// (R : eps(u), eta); null without.
    const fem::BlockMatrix* strain_heating() const { return strain_heating_ ? &*strain_heating_ : nullptr; }

    /// The temperature at the end of the step, from solve().
    void complete(const State& state);

    /// Of the completed step: what it adds to the temperature's error, where there is capacity.
    FieldError temperature_error(const State& state) const;

    /// The balance of heat over the completed step. Throws StepFailure where it is not kept to `limit`
    /// (audit_limit.h).
    void examine(double limit);

    /// Moves the state's temperature, and what the scheme knows of its rate, to the end of the completed and
    /// examined step.
    void accept(State& state, const Scheme& scheme);

    /// theta + alpha k q, in backward Euler theta: what is known of the stage before it is solved.
    const std::vector<double>& expected_temperature() const { return *expected_; }
    /// theta_s, from solve().
    const std::vector<double>& stage_temperature() const { return stage_; }

    /// Takes up a state that accept() did not produce.
    void restart(const State& state);

    /// Ends the sums over the steps accepted since the last call, which led to `state`: the norm, and every
    /// term of the heat balance (MODEL.md, 6), means over the time.
    void close_audit(const State& state);
    /// Forgets them.
    void drop_audit() { audit_ = {}; }
    const Record& record() const { return record_; }
    double heat_residual() const { return heat_residual_; }  ///< relative

    /// ||theta||_L2.
    double temperature_norm(const std::vector<double>& theta) const;

    /// The heat that a state holds, J.
    double content(const State& state) const;

    Balance& balance() { return *balance_; }
    const Balance& balance() const { return *balance_; }

    /// Time spent in solve() and accept().
    StepSeconds seconds() const;

  private:
    struct Flows {  ///< W (W/m in 2D)
        double storage, outflow, convection, reaction, load, strain, strain_rate, friction;
        double scale;  ///< the magnitude of what is summed: inflow on one side and outflow on the other count

        double difference() const {
            return storage + outflow + convection - reaction - load - strain - strain_rate - friction;
        }
    };
    struct Audit {            ///< of the steps since the last row of the history
        double duration = 0;  ///< s
        Flows mean{};
    };

    /// A heat source, or several, assembled: its sum and that of its magnitudes, W.
    struct Sum {
        double value = 0, magnitude = 0;

        void add(double flow) {
            value += flow;
            magnitude += std::abs(flow);
        }
    };

    void gather_sources(const model::Motion& motion, bool strain_heat_known);
    Sum sum_over_nodes(const std::vector<double>& flows) const;
    Sum sum_at_contact(const std::vector<double>& flows) const;
    void multiply(std::initializer_list<fem::Product> products) {
        traversal_.multiply({products.begin(), products.size()});
    }
    void add_to_audit();
    /// What a range of nodes adds up to, of the flows in the body.
    struct BodyFlows {
        Sum storage, load;
        double stored = 0;  ///< sum of |C theta|, J
    };
    BodyFlows flows_over(fem::NodeRange range) const;
    double storage_rate(std::size_t node) const;
    Flows flows();
    bool rounds_flows();
    void refer_to(const std::vector<double>* temperature);
    SolveReport solve_from_reference();
    const std::vector<double>& new_temperature() const {
        return rule_.ends_at_stage() ? stage_ : new_temperature_;
    }
    const std::vector<double>& base_stored() const { return rule_.memory() == 0 ? stored_ : base_stored_; }

    /// ||theta||_L2 from this process' part of theta . C theta, C being the capacity matrix, which is c times
    /// the Gram matrix, or, without capacity, the Gram matrix itself.
    double norm(double square) const;

    const parallel::Team* team_;
    std::optional<double> capacity_density_;  ///< c, where it is uniform
    std::optional<fem::BlockMatrix> capacity_, conduction_, strain_heating_, strain_rate_heating_;
    std::optional<fem::BlockMatrix> exchange_;        ///< h theta of boundaries with convection
    std::optional<fem::BlockMatrix> gram_;            ///< without uniform capacity
    std::optional<fem::MatrixRows> prescribed_rows_;  ///< of conduction, where temperatures are prescribed
    model::Loads loads_;
    std::optional<model::Loads> ambient_;  ///< h theta_a likewise
    model::FrictionHeat friction_heat_;

    // of the step at hand
    StepRule rule_{};
    const std::vector<double>* load_ = nullptr;
    const std::vector<double>* ambient_load_ = nullptr;  ///< null without convection
    const model::ContactSurfaces* surfaces_;
    const std::vector<double>* expected_ = nullptr;  ///< theta_s before it is solved: the state's or
    std::vector<double> extrapolated_;
    std::vector<double> stage_;      ///< theta_s; scratch from accept() to begin() where the step ends there
    std::vector<double> reference_;  ///< theta_ref
    bool referred_ = false;          ///< whether theta_ref is other than 0
    std::vector<double> excess_;     ///< theta_s - theta_ref, which is solved for; contact reads it
    std::vector<std::vector<double>> foundations_;  ///< [surfaces]: theta_F - theta_ref likewise
    std::vector<double> new_temperature_;           ///< at the end of the step, where that is not the stage
    std::vector<double> no_displacement_;           ///< for contact forms of a scene without mechanics
    std::unique_ptr<Balance> balance_;
    fem::Traversal traversal_;
    std::vector<std::int32_t> contact_nodes_;                ///< where heat may flow out into foundations
    std::vector<double> stored_, base_stored_, new_stored_;  ///< C theta, C theta_hat and C theta_new
    std::vector<double> rhs_, of_reference_;
    std::vector<double> outflow_;        ///< contact conductance, assembled
    std::vector<double> conducted_;      ///< K theta_s at prescribed temperatures
    std::vector<double> source_, part_;  ///< of strain, its rate and friction, assembled; and one of them
    Sum strain_, strain_rate_, friction_;

    Audit audit_;
    Flows step_flows_{};  ///< of the step that was examined
    double audit_seconds_ = 0;
    Record record_;
    double heat_residual_ = 0;
};

}  // namespace thermocontact::march
