"""The table of bodies in space: each key that means something else there than in the plane, or meets other code.

Tetrahedra and hexahedra of both degrees, Voigt tensors with six rows, two tangents on a contact side, Gauss rules of
triangles and quadrilaterals. ALIKE are the keys that know nothing of it.
"""

from matrix_parts.body_law_files import body_law_files
from matrix_parts.cases import Variation, vary
from matrix_parts.scenes import ABSENT, AXIS, BESIDE, OPPOSITE, SIDES, Flat, base_name
from matrix_parts.values import DEFAULT, ISOTROPIC, SOLVER_ONLY
from matrix_parts.variations_of_contact import contact_on, law_files, rubbing
from matrix_parts.variations_of_sides import convection, springs

ALIKE = {
    "title": "a name",
    "mesh.shape": "that of every case here",
    "mesh.diagonal": "rectangles only",
    "material.elasticity.plane": "plane bodies only",
    **dict.fromkeys(("time.end", "time.steps", "time.step"), "time, not space"),
    **dict.fromkeys(("time.tolerance", "time.spectral_radius", "time.coupling_tolerance"), "time, not space"),
    **dict.fromkeys(("mesh.refinement.max_cells", "mesh.refinement.max_level"), "limits of any mesh"),
    **dict.fromkeys(("solver.tolerance", "solver.max_iterations"), "numbers of unknowns, not what they are"),
    **dict.fromkeys(("output.every", "output.fields", "output.checkpoint_every"), "what is written"),
}
SHAPE = "box"
CONTACT = "box contact bottom"
HEXAHEDRA = {"mesh.cell": "tensor"}
SECOND_DEGREE = {"space.degree": 2}
ELASTIC_TENSOR = [
    [6.0, 2.0, 1.5, 0.3, -0.2, 0.4],
    [2.0, 5.0, 1.0, 0.2, 0.1, -0.3],
    [1.5, 1.0, 4.0, -0.1, 0.3, 0.2],
    [0.3, 0.2, -0.1, 1.6, 0.1, 0.05],
    [-0.2, 0.1, 0.3, 0.1, 1.4, -0.15],
    [0.4, -0.3, 0.2, 0.05, -0.15, 1.8],
]
VISCOUS_TENSOR = [
    [1.2, 0.2, 0.1, 0.05, 0.0, -0.04],
    [0.2, 0.9, 0.15, -0.03, 0.02, 0.06],
    [0.1, 0.15, 0.8, 0.04, -0.05, 0.0],
    [0.05, -0.03, 0.04, 0.3, 0.02, 0.01],
    [0.0, 0.02, -0.05, 0.02, 0.25, -0.03],
    [-0.04, 0.06, 0.0, 0.01, -0.03, 0.4],
]
CONDUCTOR = [[1.0, 0.25, -0.1], [0.25, 0.6, 0.15], [-0.1, 0.15, 0.8]]
SINGULAR = [[1.0, 1.0, 1.0], [1.0, 1.0, 1.0], [1.0, 1.0, 1.0]]
SPRINGS = [[5.0, 2.0, 0.5], [2.0, 1.0, 0.2], [0.5, 0.2, 3.0]]
COUPLING = [[0.4, -0.1, 0.05], [-0.1, 0.3, 0.2], [0.05, 0.2, -0.25]]


def _mesh() -> dict[str, list[Variation]]:
    left, front = "box contact left", "box contact front"
    return {
        "mesh.lower": vary(CONTACT, "mesh.lower", [0.0, 0.0, 0.0], same=DEFAULT)
        + vary(CONTACT, "mesh.lower", [-0.3, 0.1, 0.2]),
        "mesh.upper": vary(CONTACT, "mesh.upper", ABSENT, [1.3, 0.9, 0.7])
        + vary(front, "mesh.upper", [0.6, 1.1, 0.8], beside=HEXAHEDRA),
        "mesh.cells": vary(CONTACT, "mesh.cells", [1, 1, 1], [2, 3, 1])
        + vary(CONTACT, "mesh.cells", [2, 1, 3], beside=HEXAHEDRA),
        "mesh.cell": vary(CONTACT, "mesh.cell", "simplex", same=DEFAULT)
        + [Variation(base_name(SHAPE, f"contact {side}"), HEXAHEDRA) for side in SIDES[SHAPE]]
        + [
            Variation(base, {**HEXAHEDRA, **SECOND_DEGREE})
            for base in (CONTACT, left, "box coupled", "box heat")
        ],
        **_grading(),
        **_refinement(),
        "space.degree": vary(CONTACT, "space.degree", 1, same=DEFAULT)
        + [Variation(base, SECOND_DEGREE) for base in (CONTACT, front, "box coupled", "box heat")],
    }


