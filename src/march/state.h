/// The unknowns at one instant, and what a step reports about them.
#pragma once

#include <array>
#include <concepts>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace thermocontact::march {

using Nodal = std::vector<double>;  ///< [nodes][components]

constexpr int course_order = 3;  ///< of the polynomial that continues a field
using PastValues = std::array<Nodal, course_order>;

/// Nodal fields of absent physics are empty.
struct State {
    int step = 0;
    double time = 0;     ///< s
    Nodal displacement;  ///< u, m
    Nodal velocity;      ///< w, m/s
    Nodal temperature;   ///< theta, K
    /// What exact friction ended the step with, [facets of the mesh][numbers] (friction_multiplier.h), Pa;
    /// empty without.
    std::vector<double> friction_multiplier;

    /// The rates that the next step begins with (step_rule.h), of the three fields; empty where the scheme
    /// takes none, and before the first step.
    double last_step = 0;  ///< size of the step that left them, s; 0: there are none
    Nodal displacement_rate, velocity_rate, temperature_rate;

    /// Where the fields are coming from (course.h): values at the begins of the last steps, the latest first;
    /// empty where no strategy asks.
    double even_step = 0;  ///< size of the last steps, s
    int even_steps = 0;    ///< how many were that long, up to what course.h has a use for
    PastValues past_velocity, past_temperature;

    /// What the control of adaptive steps goes on with (step_error.h, step_control.h); unused without.
    int halvings = 0;          ///< of the scene's step, to the size that is tried next
    int since_change = 0;      ///< steps accepted at this size
    double curvature_lag = 0;  ///< how long before `time` the curvatures hold, s; 0: there are none
    Nodal displacement_curvature, velocity_curvature, temperature_curvature;
    /// Largest sizes so far, which errors are relative to.
    double displacement_scale = 0, deformation_scale = 0, velocity_scale = 0, temperature_scale = 0;

    /// Likewise of the estimates of the error in space (model/error_in_space.h).
    double deformation_energy = 0, heat_energy = 0;
};

/// Calls visit(name, member) for all that a state holds, numbers and nodal fields: what a checkpoint stores
/// and a restart takes up. A member that is missing here does not compile.
template <typename AnyState, typename Visit>
requires std::same_as<std::remove_const_t<AnyState>, State>
void visit_members(AnyState& state, Visit&& visit) {
    auto& [step, time, displacement, velocity, temperature, friction_multiplier, last_step, displacement_rate,
           velocity_rate, temperature_rate, even_step, even_steps, past_velocity, past_temperature, halvings,
           since_change, curvature_lag, displacement_curvature, velocity_curvature, temperature_curvature,
           displacement_scale, deformation_scale, velocity_scale, temperature_scale, deformation_energy,
           heat_energy] = state;
    visit("step", step);
    visit("time", time);
    visit("displacement", displacement);
    visit("velocity", velocity);
    visit("temperature", temperature);
    visit("friction_multiplier", friction_multiplier);
    visit("last_step", last_step);
    visit("displacement_rate", displacement_rate);
    visit("velocity_rate", velocity_rate);
    visit("temperature_rate", temperature_rate);
    visit("even_step", even_step);
    visit("even_steps", even_steps);
    for (std::size_t i = 0; i < course_order; ++i) {
        visit("velocity_" + std::to_string(i + 1) + "_before", past_velocity[i]);
        visit("temperature_" + std::to_string(i + 1) + "_before", past_temperature[i]);
    }
    visit("halvings", halvings);
    visit("since_change", since_change);
    visit("curvature_lag", curvature_lag);
    visit("displacement_curvature", displacement_curvature);
    visit("velocity_curvature", velocity_curvature);
    visit("temperature_curvature", temperature_curvature);
    visit("displacement_scale", displacement_scale);
    visit("deformation_scale", deformation_scale);
    visit("velocity_scale", velocity_scale);
    visit("temperature_scale", temperature_scale);
    visit("deformation_energy", deformation_energy);
    visit("heat_energy", heat_energy);
}

