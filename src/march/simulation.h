/// A scene being marched through time, one step at a time.
///
/// Recovery: a step that Newton's method with its line search does not solve is solved by continuation in the
/// regularisation (Balance); where that fails too, it is taken in smaller steps (Subdivision); where even the
/// smallest fails, the state before the step is restored and the run ends with what was tried.
///
/// Adaptive steps are the same parts of the scene's steps: a part that errs too much (step_error.h) is halved
/// before it is accepted, so that there is nothing to restore; one that errs little is followed by a longer
/// one.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "march/heat.h"
#include "march/momentum.h"
#include "march/step_rule.h"
#include "march/subdivision.h"
#include "model/contact_measures.h"
#include "parallel/backend.h"

namespace thermocontact::march {

/// A step, or a part of one, that was accepted.
struct AcceptedPart {
    double end, length;     ///< s
    double error_estimate;  ///< relative; 0 where steps are not adapted
};

/// Totals over the steps so far.
struct Totals {
    int iterations = 0;
    int max_iterations_in_a_step = 0;
    int retries = 0;           ///< solves of a balance beyond the first: continuation
    int divided_steps = 0;     ///< steps that were taken in parts
    int parts = 0;             ///< those parts
    int steps = 0;             ///< steps and parts accepted
    int rejections = 0;        ///< parts that erred too much
    int beyond_tolerance = 0;  ///< accepted parts that did so, too, for there are no shorter ones
    int failed_attempts = 0;   ///< steps and parts that failed before
    double smallest_step = 0;  ///< accepted or failed, s; 0: none yet
    double energy_residual = 0, heat_residual = 0, force_residual = 0;  ///< largest, relative
};

class Simulation {
  public:
    /// Mesh, space, operators, factors, initial state; `sources` are loads beside those of the scene. Keeps a
    /// reference to the scene. Throws NumericsError where a system is singular, std::bad_alloc.
    explicit Simulation(const scene::Scene& scene, const model::Sources& sources = {},
                        const parallel::Backend* backend = nullptr);

    /// One step of the scene, in parts where it fails as a whole. The state changes only if the step
    /// succeeds; throws NumericsError otherwise.
    void advance();

    bool finished() const { return state_.step == scene_->time.steps; }

    const State& state() const { return state_; }

    /// What this process has of mesh and space; all of it where it is alone.
    const mesh::Mesh& mesh() const { return part_.mesh; }
    const fem::Space& space() const { return part_.space; }
    const parallel::Part& part() const { return part_; }

    const parallel::Team& team() const { return strategy_->team(); }
    const solve::Strategy& strategy() const { return *strategy_; }
    const model::ContactSurfaces& surfaces() const { return surfaces_; }
    model::ContactProbe& probe(std::size_t surface) { return *probes_[surface]; }
    const Totals& totals() const { return totals_; }
    /// Of the last step.
    const std::vector<AcceptedPart>& parts() const { return last_.parts; }

    /// Seconds spent in factorisation so far.
    double factor_seconds() const;

    /// Where the time of the steps went.
    StepSeconds step_seconds() const;

    /// Unknowns of each field over all processes; 0 for absent physics.
    std::int64_t displacement_unknowns() const {
        return scene_->material ? std::int64_t{part_.numbers.total()} * scene_->dimension : 0;
    }
    std::int64_t temperature_unknowns() const { return scene_->heat ? part_.numbers.total() : 0; }

    /// Numbers stored in the Cholesky factors.
    std::int64_t factor_entries() const;

    /// Unknowns that are condensed, of both balances.
    std::size_t contact_unknowns() const;

    /// The history's row of the current state; of the initial one before the first step.
    Record record();

    /// Resultants of the contact surfaces, by name, for the current state.
    std::map<std::string, model::ContactMeasures> contact_measures();

    /// velocity_l2, displacement_strain_l2, temperature_l2 of the current state (0 for absent physics).
    Record norms() const;

  private:
    /// What happened in the last step.
    struct StepCounts {
        SolveReport momentum, heat;
        std::vector<AcceptedPart> parts;
        int failed_attempts = 0, rejections = 0, beyond_tolerance = 0;
        double smallest_step = 0;  ///< s
    };

    void initialise();
    void prepare();
    StepRule rule(const Subdivision& parts) const;
    void attempt(Subdivision& parts, StepCounts& counts);
    double solve(const StepRule& rule, StepCounts& counts);
    void accept(const StepRule& rule);
    void solve_balances(StepCounts& counts);
    void solve_coupled(StepCounts& counts);
    void give_up(const State& before, const Subdivision& parts, const std::string& reason);
    void count_step(const StepCounts& counts);

    const scene::Scene* scene_;
    parallel::Part part_;
    fem::NodeGraph graph_;
    std::unique_ptr<solve::Strategy> strategy_;
    model::ContactSurfaces surfaces_;
    Scheme scheme_;
    std::optional<ErrorControl> control_;
    State state_;
    std::vector<double> no_motion_;  ///< displacement and velocity of a scene without mechanics
    std::vector<double> no_heat_;    ///< temperature of a scene without heat: none
    std::optional<Momentum> momentum_;
    std::optional<Heat> heat_;
    std::vector<std::unique_ptr<model::ContactProbe>> probes_;
    StepCounts last_;
    Record balances_;  ///< of the last step that succeeded
    Totals totals_;
};

}  // namespace thermocontact::march
