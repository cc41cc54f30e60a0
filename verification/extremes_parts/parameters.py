"""What is pushed to its limits: each parameter of a scene with the values that it takes, alone, in pairs and at random.

The base is the paper's example with K = I on 8 x 8 squares and 8 steps: every physics is on, and a case takes a
fraction of a second.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Final

from matrix_parts.scenes import ABSENT, Flat

CONTACT: Final = "boundary.bottom.contact"
BASE: Final[Flat] = {
    "mesh.cells": [8, 8],
    "time.end": 1.0,
    "time.steps": 8,
    "material.density": 1.0,
    "material.elasticity.young": 2.0,
    "material.elasticity.poisson": 0.1,
    "material.viscosity.trace": 10.0,
    "material.viscosity.shear": 10.0,
    "heat.capacity": 1.0,
    "heat.conductivity": 1.0,
    "heat.source": 1.0,
    "heat.thermal_stress": [[1.0, 1.0], [1.0, 1.0]],
    "heat.strain_heating": [[1.0, 1.0], [1.0, 1.0]],
    "load.body_force": [0.0, -1.0],
    "boundary.top.displacement": [0.0, 0.0],
    "boundary.top.temperature": 0.0,
    "boundary.left.traction": [1.4, 0.4],
    "boundary.left.temperature": 0.0,
    "boundary.right.traction": [-0.8, 0.4],
    "boundary.right.temperature": 0.0,
    f"{CONTACT}.compliance.stiffness": 1e4,
    f"{CONTACT}.friction.coefficient": 0.2,
    f"{CONTACT}.friction.regularisation": 1e-3,
    f"{CONTACT}.conductance.coefficient": 1.0,
    f"{CONTACT}.conductance.onset": 1e-5,
    f"{CONTACT}.conductance.foundation_temperature": 10.0,
}

# A box of the same data: 2 x 2 x 2 cells, pushed along z as well
IN_SPACE: Final[Flat] = BASE | {
    "mesh.shape": "box",
    "mesh.cells": [2, 2, 2],
    "heat.thermal_stress": [[1.0] * 3] * 3,
    "heat.strain_heating": [[1.0] * 3] * 3,
    "load.body_force": [0.0, -1.0, 0.2],
    "boundary.top.displacement": [0.0, 0.0, 0.0],
    "boundary.left.traction": [1.4, 0.4, 0.1],
    "boundary.right.traction": [-0.8, 0.4, 0.1],
}

Changes = Mapping[str, Any]


@dataclass(frozen=True)
class Parameter:
    """One quantity: its values in order, from limit to limit, and the keys that a value sets."""

    name: str
    values: tuple[float, ...]
    keys: Callable[[float], Changes]

    def between(self, fraction: float) -> float:
        """A value between the limits, log-uniform where all are positive; fraction in [0, 1]."""
        low, high = min(self.values), max(self.values)
        if low > 0:
            return float(math.exp(math.log(low) + fraction * (math.log(high) - math.log(low))))
        if (
            high > -low
        ):  # from zero (or a little below) up: over the decades of the positive ones, zero at the end
            positive = [value for value in self.values if value > 0]
            return 0.0 if fraction < 0.1 else Parameter("", tuple(positive), self.keys).between(fraction)
        size = min(abs(value) for value in self.values if value != 0)
        magnitude = math.exp(math.log(size) + abs(2 * fraction - 1) * (math.log(high) - math.log(size)))
        return math.copysign(magnitude, fraction - 0.5)


def key(name: str) -> Callable[[float], Changes]:
    return lambda value: {name: value}


def absent_at_zero(name: str) -> Callable[[float], Changes]:
    """Zero means that the physics is not there."""
    return lambda value: {name: ABSENT if value == 0 else value}


def viscosity(value: float) -> Changes:
    table = "material.viscosity"
    return {f"{table}.trace": value, f"{table}.shear": value} if value > 0 else {table: ABSENT}


def density(value: float) -> Changes:
    return {"material.density": value if value > 0 else ABSENT}


def all_ones(name: str) -> Callable[[float], Changes]:
    """The paper's coupling tensors: every entry the same."""
    return lambda value: {name: [[value, value], [value, value]]}


def poisson(value: float) -> Changes:
    return {"material.elasticity.poisson": value, "material.elasticity.plane": "strain"}


def in_space(changes: Changes) -> Changes:
    """The same of a box: a tensor whose entries are all the same has three rows, and no plane is asked for."""
    return {
        name: [[value[0][0]] * 3] * 3 if isinstance(value, list) else value
        for name, value in changes.items()
        if name != "material.elasticity.plane"
    }


def decades(low: int, high: int, count: int = 5, *others: float) -> tuple[float, ...]:
    powers = (low + (high - low) * i / (count - 1) for i in range(count))
    return (*others, *(float(f"{10.0**power:.3g}") for power in powers))


PARAMETERS: Final = (
    Parameter("c_n", decades(-3, 14, 7), key(f"{CONTACT}.compliance.stiffness")),
    Parameter("epsilon", decades(-14, 2, 9), key(f"{CONTACT}.friction.regularisation")),
    Parameter("mu", (0.0, 1e-3, 0.1, 0.5, 1.0, 3.0, 10.0), key(f"{CONTACT}.friction.coefficient")),
    Parameter("poisson", (-0.99, -0.5, 0.0, 0.3, 0.49, 0.4999, 0.49999), poisson),
    Parameter("viscosity", decades(-8, 8, 5, 0.0), viscosity),
    Parameter("young", decades(-9, 14, 6), key("material.elasticity.young")),
    Parameter("density", decades(-9, 6, 6, 0.0), density),
    Parameter("conductivity", decades(-12, 12, 7, 0.0), absent_at_zero("heat.conductivity")),
    Parameter("M", (-1e6, -1.0, 0.0, 1e-3, 1e3, 1e6), all_ones("heat.thermal_stress")),
    Parameter("R", (-1e6, -1.0, 0.0, 1e-3, 1e3, 1e6), all_ones("heat.strain_heating")),
    Parameter("k_c", decades(-6, 12, 6, 0.0), key(f"{CONTACT}.conductance.coefficient")),
    Parameter("epsilon_c", decades(-16, 0, 6), key(f"{CONTACT}.conductance.onset")),
    Parameter(
        "theta_F", (-1e8, -1.0, 0.0, 1.0, 1e4, 1e8), key(f"{CONTACT}.conductance.foundation_temperature")
    ),
    Parameter("limit", decades(-6, 8, 5), key(f"{CONTACT}.conductance.limit")),
    Parameter("T", decades(-9, 9, 7), key("time.end")),
)

BY_NAME: Final = {parameter.name: parameter for parameter in PARAMETERS}

PAIRS: Final = (
    ("c_n", "epsilon"),
    ("c_n", "mu"),
    ("epsilon", "mu"),
    ("young", "c_n"),
    ("young", "viscosity"),
    ("density", "T"),
    ("poisson", "young"),
    ("k_c", "epsilon_c"),
    ("conductivity", "k_c"),
    ("M", "R"),
    ("theta_F", "M"),
    ("c_n", "T"),
)