def _grading() -> dict[str, list[Variation]]:
    found = {}
    for side in SIDES[SHAPE]:
        key, opposite = f"mesh.grading.{side}", f"mesh.grading.{OPPOSITE[side]}"
        found[key] = [
            *vary(CONTACT, key, 1.0, same=DEFAULT),
            *vary(base_name(SHAPE, f"contact {side}"), key, 3.0),
            *vary(base_name(SHAPE, "heat"), key, 5.0, beside={opposite: 2.0, **HEXAHEDRA, **SECOND_DEGREE}),
        ]
    return found


def _refinement() -> dict[str, list[Variation]]:
    tolerance, every = "mesh.refinement.tolerance", "mesh.refinement.every"
    few = {every: 1, "mesh.refinement.max_cells": 600}
    return {
        tolerance: [
            *vary(CONTACT, tolerance, 0.3, beside=few),
            *vary("box coupled", tolerance, 0.2, beside={**few, **SECOND_DEGREE}),
        ],
        every: vary("box contact without heat", every, 1, beside={tolerance: 0.35, "time.scheme": "bdf2"}),
    }


def _schemes() -> dict[str, list[Variation]]:
    scheme, coupling = "time.scheme", "time.coupling"
    iterated = {coupling: "iterated"}
    return {
        scheme: [
            *vary(CONTACT, scheme, "backward-euler", same=DEFAULT),
            *vary(CONTACT, scheme, "bdf2", "midpoint", "generalized-alpha"),
            *vary("box contact without heat", scheme, "generalized-alpha", beside=HEXAHEDRA),
            *vary("box contact without mechanics", scheme, "bdf2", beside=HEXAHEDRA),
        ],
        coupling: [
            *vary(CONTACT, coupling, "lagged", same=DEFAULT),
            *vary(CONTACT, coupling, "iterated"),
            *vary("box coupled", coupling, "iterated", beside={scheme: "midpoint", **HEXAHEDRA}),
        ],
    }


def _material() -> dict[str, list[Variation]]:
    young, poisson = ISOTROPIC
    density, elasticity, viscosity = "material.density", "material.elasticity", "material.viscosity"
    quasi_static = {"initial.velocity": ABSENT}
    elastic_tensor = {elasticity: ABSENT, f"{elasticity}.tensor": ELASTIC_TENSOR}
    viscous_tensor = {viscosity: ABSENT, f"{viscosity}.tensor": VISCOUS_TENSOR}
    return {
        density: vary(CONTACT, density, 4.0)
        + vary(CONTACT, density, ABSENT, beside=quasi_static)
        + vary("box mechanics", density, ABSENT, beside={**quasi_static, **HEXAHEDRA}),
        young: vary(CONTACT, young, 25.0),
        poisson: vary(CONTACT, poisson, 0.0, 0.45, -0.3),
        f"{elasticity}.tensor": [
            Variation(CONTACT, elastic_tensor),
            Variation("box mechanics", {**elastic_tensor, **HEXAHEDRA}),
            Variation(CONTACT, {**elastic_tensor, **viscous_tensor, **SECOND_DEGREE}),
            Variation(CONTACT, {elasticity: ABSENT}),
        ],
        f"{viscosity}.trace": vary(CONTACT, f"{viscosity}.trace", 1.5, 0.0),
        f"{viscosity}.shear": vary(CONTACT, f"{viscosity}.shear", 2.0, 0.0),
        f"{viscosity}.tensor": [
            Variation(CONTACT, viscous_tensor),
            Variation("box mechanics", {**viscous_tensor, **HEXAHEDRA}),
            Variation(CONTACT, {viscosity: ABSENT}),
        ],
    }


