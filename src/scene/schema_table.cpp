// The table of scene keys. `example` is a value that is valid beside the other keys' examples.

#include <algorithm>

#include "scene/law_keys.h"

namespace thermocontact::scene {

namespace {

constexpr Range positive{.low = 0, .low_open = true};
constexpr Range not_negative{.low = 0};

Range from_to(double low, double high) {
    return {.low = low, .high = high};
}

// One paragraph a key, not one line a field.
// clang-format off

Key graded_side(const std::string& name, int axis) {
    const std::string sides = axis == 2 ? " of a box" : "";
    return {.name = "mesh.grading." + name, .type = Type::number, .range = {.low = 1}, .fallback = "1.0",
            .instead = "mesh.file", .example = "4.0",
            .description = "Size of the largest cell along the axis over that of the cell at the side " + name +
            sides + ", from which the sizes grow geometrically: to the opposite side, or where that is graded too, to "
            "where both meet. It holds in the limit of many cells: twice as many cut each of them in two."};
}

std::vector<Key> general_keys() {
    return {
        {.name = "title", .type = Type::text, .fallback = R"("")", .example = R"("sliding block")",
         .description = "Title of the scene, repeated in the results."},

        {.name = "mesh.shape", .type = Type::choice, .choices = {"rectangle", "box"},
         .fallback = R"("rectangle")", .instead = "mesh.file", .example = R"("rectangle")",
         .description = "Shape of the body; its sides are named left, right, bottom, top and, of a box, front "
         "(lower z) and back (upper z)."},
        {.name = "mesh.lower", .type = Type::numbers, .unit = "m", .fallback = "0.0", .instead = "mesh.file",
         .example = "[-1.0, 0.0]", .description = "Corner of lowest coordinates."},
        {.name = "mesh.upper", .type = Type::numbers, .unit = "m", .fallback = "1.0", .instead = "mesh.file",
         .example = "[2.0, 1.5]", .description = "Corner of highest coordinates."},
        {.name = "mesh.cells", .type = Type::integers, .range = from_to(1, 1e8), .required = true,
         .instead = "mesh.file", .example = "[8, 4]",
         .description = "Number of quadrilaterals or hexahedra along each axis; simplices split them."},
        {.name = "mesh.diagonal", .type = Type::choice, .choices = {"right", "left", "crossed"},
         .fallback = R"("right")", .instead = "mesh.file", .example = R"("crossed")",
         .description = "Diagonal that splits the squares of a rectangle into triangles: right from lower left "
         "to upper right, left the other, crossed both."},
        {.name = "mesh.cell", .type = Type::choice, .choices = {"simplex", "tensor"},
         .fallback = R"("simplex")", .instead = "mesh.file", .example = R"("simplex")",
         .description = "Kind of cells: simplex for triangles and tetrahedra, tensor for quadrilaterals and "
         "hexahedra."},
        {.name = "mesh.file", .type = Type::text, .example = R"("part.msh")",
         .description = "Gmsh file, sought from the scene's folder, in place of a shape: cells of one kind, whose "
         "physical groups name the boundaries and the regions."},
        graded_side("left", 0), graded_side("right", 0), graded_side("bottom", 1), graded_side("top", 1),
        graded_side("front", 2), graded_side("back", 2),
        {.name = "mesh.refinement.tolerance", .type = Type::number,
         .range = {.low = 0, .high = 1, .low_open = true, .high_open = true}, .required = true, .example = "0.05",
         .description = "Adapt the mesh, of triangles or tetrahedra: the error in space, estimated by recovered "
         "gradients in the norms of energy, that deformation and temperature may have relative to their largest size "
         "so far. Cells are bisected where it takes that, and joined again. Absent: the mesh stays as it is."},
        {.name = "mesh.refinement.every", .type = Type::integer, .range = from_to(1, 1e9), .fallback = "5",
         .example = "2",
         .description = "Steps from one look at the mesh to the next; the first is looked at. A step whose error is "
         "too large is repeated on a finer mesh."},
        {.name = "mesh.refinement.max_cells", .type = Type::integer, .range = from_to(1, 1e8),
         .fallback = "200000", .example = "20000",
         .description = "Most cells of an adapted mesh; where they do not do, the run goes on and its summary says "
         "so."},
        {.name = "mesh.refinement.max_level", .type = Type::integer, .range = from_to(0, 60), .fallback = "30",
         .example = "12",
         .description = "How often a cell of the scene's mesh is bisected at most; neighbours may need a few more. "
         "Two bisections halve a triangle's edges, three a tetrahedron's."},

        {.name = "space.degree", .type = Type::integer, .range = from_to(1, 2), .fallback = "1",
         .example = "2", .description = "Polynomial degree of displacement and temperature."},

        {.name = "time.end", .type = Type::number, .unit = "s", .range = positive, .required = true,
         .example = "2.0", .description = "Time at which the run ends; it begins at 0."},
        {.name = "time.steps", .type = Type::integer, .range = from_to(1, 1e9), .required = true,
         .instead = "time.step", .example = "20", .description = "Number of equal time steps."},
        {.name = "time.step", .type = Type::number, .unit = "s", .range = positive, .required = true,
         .instead = "time.steps", .example = "0.125",
         .description = "Length of a time step; it must divide the end time."},
        {.name = "time.scheme", .type = Type::choice,
         .choices = {"backward-euler", "bdf2", "midpoint", "generalized-alpha"},
         .fallback = R"("backward-euler")", .example = R"("generalized-alpha")",
         .description = "Time integration scheme; all but backward-euler, the paper's, are of second order."},
        {.name = "time.tolerance", .type = Type::number, .range = {.low = 0, .high = 0.1, .low_open = true},
         .example = "1e-3",
         .description = "Adapt the steps: what one may add to the error of displacement, deformation, velocity or "
         "temperature, relative to its largest size so far. The steps given are taken whole or in parts of 1/2, 1/4, "
         "... 1/256; not for midpoint. Absent: equal steps."},
        {.name = "time.spectral_radius", .type = Type::number, .range = from_to(0, 1), .fallback = "0.5",
         .needs = {"time.scheme"}, .example = "0.8",
         .description = "Of generalized-alpha at infinite frequency: 0 damps fast motions at once (as bdf2), 1 "
         "never (as midpoint)."},
        {.name = "time.coupling", .type = Type::choice, .choices = {"lagged", "iterated"},
         .fallback = R"("lagged")", .needs = {"material", "heat"}, .example = R"("iterated")",
         .description = "Momentum and heat balance: once each with what is known of the other field before the "
         "step, or in turn until the temperature no longer changes."},
        {.name = "time.coupling_tolerance", .type = Type::number,
         .range = {.low = 0, .high = 1e-1, .low_open = true}, .fallback = "1e-10", .needs = {"time.coupling"},
         .example = "1e-6",
         .description = "Relative change of the temperature at which iterated coupling has converged."},
    };
}

std::vector<Key> material_keys() {
    return {
        {.name = "material.density", .type = Type::number, .unit = "kg/m^3", .range = positive,
         .example = "7850.0", .description = "Mass density; absent: quasi-static."},

        {.name = "material.elasticity.plane", .type = Type::choice, .choices = {"stress", "strain"},
         .fallback = R"("stress")", .instead = "material.elasticity.tensor", .example = R"("strain")",
         .description = "Plane stress (thin body) or plane strain (long body); in 2D only."},
        {.name = "material.elasticity.tensor", .type = Type::voigt_tensor, .unit = "Pa",
         .example = "[[3.0, 1.0, 0.0], [1.0, 3.0, 0.0], [0.0, 0.0, 1.0]]",
         .description = "Elasticity as Voigt matrix for (e_xx, e_yy, 2 e_xy), in 3D for (e_xx, e_yy, e_zz, 2 e_yz, "
         "2 e_xz, 2 e_xy), in place of young and poisson."},

        {.name = "material.viscosity.tensor", .type = Type::voigt_tensor, .unit = "Pa s",
         .example = "[[20.0, 10.0, 0.0], [10.0, 20.0, 0.0], [0.0, 0.0, 5.0]]",
         .description = "Viscosity as Voigt matrix, ordered like that of elasticity, in place of trace and shear."},

        {.name = "heat.capacity", .type = Type::number, .unit = "J/(m^3 K)", .range = positive,
         .example = "3.6e6", .description = "Heat capacity per volume; absent: stationary heat conduction."},
        {.name = "heat.conductivity", .type = Type::semidefinite_tensor, .unit = "W/(m K)",
         .example = "[[2.0, 0.5], [0.5, 1.0]]",
         .description = "Thermal conductivity; a number means isotropic."},
        {.name = "heat.source", .type = Type::expression, .unit = "W/m^3", .example = R"("1.0 + x*t")",
         .description = "Heat produced per volume."},
        {.name = "heat.thermal_stress", .type = Type::symmetric_tensor, .unit = "Pa/K", .needs = {"material"},
         .example = "[[1.0, 0.5], [0.5, 1.0]]",
         .description = "M in the stress -theta M of a temperature theta; a number means isotropic."},
        {.name = "heat.strain_heating", .type = Type::symmetric_tensor, .unit = "W/m^3", .needs = {"material"},
         .example = "1.5",
         .description = "R in the heat R : e(u) produced per volume by a strain e(u); a number means "
         "isotropic."},
        {.name = "heat.strain_rate_heating", .type = Type::symmetric_tensor, .unit = "J/m^3", .needs = {"material"},
         .example = "-0.5",
         .description = "R' in the heat R' : e(w) produced per volume by a strain rate e(w); a number means isotropic. "
         "Thermoelasticity has R' = -theta_0 M, theta_0 the absolute temperature."},

        {.name = "load.body_force", .type = Type::expressions, .unit = "N/m^3", .needs = {"material"},
         .example = R"toml([0.0, "-9.81*min(t, 1)"])toml", .description = "Force per volume."},

        {.name = "initial.displacement", .type = Type::expressions, .unit = "m", .needs = {"material"},
         .example = R"(["0.01*x", 0.0])", .description = "Displacement at time 0; absent: zero."},
        {.name = "initial.velocity", .type = Type::expressions, .unit = "m/s", .needs = {"material.density"},
         .example = R"([0.0, "-1"])", .description = "Velocity at time 0; absent: zero."},
        {.name = "initial.temperature", .type = Type::expression, .unit = "K", .needs = {"heat"},
         .example = R"("20 + y")", .description = "Temperature at time 0; absent: zero."},
    };
}

std::vector<Key> prescribed_keys() {
    return {
        {.name = "boundary.NAME.displacement", .type = Type::free_expressions, .unit = "m",
         .needs = {"material"}, .example = R"(["free", "-0.01*t"])",
         .description = "Prescribed displacement; a component may be left \"free\"."},
        {.name = "boundary.NAME.traction", .type = Type::expressions, .unit = "Pa", .needs = {"material"},
         .example = R"toml([1.4, "0.4*cos(pi*t)"])toml", .description = "Force per area on the boundary."},
        {.name = "boundary.NAME.temperature", .type = Type::expression, .unit = "K",
         .excludes = {"boundary.NAME.heat_flux", "boundary.NAME.convection", "boundary.NAME.contact.conductance"},
         .needs = {"heat"},
         .example = R"("10*t")", .description = "Prescribed temperature, from the first step on."},
        {.name = "boundary.NAME.heat_flux", .type = Type::expression, .unit = "W/m^2", .needs = {"heat"},
         .example = "5.0", .description = "Heat that flows into the body per area."},
        {.name = "boundary.NAME.spring.stiffness", .type = Type::semidefinite_tensor, .unit = "N/m^3", .required = true,
         .needs = {"material"}, .example = "[[50.0, 0.0], [0.0, 200.0]]",
         .description = "k_s in the traction -k_s (u - u_s) of springs that hold the boundary, per area; a number means "
         "the same in all directions, a matrix acts on the components."},
        {.name = "boundary.NAME.spring.anchor", .type = Type::expressions, .unit = "m",
         .needs = {"material"}, .example = R"(["0.1*t", 0.0])",
         .description = "Displacement u_s of the springs' far ends from where they are at rest with the undeformed body; "
         "the springs follow it. Absent: fixed."},
        {.name = "boundary.NAME.convection.coefficient", .type = Type::number, .unit = "W/(m^2 K)",
         .range = not_negative, .required = true, .needs = {"heat"}, .example = "10.0",
         .description = "h in the heat h (theta - theta_a) that the boundary gives to its surroundings per area."},
        {.name = "boundary.NAME.convection.ambient_temperature", .type = Type::expression, .unit = "K",
         .required = true, .needs = {"heat"}, .example = R"toml("20 + 5*sin(t)")toml",
         .description = "Temperature theta_a of the surroundings."},

        {.name = "boundary.NAME.contact.gap", .type = Type::expression, .unit = "m", .fallback = "0.0",
         .example = R"("0.001*x^2")", .description = "Initial gap between the boundary and the foundation."},
        {.name = "boundary.NAME.contact.quadrature", .type = Type::integer_or_choice, .range = from_to(1, 9),
         .choices = {"vertex"}, .fallback = "4", .example = R"("vertex")",
         .description = "Degree up to which the Gauss rule of contact integrals is exact, or vertex for the "
         "rule at the facet's nodes (on triangles of degree 2 the midpoints of the edges: the corners would have "
         "weight 0)."},
    };
}

/// What the weak forms of contact take beside their laws' parameters.
std::vector<Key> contact_keys() {
    return {
        {.name = "boundary.NAME.contact.foundation_velocity", .type = Type::expressions, .unit = "m/s",
         .needs = {"boundary.NAME.contact.friction"}, .example = R"(["-2*y", "2*x"])",
         .description = "Velocity of the foundation below the place x, y, z, which friction acts against; only its part "
         "along the boundary counts. A disc that turns about z has (-omega*(y - y0), omega*(x - x0), 0). Absent: at "
         "rest."},

        {.name = "boundary.NAME.contact.friction.regularisation", .type = Type::number, .unit = "m/s",
         .range = not_negative, .required = true, .needs = {"boundary.NAME.contact.compliance"},
         .example = "1e-4",
         .description = "Slip velocity epsilon below which friction is smoothed; 0: Coulomb's law itself, with "
         "contact.quadrature 1, 2, 4 or vertex."},
        {.name = "boundary.NAME.contact.friction.heat_share", .type = Type::number, .range = from_to(0, 1),
         .needs = {"boundary.NAME.contact.compliance", "heat"}, .example = "0.5",
         .description = "Share of what friction dissipates that heats the body; the foundation, whose temperature is "
         "given, takes the rest. Absent: none."},

        {.name = "boundary.NAME.contact.conductance.foundation_temperature", .type = Type::expression,
         .unit = "K", .required = true, .needs = {"heat"}, .example = R"toml("10*min(t, 1)")toml",
         .description = "Temperature of the foundation."},
    };
}

std::vector<Key> forms_keys() {
    std::vector<Key> keys;
    for (const std::string& kind : law_kinds()) {
        keys.push_back({.name = "forms." + kind, .type = Type::text, .example = "\"my_" + kind + ".py\"",
                        .description = "Law file of UFL in place of the scene's own, sought from the scene's folder: "
                        "its parameters are the keys of [" + table_of_law(kind) + "]. The command forms prints "
                        "one to start from."});
    }
    return keys;
}

std::vector<Key> run_keys() {
    return {
        {.name = "solver.strategy", .type = Type::choice, .choices = {"auto", "condensed", "newton-krylov"},
         .fallback = R"("auto")", .example = R"("condensed")",
         .description = "How a step's nonlinear problem is solved: condensed reduces it to the contact "
         "unknowns."},
        {.name = "solver.factor", .type = Type::choice, .choices = {"auto", "double", "single"},
         .fallback = R"("auto")", .example = R"("single")",
         .description = "Bits of a number in the condensed strategy's factors, 64 or 32: single corrects each "
         "solution until it is as good as with double, auto takes it where double does not fit in memory."},
        {.name = "solver.tolerance", .type = Type::number,
         .range = {.low = 0, .high = 1e-2, .low_open = true}, .fallback = "1e-12", .example = "1e-10",
         .description = "Relative residual at which a nonlinear solve has converged."},
        {.name = "solver.max_iterations", .type = Type::integer, .range = from_to(1, 1e5), .fallback = "50",
         .example = "80", .description = "Largest number of iterations of one Newton solve."},

        {.name = "output.every", .type = Type::integer, .range = from_to(1, 1e9), .fallback = "1",
         .example = "5",
         .description = "Steps between field outputs; the first and the last state are always written."},
        {.name = "output.fields", .type = Type::choices,
         .choices = {"displacement", "velocity", "temperature", "stress", "von_mises", "contact"},
         .example = R"(["displacement", "stress"])",
         .description = "Fields to write; absent: all that the scene has, empty list: no field files."},
        {.name = "output.checkpoint_every", .type = Type::integer, .range = from_to(1, 1e9), .example = "100",
         .description = "Steps between checkpoints; absent: as often as takes no more than a fiftieth of the "
         "time. The first and the last state are always written, also of a run that fails or is interrupted."},
    };
}

// clang-format on

}  // namespace

std::vector<Key> keys_beside_laws() {
    std::vector<Key> all;
    for (const auto& group :
         {general_keys(), material_keys(), forms_keys(), prescribed_keys(), contact_keys(), run_keys()}) {
        all.insert(all.end(), group.begin(), group.end());
    }
    return all;
}

}  // namespace thermocontact::scene
