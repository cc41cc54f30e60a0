"""The scene as plain data: the keys of the interface that the oracle verifies."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from oracle_parts.errors import SceneError
from oracle_parts.expressions import Expression
from oracle_parts.own_laws import FUNCTIONS, OwnLaw
from oracle_parts.tables import (
    Table,
    count,
    expression,
    list_of,
    load_toml,
    not_negative,
    number,
    one_of,
    positive,
    ratio,
)
from oracle_parts.time_steps import RADII

Matrix = npt.NDArray[np.float64]
OwnLaws = dict[str, OwnLaw]  # by kind
Numbers = dict[str, float]  # by key
SHAPES = {"rectangle": 2, "box": 3}
SIDES = (("left", "right"), ("bottom", "top"), ("front", "back"))  # of each axis
FIELDS = ("displacement", "velocity", "temperature", "stress", "von_mises", "contact")


@dataclass(frozen=True)
class Tensor4:
    """Voigt matrix with engineering shear, and in 2D sigma_zz = out_of_plane * tr(strain); or a law file.

    The order is xx, yy, xy in 2D and xx, yy, zz, yz, xz, xy in 3D.
    """

    voigt: Matrix  # empty where `own` says
    out_of_plane: float = 0.0
    own: OwnLaw | None = None
    plane_strain: bool = False  # of `own`: strains have their components out of the plane


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
    source: Expression | OwnLaw | None
    thermal_stress: Matrix | None
    thermal_stress_zz: float
    strain_heating: Matrix | None
    strain_rate_heating: Matrix | None


@dataclass(frozen=True)
class Compliance:
    stiffness: float  # nan where `own` says
    exponent: float
    own: OwnLaw | None


@dataclass(frozen=True)
class Friction:
    coefficient: float  # nan where `own` says
    regularisation: float
    own: OwnLaw | None
    heat_share: float


@dataclass(frozen=True)
class Conductance:
    coefficient: float  # nan where `own` says
    onset: float
    foundation_temperature: Expression
    limit: float | None
    own: OwnLaw | None


@dataclass(frozen=True)
class Convection:
    coefficient: float
    ambient_temperature: Expression


@dataclass(frozen=True)
class Spring:
    stiffness: Matrix
    anchor: list[Expression] | None  # None: the far ends are fixed


@dataclass(frozen=True)
class Contact:
    gap: Expression
    quadrature: int | str
    foundation_velocity: list[Expression] | None
    compliance: Compliance | None
    friction: Friction | None
    conductance: Conductance | None


@dataclass(frozen=True)
class Boundary:
    """One named side; a component of the displacement that is None is free."""

    displacement: list[Expression | None] | None
    traction: list[Expression] | None
    spring: Spring | None
    temperature: Expression | None
    heat_flux: Expression | None
    convection: Convection | None
    contact: Contact | None


@dataclass(frozen=True)
class Shape:
    """A rectangle or box of simplices or tensor cells; `grading` has the ratios at the two sides of each axis."""

    lower: list[float]
    upper: list[float]
    cells: list[int]
    cell: str
    diagonal: str
    grading: list[tuple[float, float]]


@dataclass(frozen=True)
class Scene:
    dimension: int
    shape: Shape | None  # None: the mesh is that of `file`
    file: Path | None
    degree: int
    end: float
    steps: int
    radius: float | None  # spectral radius of the scheme; None: backward Euler
    coupling_tolerance: float | None  # None: lagged
    adapts: bool  # the steps' sizes to time.tolerance
    adapts_mesh: bool  # to mesh.refinement.tolerance
    material: Material | None
    heat: Heat | None
    regions: dict[str, tuple[Material | None, Heat | None]]  # those that differ from the two above
    body_force: list[Expression] | OwnLaw | None
    initial_displacement: list[Expression]
    initial_velocity: list[Expression]
    initial_temperature: Expression
    boundaries: dict[str, Boundary]  # in alphabetical order
    tolerance: float
    max_iterations: int
    every: int
    fields: list[str]
    resolved: dict[str, Any]
    places: Any = None  # of a mesh that is followed: where its nodes are, exactly

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
    dimension, shape, file = _mesh(mesh, path)
    files = _files(root.table("forms"), path)
    material = _material(root.table("material"), dimension, files)
    heat = _heat(root.table("heat"), material, dimension, files)
    regions = _regions(root.defaulted("region"), material, heat, dimension, files)
    if material is None and heat is None:
        raise SceneError("a scene needs [material], [heat] or both")
    radius, coupling_tolerance = _scheme(time), _coupling(time)
    solver.take("strategy", one_of("auto", "condensed", "newton-krylov"), "auto")
    solver.take("factor", one_of("auto", "double", "single"), "auto")
    if "velocity" in initial and (material is None or material.density is None):
        raise SceneError("initial.velocity needs material.density: a quasi-static scene has no inertia")
    sides = root.defaulted("boundary")
    end = time.take("end", positive)
    scene = Scene(
        dimension=dimension,
        shape=shape,
        file=file,
        degree=space.take("degree", one_of(1, 2), 1),
        end=end,
        steps=_steps(time, end),
        radius=radius,
        coupling_tolerance=coupling_tolerance,
        adapts=time.optional("tolerance", positive) is not None,
        adapts_mesh=_refinement(mesh),
        material=material,
        heat=heat,
        regions=regions,
        body_force=_body_force(load, dimension, files) if load else None,
        initial_displacement=initial.take("displacement", list_of(expression, dimension), dimension * [0.0]),
        initial_velocity=initial.take("velocity", list_of(expression, dimension), dimension * [0.0]),
        initial_temperature=initial.take("temperature", expression, 0.0),
        boundaries={
            name: _boundary(sides, name, material, heat, dimension, files) for name in sorted(sides.left)
        },
        tolerance=solver.take("tolerance", positive, 1e-12),
        max_iterations=solver.take("max_iterations", count, 50),
        every=output.take("every", count, 1),
        fields=[],
        resolved=root.resolved,
    )
    scene.fields.extend(_fields(output, scene))
    output.optional("checkpoint_every", count)  # the oracle does not restart
    for table in (mesh, time, initial, space, solver, output, load, sides, root):
        if table:
            table.close()
    return scene


def _files(table: Table | None, path: Path) -> OwnLaws:
    """The law files, by the law that they take the place of."""
    if table is None:
        return {}
    names = {kind: table.optional(kind, str) for kind in FUNCTIONS}
    table.close()
    return {kind: OwnLaw(kind, path.parent / name) for kind, name in names.items() if name is not None}


def _body_force(load: Table, dimension: int, files: OwnLaws) -> list[Expression] | OwnLaw | None:
    if "body_force" not in files:
        return load.optional("body_force", list_of(expression, dimension))
    return _own_table(load.table("body_force"), "body_force", files)


def _mesh(mesh: Table, path: Path) -> tuple[int, Shape | None, Path | None]:
    """The dimension, and the shape or the file."""
    name = mesh.optional("file", str)
    if name is not None:
        file = path.parent / name
        return max(dimension for dimension, _, _ in group_names(file)), None, file
    dimension = SHAPES[mesh.take("shape", one_of(*SHAPES), "rectangle")]
    lower = mesh.take("lower", list_of(number, dimension), dimension * [0.0])
    upper = mesh.take("upper", list_of(number, dimension), dimension * [1.0])
    cells = mesh.take("cells", list_of(count, dimension))
    cell = mesh.take("cell", one_of("simplex", "tensor"), "simplex")
    diagonal = mesh.take("diagonal", one_of("right", "left", "crossed"), "right")
    return dimension, Shape(lower, upper, cells, cell, diagonal, _grading(mesh, dimension)), None


def _refinement(mesh: Table) -> bool:
    """Whether the mesh adapts; how it does is the driver's own affair (followed_mesh.py)."""
    table = mesh.table("refinement")
    if table is None:
        return False
    table.take("tolerance", positive)
    for limit, value in (("every", 5), ("max_cells", 200000), ("max_level", 30)):
        table.take(limit, not_negative if limit == "max_level" else count, value)
    table.close()
    return True


