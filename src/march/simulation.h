/// A scene being marched through time, one step at a time.
///
/// Recovery: a step that Newton's method with its line search does not solve is solved by continuation in the
/// regularisation (Balance); where that fails too, it is taken in smaller steps (Subdivision); where even the
/// smallest fails, the state before the step is restored and the run ends with what was tried.
///
/// Adaptive steps (step_control.h) are the same parts of the scene's steps. A part that errs too much is
/// found so before it is accepted: the state has not changed, and there is nothing to restore.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "march/attempt.h"
#include "march/heat.h"
#include "march/momentum.h"
#include "march/snapshot.h"
#include "march/step_control.h"
#include "march/step_rule.h"
#include "march/strategy_choice.h"
#include "march/subdivision.h"
#include "model/contact_measures.h"
#include "parallel/backend.h"

namespace thermocontact::march {

class Simulation {
  public:
    /// Mesh, space, operators, factors, initial state; `sources` are loads beside those of the scene. Keeps a
    /// reference to the scene. Throws NumericsError where a system is singular, std::bad_alloc, and
    /// what choose_strategy() throws. `mesh`: in place of the scene's own.
    explicit Simulation(const scene::Scene& scene, const model::Sources& sources = {},
                        const parallel::Backend* backend = nullptr, const mesh::Mesh* mesh = nullptr);

    /// One step of the scene, in parts where it fails as a whole. The state changes only if the step
    /// succeeds; throws NumericsError otherwise.
    void advance();

    /// What a simulation of the same scene can go on with; every process calls, each gets all of it.
    Snapshot snapshot() const;

    /// Goes on from a snapshot, on whatever number of processes it was taken: with the same strategy on one
    /// process to the last bit as the simulation it is of. Throws SceneError where it is of another mesh.
    void resume(const Snapshot& snapshot);

    /// The state in the order of the whole mesh's nodes; every process calls, each gets all of it.
    State whole_state() const;

    /// What a simulation in place of this one goes on counting from.
    struct Legacy {
        int first_step = 0;
        double factor = 0;  ///< s
        int factorisations = 0, cycles = 0;
        StepSeconds steps;
    };
    Legacy legacy() const;

    /// Goes on from `snapshot`, carried over from another mesh, in place of the simulation on that.
    void succeed(const Snapshot& snapshot, const Legacy& legacy);

    /// How the mesh was looked at after the last step, and the largest sizes of the energies then.
    struct Look {
        int looks = 0, repeated = 0, coarser = 0, beyond = 0;
        double error = 0;  ///< relative
        double deformation_energy = 0, heat_energy = 0;
    };
    void note(const Look& look);
    /// The mesh as bisections of the scene's, for snapshots.
    void note(std::vector<std::int64_t> bisections) { bisections_ = std::move(bisections); }

    /// What the fields hold: rows of a history on two meshes differ by it.
    struct Stored {
        double kinetic = 0, strain = 0, spring = 0;  ///< energies, J
        double heat = 0;                             ///< J
    };
    Stored stored() const;

    /// Columns that the rows of the history end with.
    void annotate(Record columns) { notes_ = std::move(columns); }

    /// The step that this simulation started after: 0, or that of the snapshot.
    int first_step() const { return first_step_; }

    bool finished() const { return state_.step == scene_->time.steps; }

    const State& state() const { return state_; }

    /// What this process has of mesh and space; all of it where it is alone.
    const mesh::Mesh& mesh() const { return part_.mesh; }
    const fem::Space& space() const { return part_.space; }
    const parallel::Part& part() const { return part_; }

    const parallel::Team& team() const { return choice_.strategy->team(); }
    const solve::Strategy& strategy() const { return *choice_.strategy; }
    const std::string& why_strategy() const { return choice_.why; }
    const model::ContactSurfaces& surfaces() const { return surfaces_; }
    model::ContactProbe& probe(std::size_t surface) { return *probes_[surface]; }
    const Totals& totals() const { return totals_; }

    /// Of the last step, in their order; none where steps are not adapted.
    const std::vector<Attempt>& attempts() const { return last_.attempts; }

    /// Those that the scene has: momentum, heat.
    std::vector<Balance*> balances();

    /// Seconds spent in factorisation so far.
    double factor_seconds() const;
    /// How many that were, of both balances.
    int factorisations() const;
    /// That the same steps would have taken, were so many factors of each balance kept.
    int factorisations_keeping(std::size_t factors) const;

    /// Newton iterations that ended as contact states recurred, of both balances, of this simulation.
    int cycles() const;

    /// Where the time of the steps went.
    StepSeconds step_seconds() const;

    /// Unknowns of each field over all processes; 0 for absent physics.
    std::int64_t displacement_unknowns() const {
        return scene_->material ? std::int64_t{part_.numbers.total()} * scene_->dimension : 0;
    }
    std::int64_t temperature_unknowns() const { return scene_->heat ? part_.numbers.total() : 0; }

    /// Of the Cholesky factors of both balances.
    solve::FactorSize factor_size() const;

    /// Unknowns that the contact laws depend on, of both balances, over all processes; every process calls.
    std::int64_t contact_unknowns() const;

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
        int parts = 0, failed_attempts = 0;
        int cycles = 0;            ///< also in attempts that failed
        double smallest_step = 0;  ///< s
        std::vector<Attempt> attempts;
    };
    struct OfField {
        const char* name;
        FieldError error;
        double State::*scale;
    };
    using FieldErrors = std::array<OfField, 4>;

    void initialise();
    void look_for_free_motions();
    void require_held();
    void prepare();
    StepRule rule(const Subdivision& parts) const;
    void solve(const StepRule& rule, StepCounts& counts);
    void settle(const StepRule& rule, Subdivision& parts, StepCounts& counts);
    void accept(const StepRule& rule, StepCounts& counts);
    void enlarge_scales(const FieldErrors& errors);
    void note_failure(const StepRule& rule, StepCounts& counts);
    FieldErrors field_errors() const;
    Attempt measure(const StepRule& rule, const FieldErrors& errors) const;
    void count_attempts(const StepCounts& counts);
    model::Motion stage_motion() const;
    void solve_balances(StepCounts& counts);
    void solve_coupled(StepCounts& counts);
    const parallel::NodeNumbers& numbers_of(const std::string& member) const;
    void take_up(State state);
    void give_up(const State& before, const Subdivision& parts, const std::string& reason);
    void count_step(const StepCounts& counts);

    const scene::Scene* scene_;
    parallel::Part part_;
    fem::NodeGraph graph_;
    model::ContactSurfaces surfaces_;
    StrategyChoice choice_;
    Scheme scheme_;
    std::optional<StepControl> control_;  ///< where steps are adapted
    State state_;
    std::vector<double> no_motion_;  ///< displacement and velocity of a scene without mechanics
    std::vector<double> no_heat_;    ///< temperature of a scene without heat: none
    /// R over M, where heat takes the strain that is known before the step and they are multiples.
    std::optional<double> strain_heat_factor_;
    std::optional<Momentum> momentum_;
    std::optional<Heat> heat_;
    std::vector<std::unique_ptr<model::ContactProbe>> probes_;
    StepCounts last_;
    Record balances_;  ///< of the last step that succeeded
    Totals totals_;
    int first_step_ = 0;
    Record notes_;
    std::vector<std::int64_t> bisections_;
    Legacy spent_;  ///< by those that this one succeeded
};

}  // namespace thermocontact::march
