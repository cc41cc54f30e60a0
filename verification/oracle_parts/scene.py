"""The scene as plain data: the keys of the interface for the two-dimensional scenes that the oracle verifies."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from oracle_parts.errors import SceneError
from oracle_parts.expressions import Expression
from oracle_parts.tables import Table, count, expression, list_of, load_toml, number, one_of, positive

Matrix = npt.NDArray[np.float64]
SIDES = ("bottom", "left", "right", "top")
FIELDS = ("displacement", "velocity", "temperature", "stress", "von_mises", "contact")


@dataclass(frozen=True)
class Tensor4:
    """Voigt matrix (xx, yy, xy with engineering shear), and sigma_zz = out_of_plane * tr(strain)."""

    voigt: Matrix
    out_of_plane: float = 0.0


@dataclass(frozen=True)
class Material:
    density: float | None
    elasticity: Tensor4 | None
    viscosity: Tensor4 | None
    plane_strain: bool  # there is an out-of-plane stress to report


@dataclass(frozen=True)
class Heat:
    capacity: float | None
    conductivity: Matrix | None
    source: Expression | None
    thermal_stress: Matrix | None
    thermal_stress_zz: float
    strain_heating: Matrix | None


@dataclass(frozen=True)
class Compliance:
    stiffness: float
    exponent: float


@dataclass(frozen=True)
class Friction:
    coefficient: float
    regularisation: float


@dataclass(frozen=True)
class Conductance:
    coefficient: float
    onset: float
    foundation_temperature: Expression
    limit: float | None


@dataclass(frozen=True)
class Contact:
    gap: Expression
    quadrature: int | str
    compliance: Compliance | None
    friction: Friction | None
    conductance: Conductance | None


@dataclass(frozen=True)
class Boundary:
    """One named side; a component of the displacement that is None is free."""

    displacement: list[Expression | None] | None
    traction: list[Expression] | None
    temperature: Expression | None
    heat_flux: Expression | None
    contact: Contact | None


@dataclass(frozen=True)
class Scene:
    lower: list[float]
    upper: list[float]
    cells: list[int]
    diagonal: str
    degree: int
    end: float
    steps: int
    material: Material | None
    heat: Heat | None
    body_force: list[Expression] | None
    initial_displacement: list[Expression]
    initial_velocity: list[Expression]
    initial_temperature: Expression
    boundaries: dict[str, Boundary]  # in alphabetical order
    tolerance: float
    max_iterations: int
    every: int
    fields: list[str]
    resolved: dict[str, Any]

    @property
    def step(self) -> float:
        return self.end / self.steps

    @property
    def contacts(self) -> dict[str, Contact]:
        return {name: side.contact for name, side in self.boundaries.items() if side.contact}


def read_scene(path: Path, settings: Sequence[str]) -> Scene:
    root = Table(load_toml(path, settings))
    root.take("title", str, "")
    mesh, time, initial = root.defaulted("mesh"), root.defaulted("time"), root.defaulted("initial")
    space, solver, output = root.defaulted("space"), root.defaulted("solver"), root.defaulted("output")
    load = root.table("load")
    material = _material(root.table("material"))
    heat = _heat(root.table("heat"), material)
    if material is None and heat is None:
        raise SceneError("a scene needs [material], [heat] or both")
    mesh.take("shape", one_of("rectangle"), "rectangle")
    mesh.take("cell", one_of("simplex"), "simplex")
    time.take("scheme", one_of("backward-euler"), "backward-euler")
    solver.take("strategy", one_of("auto", "condensed", "newton-krylov"), "auto")
    if "velocity" in initial and (material is None or material.density is None):
        raise SceneError("initial.velocity needs material.density: a quasi-static scene has no inertia")
    sides = root.defaulted("boundary")
    end = time.take("end", positive)
    scene = Scene(
        lower=mesh.take("lower", list_of(number, 2), [0.0, 0.0]),
        upper=mesh.take("upper", list_of(number, 2), [1.0, 1.0]),
        cells=mesh.take("cells", list_of(count, 2)),
        diagonal=mesh.take("diagonal", one_of("right", "left", "crossed"), "right"),
        degree=space.take("degree", one_of(1, 2), 1),
        end=end,
        steps=_steps(time, end),
        material=material,
        heat=heat,
        body_force=load.optional("body_force", list_of(expression, 2)) if load else None,
        initial_displacement=initial.take("displacement", list_of(expression, 2), [0.0, 0.0]),
        initial_velocity=initial.take("velocity", list_of(expression, 2), [0.0, 0.0]),
        initial_temperature=initial.take("temperature", expression, 0.0),
        boundaries={name: _boundary(sides, name, material, heat) for name in sorted(sides.left)},
        tolerance=solver.take("tolerance", positive, 1e-12),
        max_iterations=solver.take("max_iterations", count, 50),
        every=output.take("every", count, 1),
        fields=[],
        resolved=root.resolved,
    )
    scene.fields.extend(_fields(output, scene))
    for table in (mesh, time, initial, space, solver, output, load, sides, root):
        if table:
            table.close()
    return scene


def _steps(time: Table, end: float) -> int:
    if "steps" in time:
        return time.take("steps", count)
    step = time.take("step", positive)
    steps = round(end / step)
    if steps < 1 or abs(steps * step - end) > 1e-12 * end:
        raise SceneError("time.step must divide time.end")
    return steps


def _fields(output: Table, scene: Scene) -> list[str]:
    absent = set() if scene.material else {"displacement", "velocity", "stress", "von_mises"}
    absent |= set() if scene.heat else {"temperature"}
    absent |= set() if scene.contacts else {"contact"}
    fields = [name for name in FIELDS if name not in absent]
    return output.take("fields", list_of(one_of(*fields)), fields)


def isotropic(trace: float, shear: float) -> Matrix:
    """Voigt matrix of tau -> trace tr(tau) I + shear tau."""
    return np.array([[trace + shear, trace, 0.0], [trace, trace + shear, 0.0], [0.0, 0.0, shear / 2]])


def _voigt(raw: Any) -> Matrix:
    matrix = np.array(list_of(list_of(number, 3), 3)(raw))
    if not np.array_equal(matrix, matrix.T):
        raise ValueError("expected a symmetric matrix")
    return matrix


def _conductor(raw: Any) -> Matrix:
    """A symmetric 2 x 2 matrix; the scalar s means s I."""
    if not isinstance(raw, list):
        return number(raw) * np.eye(2)
    matrix = np.array(list_of(list_of(number, 2), 2)(raw))
    if not np.array_equal(matrix, matrix.T):
        raise ValueError("expected a symmetric matrix")
    return matrix


def _material(table: Table | None) -> Material | None:
    if table is None:
        return None
    density = table.optional("density", positive)
    elasticity, viscosity = table.table("elasticity"), table.table("viscosity")
    table.close()
    if elasticity is None and viscosity is None:
        raise SceneError("material needs elasticity, viscosity or both")
    plane_strain = bool(elasticity and elasticity.left.get("plane") == "strain")
    return Material(density, _elasticity(elasticity), _viscosity(viscosity, plane_strain), plane_strain)


def _elasticity(table: Table | None) -> Tensor4 | None:
    if table is None:
        return None
    tensor = table.optional("tensor", _voigt)
    if tensor is not None:
        table.close()
        return Tensor4(tensor)
    young, poisson = table.take("young", positive), table.take("poisson", number)
    plane = table.take("plane", one_of("stress", "strain"), "stress")
    table.close()
    shear = young / (1 + poisson)
    if plane == "stress":
        return Tensor4(isotropic(young * poisson / (1 - poisson**2), shear))
    lame = young * poisson / ((1 + poisson) * (1 - 2 * poisson))
    return Tensor4(isotropic(lame, shear), lame)


def _viscosity(table: Table | None, plane_strain: bool) -> Tensor4 | None:
    if table is None:
        return None
    tensor = table.optional("tensor", _voigt)
    if tensor is not None:
        table.close()
        return Tensor4(tensor)
    trace, shear = table.take("trace", number), table.take("shear", number)
    table.close()
    return Tensor4(isotropic(trace, shear), trace if plane_strain else 0.0)


def _heat(table: Table | None, material: Material | None) -> Heat | None:
    if table is None:
        return None
    out_of_plane = (
        material and material.plane_strain and not isinstance(table.left.get("thermal_stress"), list)
    )
    thermal_stress = table.optional("thermal_stress", _conductor)
    heat = Heat(
        capacity=table.optional("capacity", positive),
        conductivity=table.optional("conductivity", _conductor),
        source=table.optional("source", expression),
        thermal_stress=thermal_stress,
        thermal_stress_zz=float(thermal_stress[0, 0]) if thermal_stress is not None and out_of_plane else 0.0,
        strain_heating=table.optional("strain_heating", _conductor),
    )
    table.close()
    if heat.capacity is None and heat.conductivity is None:
        raise SceneError("heat needs capacity, conductivity or both")
    if material is None and (thermal_stress is not None or heat.strain_heating is not None):
        raise SceneError("heat.thermal_stress and heat.strain_heating need [material]")
    return heat


def _free_or_expression(raw: Any) -> Expression | None:
    return None if raw == "free" else expression(raw)


def _boundary(sides: Table, name: str, material: Material | None, heat: Heat | None) -> Boundary:
    if name not in SIDES:
        raise SceneError(f"boundary.{name}: the sides of a rectangle are {', '.join(SIDES)}")
    table = sides.table(name)
    assert table is not None
    boundary = Boundary(
        displacement=table.optional("displacement", list_of(_free_or_expression, 2)),
        traction=table.optional("traction", list_of(expression, 2)),
        temperature=table.optional("temperature", expression),
        heat_flux=table.optional("heat_flux", expression),
        contact=_contact(table.table("contact")),
    )
    table.close()
    contact = boundary.contact
    mechanical = boundary.displacement or boundary.traction or (contact and contact.compliance)
    thermal = boundary.temperature or boundary.heat_flux or (contact and contact.conductance)
    if (mechanical and material is None) or (thermal and heat is None):
        raise SceneError(f"boundary.{name} has a condition on a field that the scene does not model")
    if boundary.temperature and (boundary.heat_flux or (contact and contact.conductance)):
        raise SceneError(f"boundary.{name}: temperature excludes heat_flux and conductance")
    return boundary


def _finite(value: float | None) -> float | None:
    """An infinite limit is no limit: the law stays linear."""
    return None if value is None or np.isinf(value) else value


def _compliance(table: Table) -> Compliance:
    return Compliance(table.take("stiffness", positive), table.take("exponent", positive, 1.0))


def _friction(table: Table) -> Friction:
    return Friction(table.take("coefficient", number), table.take("regularisation", positive))


def _conductance(table: Table) -> Conductance:
    return Conductance(
        coefficient=table.take("coefficient", number),
        onset=table.take("onset", positive),
        foundation_temperature=table.take("foundation_temperature", expression),
        limit=_finite(table.optional("limit", positive)),
    )


def _contact(table: Table | None) -> Contact | None:
    if table is None:
        return None
    compliance, friction = table.table("compliance"), table.table("friction")
    conductance = table.table("conductance")
    if friction and compliance is None:
        raise SceneError(f"{table.path}.friction needs compliance")
    contact = Contact(
        gap=table.take("gap", expression, 0.0),
        quadrature=table.take("quadrature", lambda raw: raw if raw == "vertex" else count(raw), 4),
        compliance=_compliance(compliance) if compliance else None,
        friction=_friction(friction) if friction else None,
        conductance=_conductance(conductance) if conductance else None,
    )
    for part in (table, compliance, friction, conductance):
        if part:
            part.close()
    return contact