def _grading(mesh: Table, dimension: int) -> list[tuple[float, float]]:
    ratios = [(1.0, 1.0)] * dimension
    table = mesh.table("grading")
    if table is not None:
        ratios = [
            (table.take(one, ratio, 1.0), table.take(two, ratio, 1.0)) for one, two in SIDES[:dimension]
        ]
        table.close()
    return ratios


def group_names(file: Path) -> list[tuple[int, int, str]]:
    """(dimension, tag, name) of the physical groups in a Gmsh file; that section is text in binary files too."""
    try:
        content = file.read_bytes()
    except OSError as problem:
        raise SceneError(f"{file}: {problem}") from problem
    section = content.partition(b"$PhysicalNames")[2].partition(b"$EndPhysicalNames")[0].decode()
    rows = [row.split(maxsplit=2) for row in section.split("\n")[2:] if row.strip()]
    if not rows:
        raise SceneError(f"{file}: the oracle needs named physical groups")
    return [(int(dimension), int(tag), name.strip().strip('"')) for dimension, tag, name in rows]


def _steps(time: Table, end: float) -> int:
    if "steps" in time:
        return time.take("steps", count)
    step = time.take("step", positive)
    steps = round(end / step)
    if steps < 1 or abs(steps * step - end) > 1e-12 * end:
        raise SceneError("time.step must divide time.end")
    return steps


