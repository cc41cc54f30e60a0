"""The table of plane bodies: for every key of the schema the values that are tried. coverage.py says what must be in
it, variations_in_space.py has the one of bodies in space."""

from matrix_parts.body_law_files import LAWS, body_law_files
from matrix_parts.cases import Variation, vary
from matrix_parts.scenes import ABSENT, BESIDE, OPPOSITE, SIDES, Flat, base_name

DEFAULT = "the default, written out"
NAME_ONLY = "a name"
ALIKE = dict.fromkeys(("mesh.grading.front", "mesh.grading.back"), "boxes only")
FILES_ONLY = "says what is written, not what is computed"
SOLVER_ONLY = "says how the equations are solved, not which"

CONTACT = "contact bottom"
ISOTROPIC = ("material.elasticity.young", "material.elasticity.poisson")
ELASTIC_TENSOR = [[6.0, 2.0, 0.4], [2.0, 4.0, -0.3], [0.4, -0.3, 1.5]]
VISCOUS_TENSOR = [[1.2, 0.2, 0.05], [0.2, 0.8, -0.1], [0.05, -0.1, 0.3]]
CONDUCTOR = [[1.0, 0.25], [0.25, 0.6]]
SINGULAR = [[1.0, 1.0], [1.0, 1.0]]
COUPLING = [[0.4, -0.1], [-0.1, 0.3]]
SPRINGS = [[5.0, 2.0], [2.0, 1.0]]


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


def convection(side: str, base: str, moving: str) -> dict[str, list[Variation]]:
    """`moving`: an ambient temperature that depends on place and time."""
    h, ambient = (f"boundary.{side}.convection.{key}" for key in ("coefficient", "ambient_temperature"))
    return {
        "convection.coefficient": [
            *vary(base, h, 0.0, beside={ambient: 4.0}, same="nothing is exchanged"),
            *vary(base, h, 2.5, beside={ambient: 4.0}),
        ],
        "convection.ambient_temperature": vary(base, ambient, -1.0, moving, beside={h: 2.0}),
    }


def springs(side: str, base: str, matrix: list[list[float]], moving: list[str]) -> dict[str, list[Variation]]:
    """`moving`: far ends that depend on place and time."""
    k_s, anchor = (f"boundary.{side}.spring.{key}" for key in ("stiffness", "anchor"))
    return {
        "spring.stiffness": vary(base, k_s, 3.0, matrix),
        "spring.anchor": [
            *vary(base, anchor, [0.02 * (1 + axis) for axis in range(len(matrix))], beside={k_s: 5.0}),
            *vary(base, anchor, moving, beside={k_s: matrix}),
        ],
    }


def _on_springs() -> list[Variation]:
    """By every scheme, of degree 2, on quadrilaterals; beside a roller and on the contact side; alone where nothing
    else holds the body; on sides that share a corner, with far ends that do not agree there."""
    k_s, anchor = (f"boundary.right.spring.{key}" for key in ("stiffness", "anchor"))
    pulled: Flat = {anchor: ["0.1*t*t", "0.05*sin(9*t) - 0.02*y"]}
    other: Flat = {"boundary.bottom.spring.stiffness": 2.0, "boundary.bottom.spring.anchor": [0.03, "-t"]}
    settings: list[tuple[str, Flat]] = [
        *((CONTACT, {"time.scheme": scheme}) for scheme in ("bdf2", "midpoint", "generalized-alpha")),
        (CONTACT, {"space.degree": 2, "time.scheme": "bdf2"}),
        (CONTACT, {"mesh.cell": "tensor", "time.coupling": "iterated"}),
        (CONTACT, {"boundary.right.displacement": ["free", 0.01]}),
        (CONTACT, {"solver.strategy": "newton-krylov"}),
        (
            "coupled",
            {"boundary.top.displacement": ABSENT, "material.density": ABSENT, "initial.velocity": ABSENT},
        ),
        (CONTACT, other),
        ("contact right", {"boundary.right.contact.friction.regularisation": 0.0}),
    ]
    return [
        variation
        for base, beside in settings
        for variation in vary(base, k_s, SPRINGS, beside={**pulled, **beside})
    ]


