"""The laws of contact on a side, built in and from files, of both tables of variations."""

from matrix_parts.body_law_files import LAWS
from matrix_parts.cases import Variation, vary
from matrix_parts.scenes import ABSENT, Flat, base_name
from matrix_parts.values import CONDUCTOR, CONTACT, DEFAULT


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


def every_rule() -> list[Variation]:
    """Gauss rules of an odd degree have the points of the even degree below."""
    quadrature = "boundary.bottom.contact.quadrature"
    return [
        *vary(CONTACT, quadrature, 4, same=DEFAULT),
        *vary(CONTACT, quadrature, 5, same="degrees 4 and 5 both take three points"),
        *vary(CONTACT, quadrature, 2, 3, 6, 8, 9),
        *vary("contact without heat", quadrature, 1, 9, "vertex", beside={"space.degree": 2}),
    ]


def exact_friction() -> list[Variation]:
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


def heat_of_friction() -> list[Variation]:
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
