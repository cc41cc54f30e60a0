"""The scene of a manufactured solution: its laws, and its initial and prescribed values printed from UFL."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

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


CELLS = {
    "triangle": Cell(
        "triangle",
        2,
        mesh={"shape": "rectangle"},
        sizes={1: (16, 32, 64, 128), 2: (8, 16, 32, 64)},
        diagonals=True,
    ),
}
DIAGONALS = {
    "mechanics": "right",
    "heat": "left",
    "coupled": "crossed",
    "slipping": "left",
    "opening": "right",
}

# In every dimension: on top everything is prescribed; the left side is a roller with a prescribed temperature; the
# others carry tractions and heat fluxes, the bottom one contact where the case has it.
CLAMPED, ROLLER, CONTACT = "top", "left", "bottom"


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
    free = ["free"] * (len(u) - 1)
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
        f"boundary.{ROLLER}.displacement": [printer.text(u[0]), *free],
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
        f"boundary.{ROLLER}.temperature": theta,
    }
    if case.coupled:
        keys["heat.thermal_stress"] = h.thermal_stress(d)
        keys["heat.strain_heating"] = h.strain_heating(d)
    return keys


def contact(study: str, laws: Contact, printer: Printer, degree: int) -> Keys:
    u = cases.displacement(study, printer.x, printer.t, degree)
    at = f"boundary.{CONTACT}.contact"
    return {
        f"{at}.gap": printer.text(cases.gap(laws, u, printer.t)),
        f"{at}.quadrature": 9,  # the highest: the laws are no polynomials
        f"{at}.compliance.stiffness": laws.stiffness,
        f"{at}.compliance.exponent": laws.exponent,
        f"{at}.friction.coefficient": laws.friction,
        f"{at}.friction.regularisation": laws.regularisation,
        f"{at}.conductance.coefficient": laws.conductance,
        f"{at}.conductance.onset": laws.onset,
        f"{at}.conductance.foundation_temperature": printer.text(
            cases.foundation_temperature(printer.x, printer.t)
        ),
    }
