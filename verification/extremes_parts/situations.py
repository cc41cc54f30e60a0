"""Situations that no single parameter makes: one cell, slivers, rest, impact, everything open, stuck or slipping."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from extremes_parts.parameters import BASE, CONTACT, IN_SPACE
from matrix_parts.scenes import ABSENT, Flat, changed


@dataclass(frozen=True)
class Situation:
    name: str
    scene: Flat
    singular: bool = False


def situations() -> Iterator[Situation]:
    for name, changes in (
        *_TIME.items(),
        *_MESH.items(),
        *_CONTACT.items(),
        *_COUPLED.items(),
        *_LOADS.items(),
    ):
        yield Situation(name, changed(BASE, changes))
    for name, changes in _SINGULAR.items():
        yield Situation(name, changed(BASE, changes), singular=True)


def situations_in_space() -> Iterator[Situation]:
    for name, changes in _IN_SPACE.items():
        yield Situation(name, changed(IN_SPACE, changes))
    for name, changes in _SINGULAR_IN_SPACE.items():
        yield Situation(name, changed(IN_SPACE, changes), singular=True)


_FREE = {"boundary.top": ABSENT, "boundary.left.temperature": ABSENT, "boundary.right.temperature": ABSENT}
_NO_LOAD = {
    "load": ABSENT,
    "heat.source": ABSENT,
    "boundary.left.traction": ABSENT,
    "boundary.right.traction": ABSENT,
}
_MECHANICS_ONLY = {
    "heat": ABSENT,
    f"{CONTACT}.conductance": ABSENT,
    **{f"boundary.{side}.temperature": ABSENT for side in ("top", "left", "right")},
}
_STATIC = {"material.density": ABSENT, "material.viscosity": ABSENT}

_TIME: dict[str, dict[str, Any]] = {
    "one step for all of T": {"time.steps": 1},
    "one step for a very long T": {"time.steps": 1, "time.end": 1e9},
    "steps of 1e-9": {"time.end": 8e-9},
    "20 thousand steps": {"mesh.cells": [4, 4], "time.steps": 20000, "output.fields": []},
}

_MESH: dict[str, dict[str, Any]] = {
    "one cell": {"mesh.cells": [1, 1]},
    "one tensor cell": {"mesh.cells": [1, 1], "mesh.cell": "tensor"},
    "one cell of degree 2": {"mesh.cells": [1, 1], "space.degree": 2},
    "cells stretched 1e4 : 1": {"mesh.upper": [1e4, 1.0]},
    "cells stretched 1 : 1e4": {"mesh.upper": [1.0, 1e4]},
    "slivers, crossed": {"mesh.upper": [1e3, 1.0], "mesh.diagonal": "crossed"},
    "stretched tensor cells of degree 2": {
        "mesh.upper": [1e4, 1.0],
        "mesh.cell": "tensor",
        "space.degree": 2,
    },
    "a body of 1e-6 m": {"mesh.upper": [1e-6, 1e-6]},
    "a body of 1e6 m": {"mesh.upper": [1e6, 1e6]},
    "far from the origin": {"mesh.lower": [1e6, 1e6], "mesh.upper": [1e6 + 1, 1e6 + 1]},
}

_CONTACT: dict[str, dict[str, Any]] = {
    "initial penetration": {f"{CONTACT}.gap": -0.5},
    "initial penetration of the whole size": {f"{CONTACT}.gap": -100.0},
    "gap of both signs": {f"{CONTACT}.gap": "0.1*sin(20*x)"},
    "never in contact": {f"{CONTACT}.gap": 1e6},
    "huge initial velocity": {"initial.velocity": [1e6, -1e6], "boundary.top.displacement": ABSENT},
    "impact": {
        **_MECHANICS_ONLY,
        **_NO_LOAD,
        "boundary.top": ABSENT,
        "initial.velocity": [0.0, -10.0],
        f"{CONTACT}.gap": 0.1,
        "material.viscosity": ABSENT,
        "time.steps": 64,
    },
    "impact on a stiff foundation, aslant": {
        **_MECHANICS_ONLY,
        **_NO_LOAD,
        "boundary.top": ABSENT,
        "initial.velocity": [5.0, -10.0],
        f"{CONTACT}.gap": 0.1,
        f"{CONTACT}.compliance.stiffness": 1e10,
        "material.viscosity": ABSENT,
        "time.steps": 64,
    },
    "everything stuck": {f"{CONTACT}.friction.coefficient": 10.0, "load.body_force": [0.1, -100.0]},
    "everything slipping": {
        "boundary.top.displacement": ["t", "-0.01*t"],
        f"{CONTACT}.friction.regularisation": 1e-8,
    },
    "opening and closing each step": {
        "boundary.top.displacement": [0.0, "0.05*cos(8*pi*t)"],
        f"{CONTACT}.gap": 0.01,
        "time.steps": 32,
    },
    "slip that turns round each step": {"boundary.top.displacement": ["0.05*cos(8*pi*t)", -0.01]},
    "clamped side touching the contact side": {
        "boundary.right.displacement": [0.0, 0.0],
        "boundary.right.traction": ABSENT,
    },
    "pressure of exponent 3": {
        f"{CONTACT}.compliance.exponent": 3.0,
        f"{CONTACT}.compliance.stiffness": 1e10,
    },
    "nodal contact": {f"{CONTACT}.quadrature": "vertex", f"{CONTACT}.compliance.stiffness": 1e12},
}

_COUPLED: dict[str, dict[str, Any]] = {
    # to 1e46 m/s: friction's regularisation is 50 decades from there, more than continuation has rungs for
    "a coupling that blows up": {
        "time.end": 660764.1253389312,
        "material.density": 41.53953447931316,
        "material.elasticity.young": 0.0019898985132590988,
        "material.elasticity.poisson": 0.3494228995668749,
        "material.elasticity.plane": "strain",
        "material.viscosity.trace": 3.427418987606361e-06,
        "material.viscosity.shear": 3.427418987606361e-06,
        "heat.conductivity": 4.2393376508460997e-07,
        "heat.thermal_stress": [[89.66815725771993] * 2] * 2,
        "heat.strain_heating": [[-38106.13486751737] * 2] * 2,
        f"{CONTACT}.compliance.stiffness": 3.059850050377747,
        f"{CONTACT}.friction.coefficient": 5.8184931612172806,
        f"{CONTACT}.friction.regularisation": 1.9019431220485285e-08,
        f"{CONTACT}.conductance.coefficient": 79.17808944531461,
        f"{CONTACT}.conductance.onset": 2.272290949028921e-07,
        f"{CONTACT}.conductance.foundation_temperature": 2.498631764801766,
        f"{CONTACT}.conductance.limit": 0.08571467408535323,
    },
    # capacity/step times the temperature is 1e9 W, what still flows a few
    "heat that flows no more, steps of 2e-6": {
        "time.end": 1.506779874025787e-05,
        "heat.conductivity": 2.8685408897605087e-06,
        f"{CONTACT}.conductance.coefficient": 8880863901.439009,
        f"{CONTACT}.conductance.onset": 7.786291445162985e-11,
        f"{CONTACT}.conductance.foundation_temperature": -4828.695964190038,
        f"{CONTACT}.conductance.limit": 1389.7541363513676,
        f"{CONTACT}.compliance.stiffness": 0.018751724669862857,
    },
    # rounding the displacement is worth a tenth of the weight, and only the balance of forces tells
    "a stiff body turned by its initial displacement": {
        **_MECHANICS_ONLY,
        "boundary": ABSENT,
        "time.end": 0.08,
        "initial.displacement": ["0.3 - 1.1*y", "1.1*x - 0.7"],
        "material.elasticity.young": 1e14,
        "material.viscosity": ABSENT,
    },
}

_LOADS: dict[str, dict[str, Any]] = {
    "no load at all": {**_NO_LOAD, f"{CONTACT}.conductance.foundation_temperature": 0.0},
    "free fall": {**_FREE, f"{CONTACT}.gap": 1e3},
    "loads of 1e12": {"load.body_force": [1e12, -1e12]},
    "loads of 1e-12": {**_NO_LOAD, "load.body_force": [1e-12, -1e-12]},
    "heat only, stationary": {
        "material": ABSENT,
        "load": ABSENT,
        "heat.thermal_stress": ABSENT,
        "heat.strain_heating": ABSENT,
        "heat.capacity": ABSENT,
        "boundary.top.displacement": ABSENT,
        "boundary.left.traction": ABSENT,
        "boundary.right.traction": ABSENT,
        f"{CONTACT}.compliance": ABSENT,
        f"{CONTACT}.friction": ABSENT,
    },
    "singular K": {"heat.conductivity": [[1.0, 1.0], [1.0, 1.0]]},
    "nearly singular K": {"heat.conductivity": [[1.0, 1.0 - 1e-13], [1.0 - 1e-13, 1.0]]},
}

_SINGULAR: dict[str, dict[str, Any]] = {
    "static and free, open": {
        **_MECHANICS_ONLY,
        **_STATIC,
        **_NO_LOAD,
        "boundary.top": ABSENT,
        f"{CONTACT}.gap": 1.0,
    },
    "static, held by frictionless contact only": {
        **_MECHANICS_ONLY,
        **_STATIC,
        **_FREE,
        f"{CONTACT}.friction": ABSENT,
    },
    "stationary heat, insulated": {
        "heat.capacity": ABSENT,
        f"{CONTACT}.gap": 1.0,
        **{f"boundary.{side}.temperature": ABSENT for side in ("top", "left", "right")},
    },
}

_IN_SPACE: dict[str, dict[str, Any]] = {
    "epsilon = 0": {f"{CONTACT}.friction.regularisation": 0.0},
    "epsilon = 0, hexahedra": {f"{CONTACT}.friction.regularisation": 0.0, "mesh.cell": "tensor"},
    "one cell": {"mesh.cells": [1, 1, 1], "mesh.cell": "tensor"},
    "one cell of degree 2": {"mesh.cells": [1, 1, 1], "mesh.cell": "tensor", "space.degree": 2},
    "one step for all of T": {"time.steps": 1},
    "cells stretched 1e4 : 1": {"mesh.upper": [1e4, 1.0, 1.0]},
    "slivers": {"mesh.upper": [1.0, 1.0, 1e3]},
    "initial penetration": {f"{CONTACT}.gap": -0.5},
    "never in contact": {f"{CONTACT}.gap": 1e6},
    "huge initial velocity": {"initial.velocity": [1e6, -1e6, 1e6], "boundary.top.displacement": ABSENT},
    "impact": {
        **_MECHANICS_ONLY,
        **_NO_LOAD,
        "boundary.top": ABSENT,
        "initial.velocity": [1.0, -10.0, 2.0],
        f"{CONTACT}.gap": 0.1,
        "material.viscosity": ABSENT,
        "time.steps": 32,
    },
    "everything stuck": {
        f"{CONTACT}.friction.coefficient": 10.0,
        "load.body_force": [0.1, -100.0, 0.1],
    },
    "everything slipping": {
        "boundary.top.displacement": ["t", "-0.01*t", "0.5*t"],
        f"{CONTACT}.friction.regularisation": 1e-8,
    },
    "opening and closing each step": {
        "boundary.top.displacement": [0.0, "0.05*cos(8*pi*t)", 0.0],
        f"{CONTACT}.gap": 0.01,
        "time.steps": 32,
    },
    "clamped side touching the contact side": {
        "boundary.right.displacement": [0.0, 0.0, 0.0],
        "boundary.right.traction": ABSENT,
    },
    "no load at all": {**_NO_LOAD, f"{CONTACT}.conductance.foundation_temperature": 0.0},
    "singular K": {"heat.conductivity": [[1.0] * 3] * 3},
}

_SINGULAR_IN_SPACE: dict[str, dict[str, Any]] = {
    "static and free, open": {
        **_MECHANICS_ONLY,
        **_STATIC,
        **_NO_LOAD,
        "boundary.top": ABSENT,
        f"{CONTACT}.gap": 1.0,
    },
}