def _scheme(time: Table) -> float | None:
    """The spectral radius at infinite frequency, or None for backward Euler."""
    scheme = time.take("scheme", one_of(*RADII, "generalized-alpha"), "backward-euler")
    if scheme == "generalized-alpha":
        return time.take("spectral_radius", number, 0.5)
    return RADII[scheme]


def _coupling(time: Table) -> float | None:
    if time.take("coupling", one_of("lagged", "iterated"), "lagged") == "lagged":
        return None
    return time.take("coupling_tolerance", positive, 1e-10)


def _fields(output: Table, scene: Scene) -> list[str]:
    absent = set() if scene.material else {"displacement", "velocity", "stress", "von_mises"}
    absent |= set() if scene.heat else {"temperature"}
    absent |= set() if scene.contacts else {"contact"}
    fields = [name for name in FIELDS if name not in absent]
    return output.take("fields", list_of(one_of(*fields)), fields)


def isotropic(trace: float, shear: float, dimension: int) -> Matrix:
    """Voigt matrix of tau -> trace tr(tau) I + shear tau."""
    size = dimension * (dimension + 1) // 2
    matrix = shear / 2 * np.eye(size)
    matrix[:dimension, :dimension] = trace + shear * np.eye(dimension)
    return matrix


def _voigt(raw: Any) -> Matrix:
    """3 x 3 or 6 x 6, which the form that it enters will check against the dimension."""
    matrix = np.array(list_of(list_of(number, len(raw)), len(raw))(raw))
    if len(matrix) not in (3, 6):
        raise ValueError("expected a Voigt matrix")
    if not np.array_equal(matrix, matrix.T):
        raise ValueError("expected a symmetric matrix")
    return matrix


def _conductor(dimension: int) -> Callable[[Any], Matrix]:
    """Reads a symmetric d x d matrix; the scalar s means s I."""

    def convert(raw: Any) -> Matrix:
        if not isinstance(raw, list):
            return number(raw) * np.eye(dimension)
        matrix = np.array(list_of(list_of(number, dimension), dimension)(raw))
        if not np.array_equal(matrix, matrix.T):
            raise ValueError("expected a symmetric matrix")
        return matrix

    return convert


def _regions(
    tables: Table, material: Material | None, heat: Heat | None, dimension: int, files: OwnLaws
) -> dict[str, tuple[Material | None, Heat | None]]:
    """Each region's laws: its own where it has some, else the scene's."""
    regions = {}
    for name in sorted(tables.left):
        table = tables.table(name)
        assert table is not None
        own_material, own_heat = material, heat
        if (part := table.table("material")) is not None and material is not None:
            own_material = _region_material(part, material, dimension, files)
        if (part := table.table("heat")) is not None and heat is not None:
            own_heat = _region_heat(part, heat, material, dimension, files)
        table.close()
        regions[name] = (own_material, own_heat)
    return regions


def _region_material(table: Table, general: Material, dimension: int, files: OwnLaws) -> Material:
    elasticity, viscosity = table.table("elasticity"), table.table("viscosity")
    plane = "strain" if general.plane_strain else "stress"
    if elasticity is not None and ("young" in elasticity or "elasticity" in files) and dimension == 2:
        elasticity.left.setdefault("plane", plane)
    own = Material(
        table.optional("density", positive),
        _elasticity(elasticity, dimension, files, general.elasticity),
        _viscosity(viscosity, general.plane_strain, dimension, files, general.viscosity),
        general.plane_strain,
    )
    table.close()
    return Material(
        own.density if own.density is not None else general.density,
        own.elasticity or general.elasticity,
        own.viscosity or general.viscosity,
        general.plane_strain,
    )


def _region_heat(
    table: Table, general: Heat, material: Material | None, dimension: int, files: OwnLaws
) -> Heat:
    own = _heat_laws(table, material, dimension, files, general.source)
    zz = own.thermal_stress_zz if own.thermal_stress is not None else general.thermal_stress_zz
    given = {name: value for name, value in vars(own).items() if value is not None}
    return replace(general, **{**given, "thermal_stress_zz": zz})