def _held_by_convection() -> list[Variation]:
    """Without capacity and prescribed temperatures; of degree 2; where a conductance beside it is limited."""
    h, ambient = (f"boundary.right.convection.{key}" for key in ("coefficient", "ambient_temperature"))
    return [
        *vary(
            "heat", h, 1.5, beside={ambient: 3.0, "heat.capacity": ABSENT, "boundary.top.temperature": ABSENT}
        ),
        *vary("heat", h, 1.5, beside={ambient: "1 + y", "space.degree": 2, "time.scheme": "bdf2"}),
        *vary(
            "contact without mechanics",
            h,
            1.5,
            beside={ambient: 3.0, "mesh.cell": "tensor", "boundary.bottom.contact.conductance.limit": 0.7},
        ),
    ]


def _conditions(side: str) -> dict[str, list[Variation]]:
    """What is prescribed on a side: where it is the lid, and where it is neither lid nor contact."""
    name, lid_of = f"boundary.{side}", f"contact {OPPOSITE[side]}"
    plain = "contact bottom" if side in ("left", "right") else "contact left"
    is_loaded = BESIDE[plain.split()[1]] == side  # has traction and flux already
    no_traction, no_flux = {f"{name}.traction": ABSENT}, {f"{name}.heat_flux": ABSENT}
    displacement, traction = f"{name}.displacement", f"{name}.traction"
    temperature, heat_flux = f"{name}.temperature", f"{name}.heat_flux"
    return {
        "displacement": [
            *vary(lid_of, displacement, [0.0, 0.0], ["0.01*x*y - 0.1*t", "0.02*x + 0.05*t"]),
            *vary(plain, displacement, ["free", 0.01], ["0.1*t*y", "free"], beside=no_traction),
            *vary(lid_of, displacement, ABSENT),
            *vary(plain, displacement, ["free", "free"], same="no component is prescribed"),
        ],
        "traction": [
            *vary(plain, traction, [1.0, -0.5], ["x + t", "1 - y*t"]),
            *(vary(plain, traction, ABSENT) if is_loaded else []),
        ],
        "temperature": [
            *vary(lid_of, temperature, 2.0, "x + 3*y*t", ABSENT),
            *vary(plain, temperature, -1.0, beside=no_flux),
        ],
        "heat_flux": [
            *vary(plain, heat_flux, -1.0, "x - y + 5*t"),
            *(vary(plain, heat_flux, ABSENT) if is_loaded else []),
        ],
        **convection(side, plain, "x + 3*y*t"),
        **springs(side, plain, SPRINGS, ["0.1*t*y", "0.05*sin(9*t) - 0.02*x"]),
    }


