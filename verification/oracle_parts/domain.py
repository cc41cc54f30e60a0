"""The mesh, its named sides, and data given by expressions: nodal fields, loads and prescribed values."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
import ufl
from dolfinx import fem
from dolfinx import mesh as dmesh
from dolfinx.fem import petsc as fem_petsc
from petsc4py import PETSc

from oracle_parts.expressions import Expression
from oracle_parts.portability import settle_geometry
from oracle_parts.scene import Scene

Ints = npt.NDArray[np.int32]


def create_mesh(comm: Any, scene: Scene) -> Any:
    """Without ghost cells: every local cell is owned, so that local numbers of cells are global ones shifted."""
    mesh = dmesh.create_rectangle(
        comm,
        [np.array(scene.lower), np.array(scene.upper)],
        scene.cells,
        cell_type=dmesh.CellType.triangle,
        ghost_mode=dmesh.GhostMode.none,
        diagonal=getattr(dmesh.DiagonalType, scene.diagonal),
    )
    settle_geometry(mesh)
    mesh.topology.create_connectivity(1, 2)
    mesh.topology.create_connectivity(2, 1)
    return mesh


def node_points(space: Any, scene: Scene) -> npt.NDArray[np.float64]:
    """Coordinates of the local nodes, put exactly on the grid of the mesh's nodes.

    Where dolfinx computes a node's place, 0 may come out as 1e-19, and an expression with a jump at 0 goes astray.
    """
    points = np.array(space.tabulate_dof_coordinates())
    per_square = 4  # a crossed mesh of degree 2 has nodes at quarters
    for axis in range(2):
        lower, upper = scene.lower[axis], scene.upper[axis]
        intervals = per_square * scene.cells[axis]
        number = np.rint((points[:, axis] - lower) / (upper - lower) * intervals)
        points[:, axis] = np.where(number == intervals, upper, lower + number * ((upper - lower) / intervals))
    return points


class Side:
    """One side of the rectangle: its facets on this process, and integrals over it.

    Each side carries its own tags with the same number, so that equal laws on two sides compile to one kernel.
    """

    def __init__(self, mesh: Any, scene: Scene, name: str) -> None:
        axis, place = {
            "left": (0, "lower"),
            "right": (0, "upper"),
            "bottom": (1, "lower"),
            "top": (1, "upper"),
        }[name]
        exterior = dmesh.exterior_facet_indices(mesh.topology)
        distance = dmesh.compute_midpoints(mesh, 1, exterior)[:, axis] - getattr(scene, place)[axis]
        on_side = np.abs(distance) < 1e-9 * (scene.upper[axis] - scene.lower[axis])
        self.name, self.mesh = name, mesh
        self.facets: Ints = np.sort(exterior[on_side]).astype(np.int32)
        self.tags = dmesh.meshtags(mesh, 1, self.facets, np.ones(len(self.facets), dtype=np.int32))

    def ds(self, metadata: dict[str, Any] | None = None) -> Any:
        return ufl.Measure(
            "ds", domain=self.mesh, subdomain_data=self.tags, subdomain_id=1, metadata=metadata or {}
        )


class Nodal:
    """A finite element function that interpolates one expression per component; only on a side if one is given."""

    def __init__(
        self, space: Any, scene: Scene, expressions: Sequence[Expression], side: Side | None = None
    ) -> None:
        self.function = fem.Function(space)
        self.expressions = expressions
        self.varies_in_time = any(expression.varies_in_time for expression in expressions)
        self.nodes: Any = slice(None) if side is None else fem.locate_dofs_topological(space, 1, side.facets)
        self.points = node_points(space, scene)[self.nodes]
        self._set(0.0)

    def update(self, time: float) -> None:
        if self.varies_in_time:
            self._set(time)

    def _set(self, time: float) -> None:
        values = self.function.x.array.reshape(-1, len(self.expressions))
        for component, expression in enumerate(self.expressions):
            values[self.nodes, component] = expression(self.points, time)


class Loads:
    """The right-hand side's external part; what does not vary in time is assembled once."""

    def __init__(self, test_form: Any) -> None:
        self.moving: list[tuple[Nodal, Any]] = []
        self.constant = fem_petsc.create_vector(test_form)
        self.vector = self.constant.duplicate()

    def add(self, data: Nodal, form: Any) -> None:
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
        dofs = fem.locate_dofs_topological(space, 1, side.facets)
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