def _material(table: Table | None, dimension: int, files: OwnLaws) -> Material | None:
    if table is None:
        return None
    density = table.optional("density", positive)
    elasticity, viscosity = table.table("elasticity"), table.table("viscosity")
    table.close()
    if elasticity is None and viscosity is None:
        raise SceneError("material needs elasticity, viscosity or both")
    plane_strain = bool(elasticity and elasticity.left.get("plane") == "strain")
    return Material(
        density,
        _elasticity(elasticity, dimension, files),
        _viscosity(viscosity, plane_strain, dimension, files),
        plane_strain,
    )


def _own_tensor(
    table: Table, kind: str, files: OwnLaws, plane_strain: bool, general: Tensor4 | None
) -> Tensor4:
    before = general.own.numbers if general and general.own else {}
    own = _own(table, kind, files, before)
    table.close()
    return Tensor4(np.empty(0), own=own, plane_strain=plane_strain)


def _elasticity(
    table: Table | None, dimension: int, files: OwnLaws, general: Tensor4 | None = None
) -> Tensor4 | None:
    if table is None:
        return None
    if "elasticity" in files:
        plane = table.take("plane", one_of("stress", "strain"), "stress") if dimension == 2 else "none"
        return _own_tensor(table, "elasticity", files, plane == "strain", general)
    tensor = table.optional("tensor", _voigt)
    if tensor is not None:
        table.close()
        return Tensor4(tensor)
    young, poisson = table.take("young", positive), table.take("poisson", number)
    plane = table.take("plane", one_of("stress", "strain"), "stress") if dimension == 2 else "none"
    table.close()
    shear = young / (1 + poisson)
    if plane == "stress":
        return Tensor4(isotropic(young * poisson / (1 - poisson**2), shear, 2))
    lame = young * poisson / ((1 + poisson) * (1 - 2 * poisson))
    return Tensor4(isotropic(lame, shear, dimension), lame)


def _viscosity(
    table: Table | None, plane_strain: bool, dimension: int, files: OwnLaws, general: Tensor4 | None = None
) -> Tensor4 | None:
    if table is None:
        return None
    if "viscosity" in files:
        return _own_tensor(table, "viscosity", files, plane_strain, general)
    tensor = table.optional("tensor", _voigt)
    if tensor is not None:
        table.close()
        return Tensor4(tensor)
    trace, shear = table.take("trace", number), table.take("shear", number)
    table.close()
    return Tensor4(isotropic(trace, shear, dimension), trace if plane_strain else 0.0)


def _heat(table: Table | None, material: Material | None, dimension: int, files: OwnLaws) -> Heat | None:
    if table is None:
        return None
    heat = _heat_laws(table, material, dimension, files)
    if heat.capacity is None and heat.conductivity is None:
        raise SceneError("heat needs capacity, conductivity or both")
    couplings = (heat.thermal_stress, heat.strain_heating, heat.strain_rate_heating)
    if material is None and any(coupling is not None for coupling in couplings):
        raise SceneError("heat.thermal_stress, strain_heating and strain_rate_heating need [material]")
    return heat


def _source(table: Table, files: OwnLaws, general: Any) -> Expression | OwnLaw | None:
    if "source" not in files:
        return table.optional("source", expression)
    before = general.numbers if isinstance(general, OwnLaw) else {}
    return _own_table(table.table("source"), "source", files, before)


def _heat_laws(
    table: Table, material: Material | None, dimension: int, files: OwnLaws, general: Any = None
) -> Heat:
    conductor = _conductor(dimension)
    out_of_plane = (
        material and material.plane_strain and not isinstance(table.left.get("thermal_stress"), list)
    )
    thermal_stress = table.optional("thermal_stress", conductor)
    heat = Heat(
        capacity=table.optional("capacity", positive),
        conductivity=table.optional("conductivity", conductor),
        source=_source(table, files, general),
        thermal_stress=thermal_stress,
        thermal_stress_zz=float(thermal_stress[0, 0]) if thermal_stress is not None and out_of_plane else 0.0,
        strain_heating=table.optional("strain_heating", conductor),
        strain_rate_heating=table.optional("strain_rate_heating", conductor),
    )
    table.close()
    return heat


def _free_or_expression(raw: Any) -> Expression | None:
    return None if raw == "free" else expression(raw)