def contact_on(side: str, shape: str = "rectangle") -> dict[str, list[Variation]]:
    base, contact = base_name(shape, f"contact {side}"), f"boundary.{side}.contact"
    without_mechanics = base_name(shape, "contact without mechanics")
    along, z = "y" if side in ("left", "right") else "x", "" if shape == "rectangle" else " + 4*z"
    gap, quadrature = f"{contact}.gap", f"{contact}.quadrature"
    compliance, friction, conductance = (
        f"{contact}.{law}" for law in ("compliance", "friction", "conductance")
    )
    frictionless = {friction: ABSENT}
    foundation = f"{conductance}.foundation_temperature"
    return {
        "contact.gap": [
            *vary(base, gap, -0.01, f"0.01*sin(9*x - 7*y{z} - 8*t) - 0.005", ABSENT),
            *vary(base, gap, 1.0),  # never closed
        ],
        "contact.quadrature": [
            *vary(base, quadrature, 1, 7, "vertex"),
            *vary(base, quadrature, "vertex", beside={"space.degree": 2}),
        ],
        "contact.compliance.stiffness": [
            *vary(base, f"{compliance}.stiffness", 20.0, 1e4),
            Variation(base, {compliance: ABSENT, **frictionless}),
        ],
        "contact.compliance.exponent": [
            *vary(base, f"{compliance}.exponent", 1.0, same=DEFAULT),
            *vary(base, f"{compliance}.exponent", 1.5, 2.0, 3),
        ],
        "contact.friction.coefficient": [
            *vary(base, f"{friction}.coefficient", 0.0, 1.2),
            Variation(base, frictionless),
        ],
        "contact.friction.regularisation": vary(base, f"{friction}.regularisation", 1e-5, 0.5, 0.0),
        **rubbing(side, shape),
        "contact.conductance.coefficient": [
            *vary(base, f"{conductance}.coefficient", 0.0, 9.0),
            Variation(base, {conductance: ABSENT}),
            Variation(without_mechanics, {"boundary.bottom": ABSENT}),
        ],
        "contact.conductance.onset": vary(base, f"{conductance}.onset", 1e-5, 3.0),
        "contact.conductance.foundation_temperature": [
            *vary(base, foundation, -2.0, f"4*{along} - 2 + 3*t*x*y{z}"),
            *vary(without_mechanics, foundation.replace(side, "bottom"), f"2 + x*y - 5*t{z}"),
        ],
        "contact.conductance.limit": vary(base, f"{conductance}.limit", 0.5, 1.0),
    }


def law_files(side: str, shape: str = "rectangle") -> dict[str, list[Variation]]:
    """Laws from files, alone, together, and the built-in ones that are made of them."""
    base, at = base_name(shape, f"contact {side}"), f"boundary.{side}.contact"
    forms = {law: f"forms.{law}" for law in ("compliance", "friction", "conductance")}
    compliance: Flat = {
        forms["compliance"]: str(LAWS / "power-law.py"),
        f"{at}.compliance": ABSENT,
        f"{at}.compliance.hardness": 40.0,
        f"{at}.compliance.power": 1.5,
    }
    friction: Flat = {
        forms["friction"]: str(LAWS / "stribeck.py"),
        f"{at}.friction": ABSENT,
        f"{at}.friction.static": 0.6,
        f"{at}.friction.kinetic": 0.2,
        f"{at}.friction.stribeck_velocity": 0.2,
        f"{at}.friction.regularisation": 1e-2,
    }
    conductance: Flat = {
        forms["conductance"]: str(LAWS / "pressure-conductance.py"),
        f"{at}.conductance": ABSENT,
        f"{at}.conductance.coefficient": 3.0,
        f"{at}.conductance.hardness": 0.5,
        f"{at}.conductance.foundation_temperature": 2.0,
    }
    vertex, exact = {f"{at}.quadrature": "vertex"}, {f"{at}.friction.regularisation": 0.0}
    return {
        forms["compliance"]: [
            Variation(base, compliance),
            Variation(base, {**compliance, **exact}),
            Variation(base, {**compliance, **vertex, "space.degree": 2}),
        ],
        forms["friction"]: [
            Variation(base, friction),
            Variation(base, {**friction, **compliance}),
            Variation(base, {**friction, f"{at}.friction.heat_share": 0.5}),
        ],
        forms["conductance"]: [
            Variation(base, conductance),
            Variation(base, {**conductance, **compliance, **friction, "mesh.cell": "tensor"}),
        ],
    }