def _heat_and_loads() -> dict[str, list[Variation]]:
    expression = "1 + 2*x*y - 5*t*z"
    vector = ["x - 0.4*y + t", "0.3 - x*y*t", "z - 2*t*y"]
    jumping = ["0.01*x*y", "x > 0.4 ? -0.02 : 0.01*y", "0.01*z"]
    source, force = "heat.source", "load.body_force"
    stress, heating = "heat.thermal_stress", "heat.strain_heating"
    rate = "heat.strain_rate_heating"
    return {
        "heat.capacity": [
            *vary(CONTACT, "heat.capacity", 0.4, ABSENT),
            *vary("box heat", "heat.capacity", ABSENT, beside=HEXAHEDRA),
        ],
        "heat.conductivity": [
            *vary(CONTACT, "heat.conductivity", 2.5, CONDUCTOR, SINGULAR, ABSENT),
            *vary("box heat", "heat.conductivity", CONDUCTOR, beside=HEXAHEDRA),
        ],
        source: vary(CONTACT, source, 3.0, expression, ABSENT)
        + vary("box heat", source, expression, beside=HEXAHEDRA),
        stress: vary(CONTACT, stress, -1.0, COUPLING, ABSENT)
        + vary("box coupled", stress, COUPLING, beside=HEXAHEDRA),
        heating: vary(CONTACT, heating, -1.0, COUPLING, ABSENT)
        + vary("box coupled", heating, COUPLING, beside=HEXAHEDRA),
        rate: vary(CONTACT, rate, -1.0, COUPLING, beside={heating: ABSENT})
        + vary("box coupled", rate, COUPLING, beside={**HEXAHEDRA, "time.coupling": "iterated"}),
        force: vary(CONTACT, force, [1.0, 2.0, -0.5], vector, ABSENT)
        + vary("box mechanics", force, vector, beside=HEXAHEDRA),
        "initial.displacement": vary(CONTACT, "initial.displacement", [0.01, -0.01, 0.02], jumping, ABSENT),
        "initial.velocity": vary(
            CONTACT, "initial.velocity", [0.1, -0.2, 0.1], ["y", "0.1*sin(x)", "-z"], ABSENT
        ),
        "initial.temperature": vary(CONTACT, "initial.temperature", 2.0, "x*x - 3*y + z", ABSENT),
    }


def _conditions(side: str) -> dict[str, list[Variation]]:
    """What is prescribed on a side: where it is the lid, and where it is neither lid nor contact."""
    name, lid_of = f"boundary.{side}", base_name(SHAPE, f"contact {OPPOSITE[side]}")
    plain_side = "left" if side in ("bottom", "top") else "bottom"
    plain = base_name(SHAPE, f"contact {plain_side}")
    is_loaded = BESIDE[plain_side] == side  # has traction and flux already
    displacement, traction = f"{name}.displacement", f"{name}.traction"
    temperature, heat_flux = f"{name}.temperature", f"{name}.heat_flux"
    moving = ["0.01*x*y - 0.1*t", "0.02*x + 0.05*t*z", "0.03*z - 0.02*t"]
    roller = [0.01 if axis == AXIS[side] else "free" for axis in range(3)]
    slider = ["free" if axis == AXIS[side] else "0.1*t*y" for axis in range(3)]
    return {
        "displacement": [
            *vary(lid_of, displacement, moving, ABSENT),
            *vary(plain, displacement, roller, slider, beside={traction: ABSENT}),
        ],
        "traction": [
            *vary(plain, traction, ["x + t", "1 - y*t", "z - 0.5"]),
            *(vary(plain, traction, [1.0, -0.5, 0.3], ABSENT) if is_loaded else []),
        ],
        "temperature": [
            *vary(lid_of, temperature, "x + 3*y*t - z", ABSENT),
            *vary(plain, temperature, -1.0, beside={heat_flux: ABSENT}),
        ],
        "heat_flux": [
            *vary(plain, heat_flux, "x - y*z + 5*t"),
            *(vary(plain, heat_flux, -1.0, ABSENT) if is_loaded else []),
        ],
        **convection(side, plain, "x + 3*y*t - 2*z"),
        **springs(side, plain, SPRINGS, ["0.1*t*y", "0.05*sin(9*t) - 0.02*x", "0.03*z - 0.02*t"]),
    }


def _on_other_sides(side: str) -> dict[str, list[Variation]]:
    """Of the laws what depends on the place and the facets: `bottom` has the rest."""
    base, contact = base_name(SHAPE, f"contact {side}"), f"boundary.{side}.contact"
    foundation = f"{contact}.conductance.foundation_temperature"
    return {
        "contact.gap": vary(base, f"{contact}.gap", "0.01*sin(9*x - 7*y + 4*z - 8*t) - 0.005"),
        "contact.quadrature": vary(base, f"{contact}.quadrature", "vertex"),
        "contact.compliance.exponent": vary(base, f"{contact}.compliance.exponent", 1.5),
        **rubbing(side, SHAPE),
        "contact.conductance.foundation_temperature": vary(base, foundation, "4*x - 2 + 3*t*y*z"),
        "contact.conductance.limit": vary(base, f"{contact}.conductance.limit", 0.5),
    }


