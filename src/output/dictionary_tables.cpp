// What results hold: a line or two a quantity. Units are those of scenes in space; in the plane forces,
// energies and heat are per metre of thickness.
#include "output/dictionary_tables.h"

#include <string>

namespace thermocontact::output {
namespace {

using Quantities = std::vector<Quantity>;

void append(Quantities& to, const Quantities& more) {
    to.insert(to.end(), more.begin(), more.end());
}

// One paragraph a quantity, not one line a field.
// clang-format off

Quantities how_the_step_went() {
    return {
        {"step", "", "Number of the step, from 1."},
        {"time", "s", "Time at its end."},
        {"newton_iterations", "", "Newton iterations of the momentum balance."},
        {"heat_iterations", "", "Newton iterations of the heat balance."},
        {"retries", "", "Solves beyond the first, of both balances: rungs of the continuation in the regularisation; of heat also "
         "the one that goes on from what the first left."},
        {"solves_at_round_off", "", "Solves that ended above the tolerance because round-off leaves no smaller residual."},
        {"cycles", "", "Newton iterations that were ended because contact states recurred, failed attempts included."},
        {"failed_attempts", "", "Attempts without solution: the step as a whole, or parts of it."},
        {"substeps", "", "Parts in which the step was taken; 1: as a whole."},
        {"rejected_substeps", "", "Adaptive steps that erred too much and were not taken. With time.tolerance."},
        {"smallest_substep", "s", "Smallest part taken or tried. With time.tolerance."},
        {"error_estimate", "", "Largest estimated error that a part taken adds, relative. With time.tolerance."},
    };
}

Quantities energy_columns() {
    return {
        {"velocity_l2", "m/s m^(3/2)", "Norm of the velocity w in L2. With mechanics, as are the following up to force_residual."},
        {"displacement_strain_l2", "m^(3/2)", "Norm of the strain of the displacement, eps(u), in L2."},
        {"kinetic_energy", "J", "rho/2 |w|^2 at the end of the step."},
        {"strain_energy", "J", "1/2 (E eps(u), eps(u)) at the end of the step."},
        {"spring_energy", "J", "1/2 (k_s (u - u_s), u - u_s) at the end of the step; 0 without springs."},
        {"kinetic_numerical_dissipation", "J", "Kinetic energy that the time scheme dissipates by itself in the step."},
        {"strain_numerical_dissipation", "J", "Strain energy that the time scheme dissipates by itself in the step."},
        {"spring_numerical_dissipation", "J", "Energy of springs that the time scheme dissipates by itself in the step."},
        {"viscous_dissipation", "J", "k (V eps(w), eps(w)): what viscosity dissipates in the step; never negative."},
        {"compliance_work", "J", "Work done against the contact pressure in the step."},
        {"friction_dissipation", "J", "What friction dissipates in the step; never negative."},
        {"load_work", "J", "Work of body forces and tractions in the step."},
        {"thermal_work", "J", "Work of the thermal stress in the step."},
        {"reaction_work", "J", "Work of the reactions where the displacement is prescribed; 0 where that does not move."},
        {"foundation_work", "J", "Work that a foundation that moves does by friction in the step; 0 where none moves."},
        {"anchor_work", "J", "Work done in the step by moving the far ends of springs."},
        {"energy_residual", "", "What is lacking in the balance of these energies, over the sum of their magnitudes."},
    };
}

Quantities force_columns() {
    Quantities columns;
    for (const char axis : {'x', 'y', 'z'}) {
        const std::string of = std::string(", component ") + axis + (axis == 'z' ? " (in space)." : ".");
        append(columns, {
            {std::string("inertia_force_") + axis, "N", "Rate of the momentum, mean over the step" + of},
            {std::string("contact_force_") + axis, "N",
             "Force of the body on the foundation, normal and tangential" + of},
            {std::string("spring_force_") + axis, "N", "Force of the body on springs" + of},
            {std::string("load_force_") + axis, "N", "Resultant of body forces and tractions" + of},
            {std::string("reaction_force_") + axis, "N", "Reaction where the displacement is prescribed" + of},
        });
    }
    append(columns, {{"force_residual", "",
                      "What is lacking in inertia + contact + spring = load + reaction, over the nodal magnitudes of these forces."}});
    return columns;
}

Quantities heat_columns() {
    return {
        {"temperature_l2", "K m^(3/2)", "Norm of the temperature in L2. With heat, as are the following up to heat_residual."},
        {"heat_storage_rate", "W", "Rate at which the body stores heat, mean over the step."},
        {"contact_heat_outflow", "W", "Heat that flows through contact into the foundation."},
        {"prescribed_temperature_inflow", "W", "Heat that flows in where the temperature is prescribed."},
        {"load_heat_inflow", "W", "Heat of sources and prescribed fluxes."},
        {"strain_heat_inflow", "W", "Heat of the strain, (R : eps(u), 1)."},
        {"strain_rate_heat_inflow", "W", "Heat of the strain rate, (R' : eps(w), 1)."},
        {"friction_heat_inflow", "W", "The body's share of what friction dissipates."},
        {"convection_heat_outflow", "W", "Heat that convection carries away."},
        {"heat_residual", "",
         "What is lacking in storage + outflow = inflows, over the nodal magnitudes of these flows."},
    };
}

Quantities contact_columns() {
    return {
        {"contact_fraction", "", "Share of all contact surfaces that is closed. With contact, as are the following."},
        {"slip_fraction", "", "Share of all contact surfaces that is closed and slips."},
        {"max_penetration", "m", "Largest penetration at the nodes of all contact surfaces."},
    };
}

Quantities mesh_columns() {
    return {
        {"cells", "", "Cells of the mesh that the step was made on. With mesh.refinement, as are the following."},
        {"mesh_looks", "", "Solutions of the step whose error in space was estimated; all but the last were not accepted."},
        {"error_in_space", "", "The last estimate of the error in space, relative."},
        {"kinetic_energy_of_remeshing", "J", "Kinetic energy that carrying the fields to the step's mesh added."},
        {"strain_energy_of_remeshing", "J", "Strain energy likewise."},
        {"spring_energy_of_remeshing", "J", "Energy of springs likewise."},
        {"heat_of_remeshing", "J", "Heat likewise."},
    };
}

Quantities general_entries() {
    return {
        {"status", "", "\"completed\", \"failed\" or \"interrupted\"."},
        {"version", "", "Of the program, of FFCx and UFL, and a digest of the forms."},
        {"reason", "", "Why the run was not completed. Absent where it was."},
        {"warning", "", "Balances of whose solution rounding leaves fewer than six digits, and those not kept to 1e-8. Absent where there is none."},
        {"physics", "", "List of the physics that the scene switches on."},
        {"mesh.cells", "", "Number of cells."},
        {"mesh.vertices", "", "Number of vertices."},
        {"mesh.unknowns.displacement", "", "Unknowns of the displacement; 0 without mechanics."},
        {"mesh.unknowns.temperature", "", "Unknowns of the temperature; 0 without heat."},
        {"mesh.refinement.looks", "", "Solutions whose error in space was estimated. With mesh.refinement, as are the following."},
        {"mesh.refinement.repeated_steps", "", "Solutions that were not accepted, as the mesh was too coarse."},
        {"mesh.refinement.coarser_meshes", "", "Steps before which cells were joined."},
        {"mesh.refinement.beyond_tolerance", "", "Steps accepted above the tolerance, as limits were met."},
        {"mesh.refinement.largest_error", "", "Largest estimate that was accepted, relative."},
        {"mesh.refinement.last_error", "", "The last estimate."},
        {"mesh.refinement.fewest_cells", "", "Cells of the coarsest mesh of a step."},
        {"mesh.refinement.most_cells", "", "Cells of the finest."},
        {"solver.strategy", "", "The strategy that solved: \"condensed\" or \"newton-krylov\"."},
        {"solver.why", "", "Why that one, with the times and memory foreseen where it was chosen."},
        {"solver.processes", "", "Number of processes."},
        {"solver.factor_entries", "", "Numbers in the Cholesky factors of both balances."},
        {"solver.factor_bytes", "byte", "What is kept of them: columns that parts of a grid have in common once."},
        {"solver.factors.BALANCE.numbers", "", "Precision in which the factor's numbers are stored: \"single\" or \"double\"."},
        {"solver.factors.BALANCE.why", "", "\"single was too coarse\" where corrections did not contract; else empty."},
        {"solver.factors.BALANCE.corrections", "", "Further passes of steps that took a single-precision factor."},
        {"solver.contact_unknowns", "", "Unknowns that the contact laws depend on, of both balances."},
        {"steps", "", "Steps completed."},
        {"restarted_after_step", "", "The step of the checkpoint that the run went on from. Absent without restart."},
    };
}

Quantities final_entries() {
    return {
        {"final.time", "s", "Time of the last step completed; what follows is of that time."},
        {"final.velocity_l2", "m/s m^(3/2)", "Norm of the velocity in L2; 0 without mechanics."},
        {"final.displacement_strain_l2", "m^(3/2)", "Norm of the strain in L2; 0 without mechanics."},
        {"final.temperature_l2", "K m^(3/2)", "Norm of the temperature in L2; 0 without heat."},
        {"final.contact.NAME.normal_force", "N", "Integral of the contact pressure over boundary NAME."},
        {"final.contact.NAME.tangential_force", "N", "Magnitude of the resultant of the tangential traction."},
        {"final.contact.NAME.max_penetration", "m", "Largest penetration at the nodes."},
        {"final.contact.NAME.contact_fraction", "", "Share of the boundary that is closed."},
        {"final.contact.NAME.slip_fraction", "", "Share of the boundary that is closed and slips."},
        {"final.contact.NAME.heat_flow", "W", "Heat that flows into the foundation."},
    };
}

Quantities solving_entries() {
    return {
        {"newton.iterations", "", "Newton iterations of all steps, both balances."},
        {"newton.max_iterations_in_a_step", "", "The most that a step took."},
        {"newton.retries", "", "Solves beyond the first, of all steps: rungs of the continuation; of heat also those that go on from what "
         "the first left."},
        {"recovery.continuation_solves", "", "The same number."},
        {"recovery.solves_at_round_off", "", "Solves that ended above the tolerance because round-off leaves no smaller residual."},
        {"recovery.largest_residual_of_these", "", "Relative; at most 1000 solver.tolerance."},
        {"recovery.cycles", "", "Newton iterations that were ended because contact states recurred."},
        {"recovery.failed_attempts", "", "Steps and parts of steps without solution that were tried again smaller."},
        {"recovery.divided_steps", "", "Steps that were taken in parts."},
        {"recovery.substeps_of_these", "", "Those parts."},
        {"recovery.smallest_step", "s", "Smallest step or part, accepted or failed."},
        {"adaptive.accepted", "", "Adaptive steps taken. With time.tolerance, as are the following four."},
        {"adaptive.rejected", "", "Adaptive steps that erred too much."},
        {"adaptive.beyond_tolerance", "", "Taken though they did, as there are no shorter ones."},
        {"adaptive.sum_of_estimates", "", "Sum of the estimated errors of those taken, relative."},
        {"adaptive.factorisations", "", "Factorisations of both balances."},
        {"audit.energy", "", "Largest energy_residual of all steps."},
        {"audit.heat", "", "Largest heat_residual of all steps."},
        {"audit.force", "", "Largest force_residual of all steps."},
        {"conditioning.BALANCE", "", "null where there are no factors to tell (newton-krylov, no step solved)."},
        {"conditioning.BALANCE.condition", "", "Skeel's condition number of the last step's system, for its solution."},
        {"conditioning.BALANCE.contact_condition", "", "That of the condensed Newton matrix of the contact unknowns."},
        {"conditioning.BALANCE.digits", "", "Digits that rounding leaves of the last step's solution."},
    };
}

Quantities cost_entries() {
    return {
        {"seconds.start", "s", "Before the scene is read: loading the program, MPI and PETSc."},
        {"seconds.setup", "s", "Mesh, spaces, operators."},
        {"seconds.factor", "s", "Factorisations."},
        {"seconds.steps", "s", "Steps, without factorisations."},
        {"seconds.output", "s", "Results and checkpoints."},
        {"seconds.total", "s", "Since the start of the process; the five above add up to it."},
        {"seconds.parts.triangular_solves", "s", "Of the steps: passes through the sparse factors."},
        {"seconds.parts.newton", "s", "Of the steps: the nonlinear contact problems."},
        {"seconds.parts.audit", "s", "Of the steps: operators on the new state, balances, norms."},
        {"seconds.parts.other", "s", "Of the steps: the rest."},
        {"peak_memory_mib", "MiB", "Largest memory, the sum over all processes."},
    };
}

Quantities plan_entries() {
    return {
        {"plan.of", "", "What was to be accurate (--of). With --accuracy or --budget, as is all of plan."},
        {"plan.components", "", "List of the quantities whose errors are judged."},
        {"plan.accuracy", "", "The relative error asked for. Absent where none was."},
        {"plan.budget", "s", "The time asked for. Absent where none was."},
        {"plan.predicted.error", "", "Largest relative error foreseen."},
        {"plan.predicted.seconds", "s", "Time foreseen."},
        {"plan.predicted.unknowns", "", "Unknowns of the discretisation chosen."},
        {"plan.predicted.degree", "", "Its polynomial degree."},
        {"plan.predicted.mesh", "", "Its kind of mesh: the scene's cells of a degree, or tensor cells graded toward sides."},
        {"plan.predicted.scale", "", "Its cells along each axis, over those of the coarsest pilot."},
        {"plan.predicted.stepping", "", "Its time scheme."},
        {"plan.predicted.steps", "", "Its number of steps."},
        {"plan.predicted.error_in_space", "", "List, by component: relative errors of the mesh."},
        {"plan.predicted.error_in_time", "", "List, by component: relative errors of the steps."},
        {"plan.achieved.seconds", "s", "Time that the run took."},
        {"plan.achieved.error", "", "Largest relative error, estimated from a run of half the cells and steps. Absent where that did not end."},
        {"plan.achieved.errors", "", "List of these, by component. Absent likewise."},
        {"plan.instead.error", "", "Where the run missed what was asked: the error foreseen of what would meet it. Else absent."},
        {"plan.instead.seconds", "s", "Its time. Absent likewise."},
        {"plan.instead.settings", "", "List of what to set for it: KEY=VALUE. Absent likewise."},
        {"plan.settings", "", "List of what was set: KEY=VALUE."},
        {"plan.pilots.runs", "", "Number of pilots."},
        {"plan.pilots.seconds", "s", "Time that they took."},
        {"plan.remarks", "", "List of what limits the plan."},
    };
}

}  // namespace

Quantities history_columns() {
    Quantities all = how_the_step_went();
    for (const Quantities& more : {energy_columns(), force_columns(), heat_columns(), contact_columns(), mesh_columns()}) {
        append(all, more);
    }
    return all;
}

Quantities steps_columns() {
    return {
        {"step", "", "The scene's step that the attempt belongs to."},
        {"time", "s", "Time at the end of the attempt."},
        {"size", "s", "Its length."},
        {"error_estimate", "", "What it adds to the error, relative; empty where no solution was found."},
        {"field", "", "What errs most: displacement, deformation, velocity or temperature; empty where nothing is known to."},
        {"outcome", "", "accepted; trial: the first of all, to see how large the fields become; rejected; "
         "beyond-tolerance: taken though it errs too much, as there is no shorter one; failed: no solution."},
    };
}

Quantities body_fields() {
    return {
        {"displacement", "m", "Displacement u at the nodes.", 3},
        {"velocity", "m/s", "Velocity w at the nodes.", 3},
        {"temperature", "K", "Temperature at the nodes."},
        {"stress", "Pa", "Stress, mean over each cell: xx, yy, zz, xy, yz, xz.", 6},
        {"von_mises", "Pa", "Von Mises stress of that mean."},
    };
}

Quantities contact_fields() {
    return {
        {"boundary", "", "Of each facet: which contact boundary it is of, counted from 0 in the order of the alphabet."},
        {"state", "", "0 open, 1 closed and sticking, 2 closed and slipping: |slip_velocity| above friction.regularisation."},
        {"gap", "m", "Distance to the foundation, g - u.n; negative where the body penetrates."},
        {"pressure", "Pa", "Contact pressure p_n. With compliance."},
        {"traction", "Pa", "Tangential traction of the foundation on the body. With friction.", 3},
        {"slip_velocity", "m/s", "Tangential velocity over the foundation. With mechanics.", 3},
        {"heat_flow", "W/m^2", "Heat that flows into the foundation. With conductance."},
    };
}

Quantities summary_entries() {
    Quantities all = general_entries();
    for (const Quantities& more :
         {final_entries(), solving_entries(), cost_entries(), plan_entries()}) {
        append(all, more);
    }
    return all;
}

Quantities summary_opened_entries() {
    return {{"scene", "", "Every key of the scene that is in force, defaults included, as tables."}};
}

// clang-format on

}  // namespace thermocontact::output
