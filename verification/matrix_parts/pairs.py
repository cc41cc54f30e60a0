"""All pairs of switches: the fewest scenes, or nearly, in which every two settings that are legal together meet.

A full product of the factors below has some 10^9 scenes. An error that needs two switches to be set together (a law
that forgets the other's term) is met by a pair; three or more are left to chance and to together.py.
"""

from collections.abc import Iterator, Mapping
from itertools import combinations

from matrix_parts.cases import Case
from matrix_parts.scenes import ABSENT, BASES, Flat, changed
from matrix_parts.values import CONDUCTOR, COUPLING, ELASTIC_TENSOR, SPRINGS, VISCOUS_TENSOR

BASE = "contact bottom"
SIDE = "boundary.bottom.contact"
Row = dict[str, str]
Pair = frozenset[tuple[str, str]]

# Each setting is a change of the base scene, which has every physics switched on
FACTORS: Mapping[str, Mapping[str, Flat]] = {
    "density": {"on": {}, "off": {"material.density": ABSENT, "initial.velocity": ABSENT}},
    "elasticity": {
        "plane stress": {},
        "plane strain": {"material.elasticity.plane": "strain"},
        "tensor": {"material.elasticity": ABSENT, "material.elasticity.tensor": ELASTIC_TENSOR},
        "off": {"material.elasticity": ABSENT},
    },
    "viscosity": {
        "isotropic": {},
        "tensor": {"material.viscosity": ABSENT, "material.viscosity.tensor": VISCOUS_TENSOR},
        "off": {"material.viscosity": ABSENT},
    },
    "capacity": {"on": {}, "off": {"heat.capacity": ABSENT}},
    "conductivity": {
        "number": {},
        "matrix": {"heat.conductivity": CONDUCTOR},
        "off": {"heat.conductivity": ABSENT},
    },
    "thermal stress": {
        "number": {},
        "matrix": {"heat.thermal_stress": COUPLING},
        "off": {"heat.thermal_stress": ABSENT},
    },
    "strain heating": {
        "number": {},
        "matrix": {"heat.strain_heating": COUPLING},
        "off": {"heat.strain_heating": ABSENT},
    },
    "strain rate heating": {
        "off": {},
        "number": {"heat.strain_rate_heating": -0.4},
        "matrix": {"heat.strain_rate_heating": COUPLING},
    },
    "source": {"number": {}, "moving": {"heat.source": "x - 2*y*t"}, "off": {"heat.source": ABSENT}},
    "body force": {
        "number": {},
        "moving": {"load.body_force": ["t*x", "-1 - y*t"]},
        "off": {"load.body_force": ABSENT},
    },
    "spring": {
        "off": {},
        "number": {"boundary.right.spring.stiffness": 3.0},
        "matrix": {
            "boundary.right.spring.stiffness": SPRINGS,
            "boundary.right.spring.anchor": ["0.1*t*y", "0.02 - t*t"],
        },
    },
    "traction": {"on": {}, "off": {"boundary.left.traction": ABSENT}},
    "heat flux": {"on": {}, "off": {"boundary.left.heat_flux": ABSENT}},
    "lid": {
        "moves": {},
        "rolls": {
            "boundary.top.displacement": ["free", "-0.02 - 0.05*t"],
            "boundary.right.displacement": [0.0, "free"],
        },
    },
    "compliance": {
        "linear": {},
        "power": {f"{SIDE}.compliance.exponent": 1.5},
        "off": {f"{SIDE}.compliance": ABSENT},
    },
    "friction": {"on": {}, "off": {f"{SIDE}.friction": ABSENT}},
    "foundation": {"at rest": {}, "moves": {f"{SIDE}.foundation_velocity": ["0.2 - 0.3*x*t", 0.1]}},
    "friction heat": {"off": {}, "on": {f"{SIDE}.friction.heat_share": 0.7}},
    "convection": {
        "off": {},
        "on": {
            "boundary.right.convection.coefficient": 1.7,
            "boundary.right.convection.ambient_temperature": "2 - y + t",
        },
    },
    "conductance": {
        "unlimited": {},
        "limited": {f"{SIDE}.conductance.limit": 0.7},
        "off": {f"{SIDE}.conductance": ABSENT},
    },
    "gap": {"fixed": {}, "moving": {f"{SIDE}.gap": "0.004*cos(5*x - 9*t) - 0.006"}},
    "quadrature": {"Gauss": {}, "vertex": {f"{SIDE}.quadrature": "vertex"}},
    "second contact": {
        "off": {},
        "on": {
            "boundary.right.contact.gap": "0.01*y - 0.005 + 0.01*t",
            "boundary.right.contact.compliance.stiffness": 50.0,
            "boundary.right.contact.friction.coefficient": 0.6,
            "boundary.right.contact.friction.regularisation": 2e-3,
            "boundary.right.contact.conductance.coefficient": 0.7,
            "boundary.right.contact.conductance.onset": 0.01,
            "boundary.right.contact.conductance.foundation_temperature": "-1 + y",
        },
    },
    "initial": {"given": {}, "rest": {"initial": ABSENT}},
    "scheme": {
        "backward Euler": {},
        "bdf2": {"time.scheme": "bdf2"},
        "midpoint": {"time.scheme": "midpoint"},
        "generalized-alpha": {"time.scheme": "generalized-alpha"},
    },
    "coupling": {"lagged": {}, "iterated": {"time.coupling": "iterated"}},
    "degree": {"1": {}, "2": {"space.degree": 2}},
    "diagonal": {
        "right": {},
        "left": {"mesh.diagonal": "left"},
        "crossed": {"mesh.diagonal": "crossed"},
    },
}

