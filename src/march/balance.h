/// What the two balances of a step share: a system with prescribed values and a contact term, solved by a
/// strategy.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "error.h"
#include "march/kept_factors.h"
#include "march/snapshot.h"
#include "march/state.h"
#include "model/facet_term.h"
#include "model/free_motions.h"
#include "model/nodal.h"
#include "scene/scene.h"
#include "solve/continuation.h"
#include "solve/step_problem.h"

namespace thermocontact::march {

/// No solution of a step was found; a smaller one may have one.
struct StepFailure : NumericsError {
    using NumericsError::NumericsError;
};

/// What a message says of a body that nothing holds.
struct FreeMotionWords {
    const char* lacking;     ///< what A has not: "inertia"
    const char* prescribed;  ///< "displacement"
    const char* idle;        ///< what contact does where it has no derivative: "contact is open"
    const char* advice;
};

/// Solves A x + F(x) = r for the unknowns that are not prescribed. A and F depend on tau (step_rule.h); the
/// systems of the last few tau are kept prepared.
class Balance {
  public:
    using Assembly = std::function<fem::BlockMatrix(double tau)>;

    /// `unknown` is the trial field [dofs] that the contact term reads and solve() fills.
    Balance(std::string name, const scene::SolverSpec& options, Assembly assembly,
            model::Prescribed prescribed, std::vector<char> contact_nodes, model::FacetTerm contact,
            const fem::Space& space, solve::Strategy& strategy, std::vector<double>& unknown);

    /// Makes A and F those of `tau` (s). Throws NumericsError where A is singular.
    void use(double tau);

    /// `unknown` holds the prescribed values and a start value elsewhere; `rhs` [dofs] is used up. Throws
    /// StepFailure, with the last iterate in `unknown`, if no solution is found, having tried Newton and
    /// continuation in the regularisation; NumericsError if the body was free to move at the start value: no
    /// smaller step holds it.
    SolveReport solve(std::vector<double>& rhs);

    /// What the systems prepared have kept from earlier solves and can hand on, the one in use first; and an
    /// equal balance to go on with it.
    std::vector<KeptSystem> kept_systems() const;
    void take_up(const std::vector<KeptSystem>& kept);

    /// For a field [nodes][components] that A alone does not hold, for want of inertia or capacity: from now
    /// on require_held() knows, and a step without solution tells, what is free. `held` [dofs] marks what A
    /// holds all the same (none: empty), `springs` are in it, too (null: none). Every process must call.
    void look_for_free_motions(const parallel::NodeNumbers& numbers, int components,
                               const FreeMotionWords& words, const std::vector<char>& held = {},
                               const model::Springs* springs = nullptr);

    /// Throws NumericsError where nothing holds the body, with contact as the fields are that it reads. Every
    /// process must call.
    void require_held();

    /// How many systems stay prepared.
    void keep(std::size_t systems) { most_systems_ = systems; }

    const model::Prescribed& prescribed() const { return prescribed_; }
    model::FacetTerm& contact() { return contact_; }
    /// Time spent in solve().
    const StepSeconds& seconds() const { return seconds_; }
    double factor_seconds() const { return factor_seconds_; }
    int factorisations() const { return factorisations_; }
    /// That the same steps would have taken, were so many systems kept.
    int factorisations_keeping(std::size_t systems) const { return recency_.made(systems); }
    /// Newton iterations, of steps and of rungs of continuation, that ended as contact states recurred.
    int cycles() const { return cycles_; }
    /// Whether start values near the solution save work.
    bool starts_matter() const { return strategy_->starts_matter(); }
    solve::FactorSize factor_size() const { return problem().factor_size(); }
    /// Of the system in use.
    solve::FactorUse factor_use() const { return problem().factor_use(); }
    /// What the system in use leaves of the last solution; see solve::StepProblem. Nothing where the last
    /// solve() found none.
    std::optional<solve::Condition> condition() const {
        return solved_ ? problem().condition(*unknown_) : std::nullopt;
    }
    const std::string& name() const { return name_; }
    /// A of the system in use.
    const fem::BlockMatrix& matrix() const { return systems_.front()->matrix; }
    const std::vector<char>& contact_nodes() const { return contact_nodes_; }
    const std::vector<double>& solution() const { return *unknown_; }
    /// Unknowns that the contact term depends on; dofs of this process.
    const std::vector<std::int32_t>& contact_dofs() const { return problem().contact_dofs(); }

  private:
    struct System {
        double tau;
        fem::BlockMatrix matrix;
        std::unique_ptr<solve::StepProblem> problem;
        double slip_stiffness = 0;  ///< gamma of exact friction, Pa s/m
    };

    std::unique_ptr<System> prepare(double tau);
    solve::StepProblem& problem() const { return *systems_.front()->problem; }
    SolveReport solve_contact(Eigen::VectorXd& x);
    solve::NewtonResult iterate(Eigen::VectorXd& x);
    SolveReport solve_given_multipliers(Eigen::VectorXd& x);
    struct MultiplierChange {
        double change, rounding;  ///< relative to the multiplier: its change, and what rounding makes of it
    };
    MultiplierChange update_multipliers(const Eigen::VectorXd& x);
    std::string why_not(const Eigen::VectorXd& x, const solve::NewtonResult& first,
                        const solve::ContinuationResult* ladder);
    std::string what_rounds(const Eigen::VectorXd& x, double round_off);
    std::optional<std::string> what_is_free();
    void remove_prescribed(std::vector<double>& rhs);

    std::string name_;  ///< "momentum", "heat"
    solve::NewtonOptions options_;
    Assembly assembly_;
    model::Prescribed prescribed_;
    std::vector<char> contact_nodes_;
    model::FacetTerm contact_;
    const fem::Space* space_;
    solve::Strategy* strategy_;
    std::vector<double>* unknown_;
    double memory_of_others_;                         ///< bytes that factors leave free
    bool solved_ = false;                             ///< by the last solve()
    std::optional<model::FreeMotions> free_motions_;  ///< empty: inertia holds all of them
    FreeMotionWords words_{};
    StepSeconds seconds_;
    double factor_seconds_ = 0;
    int factorisations_ = 0;  ///< systems prepared
    Recency recency_;
    int cycles_ = 0;
    std::size_t most_systems_ = 4;                  ///< a step, its halves, and those a scheme starts with
    std::vector<std::unique_ptr<System>> systems_;  ///< the one in use first, then by their last use
};

}  // namespace thermocontact::march