def _on_springs() -> list[Variation]:
    """On quadrilaterals and facets of degree 2; by multigrid; alone where nothing else holds the body."""
    k_s, anchor = (f"boundary.right.spring.{key}" for key in ("stiffness", "anchor"))
    alone: Flat = {
        "boundary.top.displacement": ABSENT,
        "material.density": ABSENT,
        "initial.velocity": ABSENT,
    }
    settings: list[tuple[str, Flat]] = [
        (CONTACT, {**HEXAHEDRA, **SECOND_DEGREE}),
        (CONTACT, {**SECOND_DEGREE, "time.scheme": "bdf2"}),
        (CONTACT, {"solver.strategy": "newton-krylov"}),
        ("box coupled", alone),
    ]
    return [
        variation
        for base, beside in settings
        for variation in vary(base, k_s, SPRINGS, beside={anchor: ["0.1*t", "-0.05*t", 0.02], **beside})
    ]


def _every_rule() -> list[Variation]:
    """Triangles have a rule for each degree but the default 4; quadrilaterals the same for 4 and 5."""
    quadrature = "boundary.bottom.contact.quadrature"
    of_heat = "box contact without mechanics"
    return [
        *vary(CONTACT, quadrature, 4, same=DEFAULT),
        *vary(of_heat, quadrature, 2, 3, 5, 6, 8, 9),
        *vary(of_heat, quadrature, 9, "vertex", beside={**HEXAHEDRA, **SECOND_DEGREE}),
        *vary("box contact without heat", quadrature, 3, "vertex", beside=HEXAHEDRA),
    ]


def _exact_friction() -> list[Variation]:
    """The multipliers of friction on triangles and quadrilaterals, by every rule that they can take."""
    epsilon, quadrature = (
        f"boundary.bottom.contact.{key}" for key in ("friction.regularisation", "quadrature")
    )
    settings: list[Flat] = [
        {quadrature: 1},
        {quadrature: 2},
        {quadrature: "vertex"},
        {**SECOND_DEGREE, quadrature: "vertex"},
        {**SECOND_DEGREE},
        HEXAHEDRA,
        {**HEXAHEDRA, **SECOND_DEGREE, quadrature: "vertex"},
        {"time.scheme": "generalized-alpha"},
        {"solver.strategy": "newton-krylov"},
    ]
    return [variation for beside in settings for variation in vary(CONTACT, epsilon, 0.0, beside=beside)]


def _heat_of_friction() -> list[Variation]:
    """On triangles and quadrilaterals of degree 2, by the other rules."""
    contact = "boundary.bottom.contact"
    settings: list[Flat] = [
        {**SECOND_DEGREE, f"{contact}.foundation_velocity": ["-0.5*z", 0.0, "0.5*x"]},
        {**HEXAHEDRA, **SECOND_DEGREE},
        {**HEXAHEDRA, f"{contact}.quadrature": "vertex", f"{contact}.friction.regularisation": 0.0},
    ]
    return [
        variation
        for beside in settings
        for variation in vary(CONTACT, f"{contact}.friction.heat_share", 0.9, beside=beside)
    ]


def _strategies() -> dict[str, list[Variation]]:
    """Multigrid's coarse spaces hold the six rigid motions."""
    key = "solver.strategy"
    return {
        key: vary(CONTACT, key, "auto", same=DEFAULT)
        + vary(CONTACT, key, "condensed", "newton-krylov", same=SOLVER_ONLY)
        + vary("box mechanics", key, "newton-krylov", same=SOLVER_ONLY),
        "solver.factor": vary(CONTACT, "solver.factor", "auto", same=DEFAULT)
        + vary(CONTACT, "solver.factor", "double", "single", same=SOLVER_ONLY),
    }


def _variations() -> dict[str, list[Variation]]:
    table = {
        **_mesh(),
        **_schemes(),
        **_material(),
        **_heat_and_loads(),
        **_strategies(),
        **law_files("bottom", SHAPE),
        **body_law_files(SHAPE),
    }
    for side in SIDES[SHAPE]:
        laws = contact_on(side, SHAPE) if side == "bottom" else _on_other_sides(side)
        for key, variations in {**_conditions(side), **laws}.items():
            table.setdefault(f"boundary.NAME.{key}", []).extend(variations)
    table["boundary.NAME.spring.stiffness"] += _on_springs()
    table["boundary.NAME.contact.quadrature"] += _every_rule()
    table["boundary.NAME.contact.friction.regularisation"] += _exact_friction()
    table["boundary.NAME.contact.friction.heat_share"] += _heat_of_friction()
    return table


IN_SPACE = _variations()