/// Totals over the steps so far.
struct Totals {
    int iterations = 0;
    int max_iterations_in_a_step = 0;
    int retries = 0;                ///< solves of a balance beyond the first: continuation
    int divided_steps = 0;          ///< steps that were taken in parts
    int parts = 0;                  ///< those parts
    int failed_attempts = 0;        ///< steps and parts that failed before
    double smallest_step = 0;       ///< accepted or failed, s; 0: none yet
    int accepted = 0;               ///< adaptive steps taken
    int rejected = 0;               ///< adaptive steps that erred too much
    int beyond_tolerance = 0;       ///< taken though they did: there are no shorter ones
    int at_round_off = 0;           ///< solves that ended at round-off beyond the tolerance (newton.h)
    double round_off_residual = 0;  ///< the largest residual of these, relative
    int cycles = 0;                 ///< Newton iterations that ended as contact states recurred (cycle.h)
    double error_sum = 0;           ///< of the estimates of those taken, relative
    double energy_residual = 0, heat_residual = 0, force_residual = 0;  ///< largest, relative

    // of an adapted mesh
    int looks = 0;                         ///< estimates of the error in space after a step
    int repeated_steps = 0;                ///< solutions that were not accepted: the mesh was too coarse
    int coarser_meshes = 0;                ///< steps before which cells were joined
    int beyond_mesh_tolerance = 0;         ///< steps looked at and accepted all the same: limits are met
    double error_in_space = 0;             ///< largest estimate that was accepted, relative
    double last_error_in_space = 0;        ///< the last one
    int fewest_cells = 0, most_cells = 0;  ///< of the meshes of the steps
};

/// The same for the totals.
template <typename AnyTotals, typename Visit>
requires std::same_as<std::remove_const_t<AnyTotals>, Totals>
void visit_members(AnyTotals& totals, Visit&& visit) {
    auto& [iterations, most, retries, divided, parts, failed, smallest, accepted, rejected, beyond,
           at_round_off, round_off_residual, cycles, error_sum, energy, heat, force, looks, repeated, coarser,
           beyond_mesh, error_in_space, last_error_in_space, fewest_cells, most_cells] = totals;
    visit("iterations", iterations);
    visit("max_iterations_in_a_step", most);
    visit("retries", retries);
    visit("divided_steps", divided);
    visit("parts", parts);
    visit("failed_attempts", failed);
    visit("smallest_step", smallest);
    visit("accepted", accepted);
    visit("rejected", rejected);
    visit("beyond_tolerance", beyond);
    visit("at_round_off", at_round_off);
    visit("round_off_residual", round_off_residual);
    visit("cycles", cycles);
    visit("error_sum", error_sum);
    visit("energy_residual", energy);
    visit("heat_residual", heat);
    visit("force_residual", force);
    visit("looks", looks);
    visit("repeated_steps", repeated);
    visit("coarser_meshes", coarser);
    visit("beyond_mesh_tolerance", beyond_mesh);
    visit("error_in_space", error_in_space);
    visit("last_error_in_space", last_error_in_space);
    visit("fewest_cells", fewest_cells);
    visit("most_cells", most_cells);
}

/// How a nonlinear solve went.
struct SolveReport {
    int iterations = 0;
    int retries = 0;                ///< solves beyond the first
    int at_round_off = 0;           ///< solutions whose residual is beyond the tolerance, but round-off
    double round_off_residual = 0;  ///< the largest of these residuals, relative

    void add(const SolveReport& other) {
        iterations += other.iterations;
        retries += other.retries;
        at_round_off += other.at_round_off;
        round_off_residual = std::max(round_off_residual, other.round_off_residual);
    }
};

/// Where the time of the steps went, s.
struct StepSeconds {
    double triangular_solves = 0;  ///< both passes through the sparse factors
    double newton = 0;             ///< the condensed nonlinear problems
    double audit = 0;              ///< operators on the new state, balances, norms

    void add(const StepSeconds& other) {
        triangular_solves += other.triangular_solves;
        newton += other.newton;
        audit += other.audit;
    }
};

/// Named numbers of a step, in the order of the history's columns.
using Record = std::vector<std::pair<std::string, double>>;

}  // namespace thermocontact::march
