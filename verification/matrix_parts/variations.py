"""The table of plane bodies: for every key of the schema the values that are tried. coverage.py says what must be in
it, variations_in_space.py has the one of bodies in space."""

from matrix_parts.body_law_files import body_law_files
from matrix_parts.cases import Variation, vary
from matrix_parts.scenes import ABSENT, SIDES
from matrix_parts.values import (
    CONDUCTOR,
    CONTACT,
    COUPLING,
    DEFAULT,
    ELASTIC_TENSOR,
    FILES_ONLY,
    ISOTROPIC,
    NAME_ONLY,
    SINGULAR,
    SOLVER_ONLY,
    VISCOUS_TENSOR,
)
from matrix_parts.variations_of_contact import (
    contact_on,
    every_rule,
    exact_friction,
    heat_of_friction,
    law_files,
)
from matrix_parts.variations_of_sides import conditions, held_by_convection, on_springs

ALIKE = dict.fromkeys(("mesh.grading.front", "mesh.grading.back"), "boxes only")


def _mesh_and_time() -> dict[str, list[Variation]]:
    return {
        "title": vary(CONTACT, "title", "another title", same=NAME_ONLY),
        "mesh.shape": vary(CONTACT, "mesh.shape", "rectangle", same=DEFAULT),
        "mesh.lower": vary(CONTACT, "mesh.lower", [0.0, 0.0], same=DEFAULT)
        + vary(CONTACT, "mesh.lower", [-0.3, 0.1]),
        "mesh.upper": vary(CONTACT, "mesh.upper", ABSENT, [1.3, 0.9])
        + vary("contact left", "mesh.upper", [0.6, 1.1]),
        "mesh.cells": vary(CONTACT, "mesh.cells", [1, 1], [6, 5], [3, 4]),
        "mesh.diagonal": vary(CONTACT, "mesh.diagonal", "right", same=DEFAULT)
        + vary(CONTACT, "mesh.diagonal", "left", "crossed")
        + vary("contact right", "mesh.diagonal", "left", "crossed", beside={"space.degree": 2}),
        "mesh.cell": vary(CONTACT, "mesh.cell", "simplex", same=DEFAULT)
        + vary(CONTACT, "mesh.cell", "tensor")
        + vary("contact left", "mesh.cell", "tensor", beside={"space.degree": 2}),
        **_grading(),
        **_refinement(),
        "space.degree": vary(CONTACT, "space.degree", 1, same=DEFAULT)
        + [Variation(base, {"space.degree": 2}) for base in (CONTACT, "contact left", "coupled", "heat")],
        "time.end": vary(CONTACT, "time.end", 0.45),
        "time.steps": vary(CONTACT, "time.steps", 1, 5),
        "time.step": vary(CONTACT, "time.step", 0.06, beside={"time.steps": ABSENT}),
        **_schemes(),
    }


def _grading() -> dict[str, list[Variation]]:
    """Each side alone; both of an axis alike and not, and so near 1 that formulas divide 0 by 0; every cell and node."""
    left, right, bottom, top = (f"mesh.grading.{side}" for side in SIDES["rectangle"])
    crossed = {"mesh.diagonal": "crossed"}
    second = {"space.degree": 2}
    return {
        left: vary(CONTACT, left, 1.0, same=DEFAULT)
        + vary(CONTACT, left, 3.0)
        + vary("contact left", left, 5, beside={**crossed, **second, bottom: 2.0}),
        right: vary(CONTACT, right, 1, same=DEFAULT)
        + vary(CONTACT, right, 1 + 1e-14, same="uniform to round-off")
        + vary("contact right", right, 4.0, beside={left: 2.0, "mesh.diagonal": "left"}),
        bottom: vary(CONTACT, bottom, 1.0, same=DEFAULT)
        + vary(CONTACT, bottom, 40.0)
        + vary("contact without heat", bottom, 3.0, beside={**crossed, top: 3.0}),
        top: vary(CONTACT, top, 1.0, same=DEFAULT)
        + vary("contact top", top, 3.0, beside={"mesh.cell": "tensor", **second})
        + vary("heat", top, 6.0, beside={left: 3.0, right: 3.0, **second}),
    }


def _refinement() -> dict[str, list[Variation]]:
    """Meshes that change before the first step and later, of each scheme, degree and diagonal; limits that stop them."""
    tolerance, every, cells, level = (
        f"mesh.refinement.{key}" for key in ("tolerance", "every", "max_cells", "max_level")
    )
    often, rough = {every: 1}, {tolerance: 0.2}
    second = {"space.degree": 2}
    return {
        tolerance: [
            *vary(CONTACT, tolerance, 0.2),
            *vary("contact left", tolerance, 0.1, beside={**often, "mesh.diagonal": "crossed"}),
            *vary("contact without heat", tolerance, 0.15, beside={**often, "time.scheme": "bdf2"}),
            *vary("heat", tolerance, 0.03, beside={**often, **second, "mesh.diagonal": "left"}),
            *vary(CONTACT, tolerance, 0.1, beside={**often, **second, "time.scheme": "generalized-alpha"}),
            *vary(
                CONTACT, tolerance, 0.2, beside={**often, "mesh.grading.left": 4.0, "time.tolerance": 1e-2}
            ),
            *vary(CONTACT, tolerance, 0.99, same="the mesh does"),
        ],
        every: vary(CONTACT, every, 1, 2, beside=rough),
        cells: vary(CONTACT, cells, 1, beside=rough, same="no mesh is so small")
        + vary(CONTACT, cells, 60, beside=rough),
        level: vary(CONTACT, level, 0, beside=rough, same="no cell is bisected")
        + vary(CONTACT, level, 1, beside=rough),
    }


