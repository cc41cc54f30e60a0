"""The mesh, its named boundaries and regions, and data given by expressions: nodal fields, loads and prescribed values."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt
import ufl
from dolfinx import fem
from dolfinx import mesh as dmesh
from dolfinx.fem import petsc as fem_petsc
from petsc4py import PETSc
from scipy.spatial import KDTree

from oracle_parts.errors import SceneError
from oracle_parts.expressions import Expression
from oracle_parts.followed_mesh import FollowedMesh, create, named_parts
from oracle_parts.portability import mesh_of_gmsh, settle_geometry
from oracle_parts.read_mesh import group_names
from oracle_parts.scene import SIDES, Scene, Shape

Array = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int32]


@dataclass(frozen=True)
class Body:
    """The mesh, the facets of each boundary on this process, and the cells of each named region."""

    mesh: Any
    boundaries: dict[str, Ints]
    regions: dict[str, Ints]
    full_rule: dict[str, Any]  # metadata of integrals that name no rule: see `full_rule`

    def dx(self) -> Any:
        """Integration over all cells."""
        return ufl.Measure("dx", domain=self.mesh, metadata=self.full_rule)

    def dx_of(self, names: Sequence[str]) -> list[Any]:
        """Integration over each of these regions, and last over the cells in none of them."""
        tdim = self.mesh.topology.dim
        cells = np.arange(self.mesh.topology.index_map(tdim).size_local, dtype=np.int32)
        numbers = np.full(len(cells), len(names), dtype=np.int32)
        for number, name in enumerate(names):
            numbers[self.regions[name]] = number
        tags = dmesh.meshtags(self.mesh, tdim, cells, numbers)
        dx = ufl.Measure("dx", domain=self.mesh, subdomain_data=tags, metadata=self.full_rule)
        return [dx(number) for number in range(len(names) + 1)]


def create_body(comm: Any, scene: Scene) -> Body:
    """Without ghost cells: every local cell is owned, so that local numbers of cells are global ones shifted."""
    if scene.file:
        mesh, boundaries, regions = _read_file(comm, scene.file, scene.dimension)
    else:
        mesh, regions = _create_shape(comm, scene.shape), {}
        boundaries = _sides(mesh, scene.shape)
        _grade(mesh, scene.shape)
    settle_geometry(mesh)
    missing = [name for name in scene.boundaries if name not in boundaries]
    missing += [name for name in scene.regions if name not in regions]
    if missing:
        raise SceneError(f"the mesh has no boundary or region {missing[0]}")
    return Body(mesh, boundaries, regions, full_rule(mesh, scene.degree))


def follow(comm: Any, scene: Scene, base: Body, followed: FollowedMesh) -> Body:
    """The mesh that the driver has made of the scene's own, `base`."""
    mesh = create(comm, followed, scene.dimension)
    _connect(mesh)
    settle_geometry(mesh)
    boundaries, regions = named_parts(mesh, base.mesh, base.boundaries, base.regions)
    return Body(mesh, boundaries, regions, {})


def full_rule(mesh: Any, degree: int) -> dict[str, Any]:
    """On cells whose geometry is not affine, degree + 1 Gauss points a direction; else what the integrand asks for."""
    tensor = mesh.topology.cell_type in (dmesh.CellType.quadrilateral, dmesh.CellType.hexahedron)
    return {"quadrature_degree": 2 * degree + 1} if tensor else {}


def _create_shape(comm: Any, shape: Shape | None) -> Any:
    assert shape is not None
    corners: list[Any] = [np.array(shape.lower), np.array(shape.upper)]
    types, dimension = dmesh.CellType, len(shape.cells)
    simplex, tensor = {2: (types.triangle, types.quadrilateral), 3: (types.tetrahedron, types.hexahedron)}[
        dimension
    ]
    cell_type = simplex if shape.cell == "simplex" else tensor
    options = {"cell_type": cell_type, "ghost_mode": dmesh.GhostMode.none}
    if dimension == 3:
        return dmesh.create_box(comm, corners, shape.cells, **options)
    diagonal = getattr(dmesh.DiagonalType, shape.diagonal)
    return dmesh.create_rectangle(comm, corners, shape.cells, diagonal=diagonal, **options)