def rubbing(side: str, shape: str = "rectangle") -> dict[str, list[Variation]]:
    """A foundation that moves, and the heat of friction."""
    base, contact = base_name(shape, f"contact {side}"), f"boundary.{side}.contact"
    belt, share = f"{contact}.foundation_velocity", f"{contact}.friction.heat_share"
    exact = {f"{contact}.friction.regularisation": 0.0}
    d = 2 if shape == "rectangle" else 3
    steady = [0.3, -0.2, 0.1][:d]
    turning = ["0.5 - 2*y + t", "x - 0.4*t", "0.3*z"][:d]
    return {
        "contact.foundation_velocity": [
            *vary(base, belt, steady, turning),
            *vary(base, belt, turning, beside=exact),
        ],
        "contact.friction.heat_share": [
            *vary(base, share, 0.0, same="the foundation takes all"),
            *vary(base, share, 0.5),
            *vary(base, share, 1.0, beside={belt: turning}),
            *vary(base, share, 0.8, beside={belt: steady, **exact}),
        ],
    }


def _every_rule() -> list[Variation]:
    """Gauss rules of an odd degree have the points of the even degree below."""
    quadrature = "boundary.bottom.contact.quadrature"
    return [
        *vary(CONTACT, quadrature, 4, same=DEFAULT),
        *vary(CONTACT, quadrature, 5, same="degrees 4 and 5 both take three points"),
        *vary(CONTACT, quadrature, 2, 3, 6, 8, 9),
        *vary("contact without heat", quadrature, 1, 9, "vertex", beside={"space.degree": 2}),
    ]


def _exact_friction() -> list[Variation]:
    """What the multipliers of friction depend on: the rule, the degree, the cell, the scheme, the strategy."""
    epsilon, quadrature = (
        f"boundary.bottom.contact.{key}" for key in ("friction.regularisation", "quadrature")
    )
    settings: list[Flat] = [
        {quadrature: 1},
        {quadrature: 2, "mesh.cell": "tensor"},
        {quadrature: "vertex"},
        {"space.degree": 2},
        {"space.degree": 2, "mesh.cell": "tensor", quadrature: "vertex"},
        {"time.scheme": "bdf2"},
        {"time.scheme": "midpoint"},
        {"solver.strategy": "newton-krylov"},
        {"solver.factor": "single"},
        {
            "boundary.bottom.contact.compliance.exponent": 1.5,
            "material.density": ABSENT,
            "initial.velocity": ABSENT,
        },
    ]
    return [variation for beside in settings for variation in vary(CONTACT, epsilon, 0.0, beside=beside)]


def _heat_of_friction() -> list[Variation]:
    """What it depends on beside the laws: the rule, the degree, the scheme, the coupling."""
    contact = "boundary.bottom.contact"
    settings: list[Flat] = [
        {"space.degree": 2, f"{contact}.compliance.exponent": 1.5},
        {"mesh.cell": "tensor", f"{contact}.quadrature": "vertex"},
        {"time.scheme": "midpoint", f"{contact}.foundation_velocity": ["0.4*cos(9*t)", 0.0]},
        {"time.scheme": "generalized-alpha", "time.coupling": "iterated"},
        {"time.coupling": "iterated", f"{contact}.friction.regularisation": 0.0},
        {f"{contact}.conductance": ABSENT, "heat.conductivity": CONDUCTOR},
        {"solver.strategy": "newton-krylov", f"{contact}.foundation_velocity": [0.4, 0.0]},
    ]
    return [
        variation
        for beside in settings
        for variation in vary(CONTACT, f"{contact}.friction.heat_share", 0.9, beside=beside)
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
        for key, variations in {**_conditions(side), **contact_on(side)}.items():
            table.setdefault(f"boundary.NAME.{key}", []).extend(variations)
    table["boundary.NAME.contact.quadrature"] += _every_rule()
    table["boundary.NAME.contact.friction.regularisation"] += _exact_friction()
    table["boundary.NAME.spring.stiffness"] += _on_springs()
    table["boundary.NAME.convection.coefficient"] += _held_by_convection()
    table["boundary.NAME.contact.friction.heat_share"] += _heat_of_friction()
    return table


VARIATIONS = _variations()