# Settings that no scene may have together, as the scene's rules say
ILLEGAL: tuple[Pair, ...] = (
    frozenset({("elasticity", "off"), ("viscosity", "off")}),
    frozenset({("capacity", "off"), ("conductivity", "off")}),
    frozenset({("compliance", "off"), ("friction", "on")}),
    frozenset({("compliance", "off"), ("foundation", "moves")}),
    frozenset({("compliance", "off"), ("friction heat", "on")}),
    frozenset({("friction", "off"), ("foundation", "moves")}),
    frozenset({("friction", "off"), ("friction heat", "on")}),
    frozenset({("compliance", "off"), ("conductance", "off")}),
)


def legal(row: Row) -> bool:
    settings = set(row.items())
    return not any(pair <= settings for pair in ILLEGAL)


def all_pairs() -> list[Pair]:
    pairs = []
    for (a, settings_a), (b, settings_b) in combinations(FACTORS.items(), 2):
        pairs += [frozenset({(a, x), (b, y)}) for x in settings_a for y in settings_b]
    return [pair for pair in pairs if pair not in ILLEGAL]


def rows() -> Iterator[Row]:
    """Greedy: begin with the first pair not met yet, then give each factor the setting that meets most new ones."""
    left = dict.fromkeys(all_pairs())
    while left:
        row: Row = dict(sorted(next(iter(left))))
        for factor in sorted(set(FACTORS) - set(row), key=list(FACTORS).index):
            options = [setting for setting in FACTORS[factor] if legal({**row, factor: setting})]
            row[factor] = max(options, key=lambda setting: _news(left, row, factor, setting))
        for pair in combinations(row.items(), 2):
            left.pop(frozenset(pair), None)
        yield row


def _news(left: Mapping[Pair, None], row: Row, factor: str, setting: str) -> int:
    return sum(frozenset({(factor, setting), other}) in left for other in row.items())


def scene(row: Row) -> Flat:
    result = BASES[BASE]
    for factor in FACTORS:
        result = changed(result, FACTORS[factor][row[factor]])
    return result


def pair_cases() -> list[Case]:
    return [
        Case("pairs", f"{number}: " + "/".join(row[factor] for factor in FACTORS), scene(row))
        for number, row in enumerate(rows(), 1)
    ]