def _sides(mesh: Any, shape: Shape | None) -> dict[str, Ints]:
    """The exterior facets of each side of a rectangle or box."""
    assert shape is not None
    tdim = _connect(mesh)
    exterior = dmesh.exterior_facet_indices(mesh.topology)
    midpoints = dmesh.compute_midpoints(mesh, tdim - 1, exterior)
    sides = {}
    for axis, names in enumerate(SIDES[:tdim]):
        for name, place in zip(names, (shape.lower[axis], shape.upper[axis])):
            near = np.abs(midpoints[:, axis] - place) < 1e-9 * (shape.upper[axis] - shape.lower[axis])
            sides[name] = np.sort(exterior[near]).astype(np.int32)
    return sides


def _grade(mesh: Any, shape: Shape | None) -> None:
    """Moves the points of the uniform mesh to where its grading has them."""
    assert shape is not None
    points = mesh.geometry.x
    for axis, ratios in enumerate(shape.grading):
        if ratios != (1.0, 1.0):
            lower, upper, halves = shape.lower[axis], shape.upper[axis], 2 * shape.cells[axis]
            number = np.rint((points[:, axis] - lower) / (upper - lower) * halves)
            points[:, axis] = _graded(number / halves, lower, upper, ratios)


def _graded(s: Array, lower: float, upper: float, ratios: tuple[float, float]) -> Array:
    """The integral of exp(-g |s - m|), which sizes of cells are in proportion to, scaled to run from lower to upper.

    Sizes are 1 at m, and exp(-g m) = 1/a and exp(-g (1 - m)) = 1/b at the sides.
    """
    a, b = ratios
    g = np.log(a) + np.log(b)
    m = np.log(a) / g
    from_m = np.sign(s - m) * -np.expm1(-g * np.abs(s - m))
    first, last = np.expm1(-g * m), -np.expm1(-g * (1 - m))
    x = lower + (from_m - first) / (last - first) * (upper - lower)
    return np.where(s == 0, lower, np.where(s == 1, upper, x))


def _nodes_along(shape: Shape, axis: int) -> Array:
    """Where nodes of degree 1 or 2 can be on a graded axis: points of cells and centres, and halfway between them."""
    halves = 2 * shape.cells[axis]
    points = _graded(
        np.arange(halves + 1) / halves, shape.lower[axis], shape.upper[axis], shape.grading[axis]
    )
    corners, centres = points[::2], points[1::2]
    edges = (corners[1:] + corners[:-1]) / 2
    spokes = [(corners[:-1] + centres) / 2, (corners[1:] + centres) / 2]
    return np.unique(np.concatenate([points, edges, *spokes]))


def _read_file(comm: Any, file: Path, dimension: int) -> tuple[Any, dict[str, Ints], dict[str, Ints]]:
    """By dolfinx's own way from Gmsh's model to a mesh."""
    import gmsh

    gmsh.initialize(readConfigFiles=False)
    gmsh.option.setNumber("General.Terminal", 0)
    if comm.rank == 0:
        gmsh.open(str(file))
    mesh, cell_tags, facet_tags = mesh_of_gmsh(gmsh.model, comm, dimension)
    gmsh.finalize()
    _connect(mesh)
    found: dict[int, dict[str, Ints]] = {dimension: {}, dimension - 1: {}}
    for group_dimension, tag, name in group_names(file):
        if group_dimension in found:
            tags = cell_tags if group_dimension == dimension else facet_tags
            before = found[group_dimension].get(name, np.empty(0, dtype=np.int32))
            here = tags.indices[tags.values == tag].astype(np.int32)
            found[group_dimension][name] = np.unique(np.concatenate((before, here)))
    return mesh, found[dimension - 1], found[dimension]


def _connect(mesh: Any) -> int:
    tdim: int = mesh.topology.dim
    mesh.topology.create_connectivity(tdim - 1, tdim)
    mesh.topology.create_connectivity(tdim, tdim - 1)
    return tdim


def node_points(space: Any, scene: Scene) -> npt.NDArray[np.float64]:
    """Coordinates of the local nodes; those of a shape put exactly where the mesh's nodes can be.

    Where dolfinx computes a node's place, 0 may come out as 1e-19, and an expression with a jump at 0 goes astray.
    """
    points = np.array(space.tabulate_dof_coordinates())
    if scene.places is not None:
        return np.array(scene.places[KDTree(scene.places).query(points)[1]])
    if scene.shape is None:
        return points
    per_square = 4  # a crossed mesh of degree 2 has nodes at quarters
    for axis, cells in enumerate(scene.shape.cells):
        if scene.shape.grading[axis] != (1.0, 1.0):
            places = _nodes_along(scene.shape, axis)
            between = (places[1:] + places[:-1]) / 2
            points[:, axis] = places[np.searchsorted(between, points[:, axis])]
            continue
        lower, upper = scene.shape.lower[axis], scene.shape.upper[axis]
        intervals = per_square * cells
        number = np.rint((points[:, axis] - lower) / (upper - lower) * intervals)
        points[:, axis] = np.where(number == intervals, upper, lower + number * ((upper - lower) / intervals))
    return points


