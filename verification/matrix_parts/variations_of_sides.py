"""What is prescribed on a side, what holds it and what cools it, of both tables of variations."""

from matrix_parts.cases import Variation, vary
from matrix_parts.scenes import ABSENT, BESIDE, OPPOSITE, Flat
from matrix_parts.values import CONTACT, SPRINGS


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


def on_springs() -> list[Variation]:
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


def held_by_convection() -> list[Variation]:
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


def conditions(side: str) -> dict[str, list[Variation]]:
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