def _schemes() -> dict[str, list[Variation]]:
    scheme, radius, limit = "time.scheme", "time.spectral_radius", "time.tolerance"
    coupling, tolerance = "time.coupling", "time.coupling_tolerance"
    alpha, iterated = {scheme: "generalized-alpha"}, {coupling: "iterated"}
    second_order = ("bdf2", "midpoint", "generalized-alpha")
    return {
        scheme: [
            *vary(CONTACT, scheme, "backward-euler", same=DEFAULT),
            *vary(CONTACT, scheme, *second_order),
            *vary("contact without heat", scheme, *second_order),
            *vary("contact without mechanics", scheme, *second_order),
            *vary("coupled", scheme, "bdf2", beside=iterated),
            *vary("contact left", scheme, "generalized-alpha", beside={"space.degree": 2}),
            *vary(
                CONTACT,
                scheme,
                "generalized-alpha",
                beside={"material.density": ABSENT, "initial.velocity": ABSENT},
            ),
            *vary(CONTACT, scheme, "bdf2", beside={"heat.capacity": ABSENT}),
        ],
        limit: vary(CONTACT, limit, 0.05, 2e-3)
        + vary(CONTACT, limit, 0.02, beside={scheme: "bdf2"})
        + vary(CONTACT, limit, 0.05, beside={**alpha, **iterated})
        + vary("heat", limit, 0.01)
        + vary("mechanics", limit, 0.02, beside={scheme: "bdf2"}),
        radius: vary(CONTACT, radius, 0.0, 0.8, 1.0, beside=alpha) + vary("heat", radius, 0.25, beside=alpha),
        coupling: [
            *vary(CONTACT, coupling, "lagged", same=DEFAULT),
            *vary(CONTACT, coupling, "iterated"),
            *vary("coupled", coupling, "iterated"),
            *vary(CONTACT, coupling, "iterated", beside={scheme: "midpoint"}),
            *vary(CONTACT, coupling, "iterated", beside={"heat.strain_heating": ABSENT}),
        ],
        tolerance: vary(CONTACT, tolerance, 1e-2, 1e-6, beside=iterated),
    }


def _material() -> dict[str, list[Variation]]:
    young, poisson = ISOTROPIC
    elasticity, viscosity = "material.elasticity", "material.viscosity"
    quasi_static = {"initial.velocity": ABSENT}
    elastic_tensor = {elasticity: ABSENT, f"{elasticity}.tensor": ELASTIC_TENSOR}
    viscous_tensor = {viscosity: ABSENT, f"{viscosity}.tensor": VISCOUS_TENSOR}
    return {
        "material.density": vary(CONTACT, "material.density", 4.0)
        + vary(CONTACT, "material.density", ABSENT, beside=quasi_static)
        + vary("mechanics", "material.density", ABSENT, beside=quasi_static),
        young: vary(CONTACT, young, 25.0) + vary("mechanics", young, 0.1),
        poisson: vary(CONTACT, poisson, 0.0, 0.45, -0.3),
        f"{elasticity}.plane": vary(CONTACT, f"{elasticity}.plane", "stress", same=DEFAULT)
        + vary(CONTACT, f"{elasticity}.plane", "strain")
        + vary("mechanics", f"{elasticity}.plane", "strain")
        + vary(CONTACT, f"{elasticity}.plane", "strain", beside={"heat.thermal_stress": COUPLING}),
        f"{elasticity}.tensor": [
            Variation(CONTACT, elastic_tensor),
            Variation("mechanics", elastic_tensor),
            Variation(CONTACT, {**elastic_tensor, **viscous_tensor}),
            Variation(CONTACT, {elasticity: ABSENT}),
        ],
        f"{viscosity}.trace": vary(CONTACT, f"{viscosity}.trace", 1.5, 0.0, -0.1),
        f"{viscosity}.shear": vary(CONTACT, f"{viscosity}.shear", 2.0, 0.0),
        f"{viscosity}.tensor": [
            Variation(CONTACT, viscous_tensor),
            Variation("mechanics", viscous_tensor),
            Variation(CONTACT, {viscosity: ABSENT}),
        ],
    }