def _boundary(
    sides: Table,
    name: str,
    material: Material | None,
    heat: Heat | None,
    dimension: int,
    files: OwnLaws,
) -> Boundary:
    table = sides.table(name)
    assert table is not None
    boundary = Boundary(
        displacement=table.optional("displacement", list_of(_free_or_expression, dimension)),
        traction=table.optional("traction", list_of(expression, dimension)),
        spring=_spring(table.table("spring"), dimension),
        temperature=table.optional("temperature", expression),
        heat_flux=table.optional("heat_flux", expression),
        convection=_convection(table.table("convection")),
        contact=_contact(table.table("contact"), dimension, files),
    )
    table.close()
    contact = boundary.contact
    held_or_pulled = boundary.displacement or boundary.traction or boundary.spring
    mechanical = held_or_pulled or (contact and contact.compliance)
    rubs_warm = contact and contact.friction and contact.friction.heat_share > 0.0
    conducts = contact and contact.conductance
    thermal = boundary.temperature or boundary.heat_flux or boundary.convection or conducts or rubs_warm
    if (mechanical and material is None) or (thermal and heat is None):
        raise SceneError(f"boundary.{name} has a condition on a field that the scene does not model")
    if boundary.temperature and (boundary.heat_flux or boundary.convection or conducts):
        raise SceneError(f"boundary.{name}: temperature excludes heat_flux, convection and conductance")
    return boundary


def _finite(value: float | None) -> float | None:
    """An infinite limit is no limit: the law stays linear."""
    return None if value is None or np.isinf(value) else value


def _own_table(
    table: Table | None, kind: str, files: OwnLaws, before: Numbers | None = None
) -> OwnLaw | None:
    if table is None:
        return None
    own = _own(table, kind, files, before)
    table.close()
    return own


def _own(table: Table, kind: str, files: OwnLaws, before: Numbers | None = None) -> OwnLaw | None:
    """The law of a file with the numbers of this table, over those `before`; None: the built-in law."""
    law = files.get(kind)
    if law is None:
        return None
    numbers = dict(before or {})
    for declared in law.declarations():
        if declared.key in numbers and declared.key not in table:
            continue
        if declared.default is not None and declared.key not in table:
            numbers[declared.key] = float(declared.default)
            if np.isfinite(declared.default):
                table.take(declared.key, number, declared.default)
            continue
        numbers[declared.key] = table.take(declared.key, number)
        if not declared.admits(numbers[declared.key]):
            raise SceneError(f"{table.key(declared.key)} is out of its range")
    return OwnLaw(kind, law.path, numbers)


def _compliance(table: Table, files: OwnLaws) -> Compliance:
    if own := _own(table, "compliance", files):
        return Compliance(np.nan, np.nan, own)
    return Compliance(table.take("stiffness", positive), table.take("exponent", positive, 1.0), None)


def _convection(table: Table | None) -> Convection | None:
    if table is None:
        return None
    convection = Convection(
        table.take("coefficient", not_negative), table.take("ambient_temperature", expression)
    )
    table.close()
    return convection


def _spring(table: Table | None, dimension: int) -> Spring | None:
    if table is None:
        return None
    spring = Spring(
        table.take("stiffness", _conductor(dimension)),
        table.optional("anchor", list_of(expression, dimension)),
    )
    table.close()
    return spring


def _friction(table: Table, files: OwnLaws) -> Friction:
    own = _own(table, "friction", files)
    coefficient = np.nan if own else table.take("coefficient", number)
    return Friction(
        coefficient,
        table.take("regularisation", not_negative),
        own,
        table.take("heat_share", not_negative) if "heat_share" in table else 0.0,
    )


def _conductance(table: Table, files: OwnLaws) -> Conductance:
    own = _own(table, "conductance", files)
    foundation = table.take("foundation_temperature", expression)
    if own:
        return Conductance(np.nan, np.nan, foundation, None, own)
    return Conductance(
        coefficient=table.take("coefficient", number),
        onset=table.take("onset", positive),
        foundation_temperature=foundation,
        limit=_finite(table.optional("limit", positive)),
        own=None,
    )


def _contact(table: Table | None, dimension: int, files: OwnLaws) -> Contact | None:
    if table is None:
        return None
    compliance, friction = table.table("compliance"), table.table("friction")
    conductance = table.table("conductance")
    if friction and compliance is None:
        raise SceneError(f"{table.path}.friction needs compliance")
    contact = Contact(
        gap=table.take("gap", expression, 0.0),
        foundation_velocity=table.optional("foundation_velocity", list_of(expression, dimension)),
        quadrature=table.take("quadrature", lambda raw: raw if raw == "vertex" else count(raw), 4),
        compliance=_compliance(compliance, files) if compliance else None,
        friction=_friction(friction, files) if friction else None,
        conductance=_conductance(conductance, files) if conductance else None,
    )
    for part in (table, compliance, friction, conductance):
        if part:
            part.close()
    return contact