class Side:
    """One boundary: its facets on this process, and integrals over it.

    Each side carries its own tags with the same number, so that equal laws on two sides compile to one kernel.
    """

    def __init__(self, body: Body, name: str) -> None:
        self.name, self.mesh, self.full_rule = name, body.mesh, body.full_rule
        self.facets = body.boundaries[name]
        self.dimension = self.mesh.topology.dim - 1
        marks = np.ones(len(self.facets), dtype=np.int32)
        self.tags = dmesh.meshtags(self.mesh, self.dimension, self.facets, marks)

    def ds(self, metadata: dict[str, Any] | None = None) -> Any:
        data = {"domain": self.mesh, "subdomain_data": self.tags, "subdomain_id": 1}
        return ufl.Measure("ds", metadata=self.full_rule if metadata is None else metadata, **data)


class Nodal:
    """A finite element function that interpolates one expression per component; only on a side if one is given."""

    def __init__(
        self, space: Any, scene: Scene, expressions: Sequence[Expression], side: Side | None = None
    ) -> None:
        self.function = fem.Function(space)
        self.expressions = expressions
        self.varies_in_time = any(expression.varies_in_time for expression in expressions)
        self.nodes: Any = (
            slice(None) if side is None else fem.locate_dofs_topological(space, side.dimension, side.facets)
        )
        self.points = node_points(space, scene)[self.nodes]
        self._set(0.0)

    def update(self, time: float) -> None:
        if self.varies_in_time:
            self._set(time)

    def _set(self, time: float) -> None:
        values = self.function.x.array.reshape(-1, len(self.expressions))
        for component, expression in enumerate(self.expressions):
            values[self.nodes, component] = expression(self.points, time)


class Data(Protocol):
    """What a load is made of."""

    varies_in_time: bool

    def update(self, time: float) -> None:
        ...


class Loads:
    """The right-hand side's external part; what does not vary in time is assembled once."""

    def __init__(self, test_form: Any) -> None:
        self.moving: list[tuple[Data, Any]] = []
        self.constant = fem_petsc.create_vector(test_form)
        self.vector = self.constant.duplicate()

    def add(self, data: Data, form: Any) -> None:
        if data.varies_in_time:
            self.moving.append((data, form))
        else:
            _assemble_onto(self.constant, form)

    def at(self, time: float) -> Any:
        """The assembled loads at that time; the caller may overwrite the vector until the next call."""
        self.constant.copy(self.vector)
        for data, form in self.moving:
            data.update(time)
            _assemble_onto(self.vector, form)
        return self.vector


def _assemble_onto(vector: Any, form: Any) -> None:
    part = fem_petsc.assemble_vector(form)
    part.ghostUpdate(addv=PETSc.InsertMode.ADD, mode=PETSc.ScatterMode.REVERSE)
    vector.axpy(1.0, part)
    part.destroy()


class Prescribed:
    """Values prescribed on sides. They are applied in the order given; a later one wins at shared nodes."""

    def __init__(self, space: Any, scene: Scene) -> None:
        self.space, self.size = space, space.dofmap.index_map_bs
        self.points = node_points(space, scene)
        self.parts: list[tuple[Ints, Expression]] = []
        self.bcs: list[Any] = []  # homogeneous: they act on corrections, not on the unknown

    def add(self, side: Side, component: int, expression: Expression) -> None:
        space = self.space.sub(component) if self.size > 1 else self.space
        dofs = fem.locate_dofs_topological(space, side.dimension, side.facets)
        self.parts.append((dofs, expression))
        self.bcs.append(fem.dirichletbc(PETSc.ScalarType(0.0), dofs, space))

    @property
    def dofs(self) -> Ints:
        every = [dofs for dofs, _ in self.parts]
        return np.unique(np.concatenate(every)) if every else np.empty(0, dtype=np.int32)

    def apply(self, unknown: Any, time: float, to_unknown: Callable[[Any, Ints], Any]) -> None:
        """unknown[dofs] = to_unknown(prescribed values, dofs)."""
        for dofs, expression in self.parts:
            values = expression(self.points[dofs // self.size], time)
            unknown.x.array[dofs] = to_unknown(values, dofs)