def _heat_and_loads() -> dict[str, list[Variation]]:
    expression = "1 + 2*x*y - 5*t"
    vector = ["x - 0.4*y + t", "0.3 - x*y*t"]
    jumping = ["0.01*x*y", "x > 0.4 ? -0.02 : 0.01*y"]
    return {
        "heat.capacity": [
            *vary(CONTACT, "heat.capacity", 0.4, ABSENT),
            *vary("heat", "heat.capacity", ABSENT),
        ],
        "heat.conductivity": [
            *vary(CONTACT, "heat.conductivity", 2.5, CONDUCTOR, SINGULAR, ABSENT),
            *vary("heat", "heat.conductivity", CONDUCTOR, ABSENT),
            *vary(CONTACT, "heat.conductivity", CONDUCTOR, beside={"heat.capacity": ABSENT}),
        ],
        "heat.source": [
            *vary(CONTACT, "heat.source", 3.0, expression, ABSENT),
            *vary("heat", "heat.source", expression, ABSENT),
        ],
        "heat.thermal_stress": [
            *vary(CONTACT, "heat.thermal_stress", -1.0, COUPLING, ABSENT),
            *vary("coupled", "heat.thermal_stress", COUPLING, ABSENT),
        ],
        "heat.strain_heating": [
            *vary(CONTACT, "heat.strain_heating", -1.0, COUPLING, ABSENT),
            *vary("coupled", "heat.strain_heating", COUPLING, ABSENT),
        ],
        "heat.strain_rate_heating": _strain_rate_heating(),
        "load.body_force": [
            *vary(CONTACT, "load.body_force", [1.0, 2.0], vector, ABSENT),
            *vary("mechanics", "load.body_force", vector, ABSENT),
        ],
        "initial.displacement": vary(CONTACT, "initial.displacement", [0.01, -0.01], jumping, ABSENT),
        "initial.velocity": vary(CONTACT, "initial.velocity", [0.1, -0.2], ["y", "0.1*sin(x)"], ABSENT),
        "initial.temperature": vary(CONTACT, "initial.temperature", 2.0, "x*x - 3*y", ABSENT),
    }


def _strain_rate_heating() -> list[Variation]:
    key, iterated = "heat.strain_rate_heating", {"time.coupling": "iterated"}
    return [
        *vary(CONTACT, key, -1.0, COUPLING),
        *vary("coupled", key, 0.7, COUPLING, beside={"heat.strain_heating": ABSENT}),
        *vary(CONTACT, key, COUPLING, beside=iterated),
        *vary("coupled", key, COUPLING, beside={"time.scheme": "bdf2"}),
        *vary(CONTACT, key, -1.0, beside={"time.scheme": "midpoint", **iterated}),
        *vary(CONTACT, key, 0.5, beside={"material.density": ABSENT, "initial.velocity": ABSENT}),
    ]


def _solver_and_output() -> dict[str, list[Variation]]:
    fields = ["displacement", "velocity", "temperature", "stress", "von_mises", "contact"]
    chosen = [["temperature"], [], fields, ["contact", "von_mises"], ["displacement", "velocity", "stress"]]
    return {
        "solver.strategy": [
            *vary(CONTACT, "solver.strategy", "auto", same=DEFAULT),
            *vary(CONTACT, "solver.strategy", "condensed", same=SOLVER_ONLY),
            *vary("mechanics", "solver.strategy", "condensed", same=SOLVER_ONLY),
            *vary(CONTACT, "solver.strategy", "newton-krylov", same=SOLVER_ONLY),
        ],
        "solver.factor": [
            *vary(CONTACT, "solver.factor", "auto", same=DEFAULT),
            *vary(CONTACT, "solver.factor", "double", "single", same=SOLVER_ONLY),
            *vary("mechanics", "solver.factor", "single", same=SOLVER_ONLY),
            *vary("coupled", "solver.factor", "single", same=SOLVER_ONLY),
        ],
        "solver.tolerance": vary(CONTACT, "solver.tolerance", 1e-13, 3e-12, same=SOLVER_ONLY),
        "solver.max_iterations": [
            *vary(CONTACT, "solver.max_iterations", 200, same=SOLVER_ONLY),
            *vary("coupled", "solver.max_iterations", 1, same=SOLVER_ONLY),
        ],
        "output.every": vary(CONTACT, "output.every", 1, 2, 10, same=FILES_ONLY),
        "output.fields": vary(CONTACT, "output.fields", *chosen, same=FILES_ONLY),
        "output.checkpoint_every": vary(CONTACT, "output.checkpoint_every", 1, 2, same=FILES_ONLY),
    }


def _variations() -> dict[str, list[Variation]]:
    table = {
        **_mesh_and_time(),
        **_material(),
        **_heat_and_loads(),
        **_solver_and_output(),
        **law_files("bottom"),
        **body_law_files(),
    }
    for side in SIDES["rectangle"]:
        for key, variations in {**conditions(side), **contact_on(side)}.items():
            table.setdefault(f"boundary.NAME.{key}", []).extend(variations)
    table["boundary.NAME.contact.quadrature"] += every_rule()
    table["boundary.NAME.contact.friction.regularisation"] += exact_friction()
    table["boundary.NAME.spring.stiffness"] += on_springs()
    table["boundary.NAME.convection.coefficient"] += held_by_convection()
    table["boundary.NAME.contact.friction.heat_share"] += heat_of_friction()
    return table


VARIATIONS = _variations()
