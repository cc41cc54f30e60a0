"""The scene of a manufactured solution: its laws, and its initial and prescribed values printed from UFL."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import ufl

from manufactured_parts import cases
from manufactured_parts.cases import CASES, Case, Contact
from manufactured_parts.expression import Printer

Keys = dict[str, Any]
TOLERANCE = 1e-13  # of each nonlinear solve, relative: below every error that is measured


@dataclass(frozen=True)
class Cell:
    """A kind of cell that the driver has: the keys of its meshes, and by degree the cells a side whose errors are
    compared, fine enough for the orders to show."""

    name: str
    dim: int
    mesh: Mapping[str, Any]
    sizes: Mapping[int, Sequence[int]]
    diagonals: bool = False  # whether mesh.diagonal means something

    @property
    def steps_in_space(self) -> int:
        """Any number serves the study in space, and every step costs; `opening` wants steps before and after."""
        return 8 if self.dim == 2 else 4

    @property
    def cells_in_time(self) -> int:
        """Any number serves the study in time."""
        return 4 if self.dim == 2 else 2


PLANE = {1: (16, 32, 64, 128), 2: (8, 16, 32, 64)}
CELLS = {
    "triangle": Cell("triangle", 2, {"shape": "rectangle"}, PLANE, diagonals=True),
    "quadrilateral": Cell("quadrilateral", 2, {"shape": "rectangle", "cell": "tensor"}, PLANE),
    "tetrahedron": Cell("tetrahedron", 3, {"shape": "box"}, {1: (12, 15, 18, 21), 2: (5, 6, 8, 10)}),
    "hexahedron": Cell(
        "hexahedron", 3, {"shape": "box", "cell": "tensor"}, {1: (4, 6, 9, 13), 2: (3, 4, 6, 8)}
    ),
}
DIAGONALS = {
    "mechanics": "right",
    "heat": "left",
    "coupled": "crossed",
    "slipping": "left",
    "opening": "right",
    "rated": "left",
    "rubbing": "crossed",
}

# In every dimension: on top everything is prescribed; the left side is a roller with a prescribed temperature, and so,
# without that, is the front one; the others carry tractions and heat fluxes, the bottom one contact where the case has
# it. With less to hold it the box bends, an error of order 2 p in L2 that hides the p + 1 up to sizes far too large.
CLAMPED, CONTACT = "top", "bottom"
ROLLERS = {"left": 0, "front": 2}  # the component of u that is prescribed


@dataclass(frozen=True)
class Resolution:
    cell: Cell
    degree: int
    cells: int  # a side
    steps: int
    scheme: str


def scene(study: str, name: str, at: Resolution) -> str:
    """As TOML, one dotted key a line."""
    cell, degree = at.cell, at.degree
    case, printer = CASES[name], Printer(cell.name, cell.dim)
    keys: Keys = {f"mesh.{key}": value for key, value in cell.mesh.items()}
    if cell.diagonals:
        keys["mesh.diagonal"] = DIAGONALS[name]
    keys |= {
        "mesh.lower": [0.0] * cell.dim,
        "mesh.upper": [1.0] * cell.dim,
        "mesh.cells": [at.cells] * cell.dim,
        "space.degree": degree,
        "time.end": cases.END,
        "time.steps": at.steps,
        "time.scheme": at.scheme,
        "solver.strategy": "condensed",  # the program is linked without PETSc
        "solver.tolerance": TOLERANCE,
    }
    if case.material:
        keys |= mechanics(study, case, printer, degree)
    if case.heat:
        keys |= heat(study, case, printer, degree)
    if case.contact:
        keys |= contact(study, case.contact, printer, degree)
    return "".join(f"{key} = {json.dumps(value)}\n" for key, value in keys.items())


def mechanics(study: str, case: Case, printer: Printer, degree: int) -> Keys:
    m = case.material
    assert m is not None
    u = cases.displacement(study, printer.x, printer.t, degree)
    rollers = {side: axis for side, axis in ROLLERS.items() if axis < len(u)}
    return {
        "material.density": m.density,
        "material.elasticity.young": m.young,
        "material.elasticity.poisson": m.poisson,
        **({"material.elasticity.plane": "strain"} if len(u) == 2 else {}),
        "material.viscosity.trace": m.trace,
        "material.viscosity.shear": m.shear,
        "initial.displacement": printer.components(u),
        "initial.velocity": printer.components(printer.rate(u)),
        f"boundary.{CLAMPED}.displacement": printer.components(u),
        **{
            f"boundary.{side}.displacement": [
                printer.text(u[i]) if i == axis else "free" for i in range(len(u))
            ]
            for side, axis in rollers.items()
        },
    }


def heat(study: str, case: Case, printer: Printer, degree: int) -> Keys:
    h, d = case.heat, len(printer.x)
    assert h is not None
    theta = printer.text(cases.temperature(study, case, printer.x, printer.t, degree))
    keys = {
        "heat.capacity": h.capacity,
        "heat.conductivity": h.conductivity(d),
        "initial.temperature": theta,
        f"boundary.{CLAMPED}.temperature": theta,
        "boundary.left.temperature": theta,
    }
    if case.coupled:
        keys["heat.thermal_stress"] = h.thermal_stress(d)
        keys["heat.strain_heating"] = h.strain_heating(d)
    if case.coupled and h.rate_heating:
        keys["heat.strain_rate_heating"] = h.rate_heating(d)
    return keys


def contact(study: str, laws: Contact, printer: Printer, degree: int) -> Keys:
    u = cases.displacement(study, printer.x, printer.t, degree)
    at = f"boundary.{CONTACT}.contact"
    air = printer.text(cases.foundation_temperature(printer.x, printer.t))
    return {
        f"{at}.gap": printer.text(cases.gap(laws, u, printer.t)),
        f"{at}.quadrature": 9,  # the highest: the laws are no polynomials
        f"{at}.compliance.stiffness": laws.stiffness,
        f"{at}.compliance.exponent": laws.exponent,
        f"{at}.friction.coefficient": laws.friction,
        f"{at}.friction.regularisation": laws.regularisation,
        f"{at}.conductance.coefficient": laws.conductance,
        f"{at}.conductance.onset": laws.onset,
        f"{at}.conductance.foundation_temperature": air,
        **rubbing(laws, printer, air),
    }


def rubbing(laws: Contact, printer: Printer, air: str) -> Keys:
    """What only some cases have."""
    keys: Keys = {}
    at = f"boundary.{CONTACT}"
    if laws.velocity:
        keys[f"{at}.contact.foundation_velocity"] = printer.components(
            ufl.as_vector(laws.velocity(printer.x, printer.t))
        )
    if laws.heat_share:
        keys[f"{at}.contact.friction.heat_share"] = laws.heat_share
    if laws.spring:
        keys[f"{at}.spring.stiffness"] = laws.spring(len(printer.x))
        keys[f"{at}.spring.anchor"] = printer.components(ufl.as_vector(cases.anchor(printer.x, printer.t)))
    if laws.convection:
        keys[f"{at}.convection.coefficient"] = laws.convection
        keys[f"{at}.convection.ambient_temperature"] = air
    return keys
