"""Norms over the body of the difference of two results folders, on meshes of any cells and degree 1 or 2.

A mesh is a tensor lattice: boxes between coordinates along each axis, equally spaced or not, each a quadrilateral or
hexahedron or split into simplices in any way; its coordinates are read from the results. Both functions are evaluated
at the points of a Gauss rule in each cell of one mesh, the reference's, exact to twice its degree. Where each of its
cells lies in a cell of the other mesh (lattices that are nested, diagonals in one direction), both are polynomials
there and the integrals are exact; elsewhere the rule, of degree 4 at least, meets kinks inside of cells, and the norms
are off by up to 4 % of themselves (tested between uniform and graded lattices). Two meshes that are the same, as of one
Gmsh file, may be of any form.

    body = Body(fine.mesh)
    body.norms(coarse, fine)     [time, norm]: ||w - w'||_L2, ||eps(u - u')||_L2, ||theta - theta'||_L2

A field that the results do not have counts 0. The norms are those of the paper's E_hk (its Figure 5).
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from pathlib import Path

import basix
import numpy as np
import numpy.typing as npt
import scipy.sparse as sparse

from oracle_parts import vtu

NORMS = ("velocity_l2", "displacement_strain_l2", "temperature_l2")
FIELDS = ("velocity", "displacement", "temperature")  # that these are norms of
DEGREES = {5: 1, 9: 1, 10: 1, 12: 1, 22: 2, 24: 2, 28: 2, 29: 2}  # of the cells, by VTK's type
OUTSIDE = 1e-7  # of a cell's size: what round-off may put a point beyond its cell
SAME = 1e-9  # of the body's size: coordinates closer than this are one
LEAST_RULE = 4  # degree: one for the kinks of functions on other lattices
MOST_IN_A_BOX = 8  # lattice lines that a cell may span: a mesh with more is no lattice
Array = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]
Frame = Mapping[str, Array]  # the fields at the nodes, by name


@dataclass(frozen=True)
class Kind:
    """A cell's shape and Lagrange element; nodes in VTK's order."""

    shape: basix.CellType
    degree: int
    order: Sequence[int]  # the place of VTK's nodes among Basix's
    vertices: int

    @property
    def simplex(self) -> bool:
        return self.shape in (basix.CellType.triangle, basix.CellType.tetrahedron)

    @property
    def axes(self) -> list[int]:
        """The vertices, in VTK's order, at the ends of the reference axes; the origin is the first vertex."""
        return {3: [1, 2], 4: [1, 2, 3] if self.simplex else [1, 3], 8: [1, 3, 4]}[self.vertices]

    def tabulate(self, at: Array) -> Array:
        """[1 + d, point, node]: the values and the derivatives along the reference axes."""
        family, variant = basix.ElementFamily.P, basix.LagrangeVariant.gll_warped
        element = basix.create_element(family, self.shape, self.degree, variant)
        table: Array = element.tabulate(1, at)[..., 0][:, :, self.order]
        return table


def kind_of(cell_type: int) -> Kind:
    for (name, _), (number, order) in vtu.VTK_CELLS.items():
        if number == cell_type and number in DEGREES:
            return Kind(getattr(basix.CellType, name), DEGREES[number], order, vtu.VERTICES[number])
    raise ValueError(f"cells of VTK's type {cell_type}")


class Mesh:
    """points[n, d]; cells[m, nodes of a cell] in VTK's order."""

    def __init__(self, points: Array, cells: Integers, cell_type: int) -> None:
        self.kind = kind_of(cell_type)
        self.points = points[:, : len(self.kind.axes)]
        self.cells = cells
        self.key = hash((cell_type, self.points.tobytes(), cells.tobytes()))

    @property
    def dimension(self) -> int:
        return self.points.shape[1]

    @property
    def corners(self) -> Array:
        """[cell, vertex, axis]"""
        return self.points[self.cells[:, : self.kind.vertices]]

    @cached_property
    def lines(self) -> list[Array]:
        """The coordinates between which boxes lie, along each axis."""
        places = self.corners.reshape(-1, self.dimension)
        extent = float(np.ptp(places, axis=0).max())
        found = []
        for along in places.T:
            values = np.unique(along)
            found.append(values[np.append(True, np.diff(values) > SAME * extent)])
        return found

    @cached_property
    def boxes(self) -> Integers:
        """[box, candidate]: the cells that reach into each box of the lattice, -1 where there are fewer."""
        low, high = self.corners.min(axis=1), self.corners.max(axis=1)
        first, last = self.box_of(low + 0.01 * (high - low)), self.box_of(high - 0.01 * (high - low))
        span = (last - first).max(axis=0) + 1
        if np.any(span > MOST_IN_A_BOX):
            raise ValueError("the mesh is no lattice, and not that of the other results")
        pairs = []
        for offset in product(*(range(count) for count in span)):
            reaches = np.flatnonzero(np.all(first + offset <= last, axis=1))
            pairs.append(np.stack([self.number(first[reaches] + offset), reaches]))
        box, cell = np.concatenate(pairs, axis=1)
        order = np.argsort(box, kind="stable")
        box, cell = box[order], cell[order]
        count = int(np.prod([len(line) - 1 for line in self.lines]))
        begin = np.searchsorted(box, np.arange(count))
        place = np.arange(len(box)) - begin[box]
        table = np.full((count, int(place.max()) + 1), -1, dtype=np.int64)
        table[box, place] = cell
        return table

    def box_of(self, at: Array) -> Integers:
        """[point, axis]"""
        columns = [
            np.clip(np.searchsorted(line, along, side="right") - 1, 0, len(line) - 2)
            for line, along in zip(self.lines, at.T)
        ]
        return np.stack(columns, axis=1).astype(np.int64)

    def number(self, box: Integers) -> Integers:
        counts = [len(line) - 1 for line in self.lines]
        return np.ravel_multi_index(tuple(box.T), counts).astype(np.int64)

    def jacobians(self) -> Array:
        """[cell, axis, reference axis] of cells that are images of the reference cell under affine maps."""
        corners = self.corners
        return np.stack([corners[:, vertex] - corners[:, 0] for vertex in self.kind.axes], axis=2)

    def locate(self, at: Array) -> tuple[Integers, Array]:
        """Of each point its cell and its place in the reference cell. Raises ValueError where it has none."""
        candidates = self.boxes[self.number(self.box_of(at))]
        inverse, origin = np.linalg.inv(self.jacobians()), self.corners[:, 0]
        cell = np.full(len(at), -1, dtype=np.int64)
        place, depth = np.zeros_like(at), np.full(len(at), -np.inf)
        for column in candidates.T:
            here = np.einsum("pij,pj->pi", inverse[column], at - origin[column])
            last = 1.0 - here.sum(axis=1) if self.kind.simplex else (1.0 - here).min(axis=1)
            inside = np.where(column >= 0, np.minimum(here.min(axis=1), last), -np.inf)
            better = inside > depth
            cell[better], place[better], depth[better] = column[better], here[better], inside[better]
        if float(depth.min(initial=0.0)) < -OUTSIDE:
            raise ValueError(f"no cell at {at[int(np.argmin(depth))].tolist()}")
        return cell, place


@dataclass(frozen=True)
class Solution:
    mesh: Mesh
    times: Sequence[float]
    frames: Sequence[Frame]


def read(folder: Path) -> Solution:
    """The fields of the body at every output time. Raises OSError, ValueError."""
    entries = [entry for entry in vtu.read_collection(folder / "fields.pvd") if entry.part == 0]
    if not entries:
        raise ValueError(f"{folder}: no fields were written")
    grids = [vtu.read_grid(folder / entry.file) for entry in entries]
    frames = [{name: grid.point_data[name] for name in FIELDS if name in grid.point_data} for grid in grids]
    mesh = Mesh(grids[0].points, grids[0].cells, grids[0].cell_type)
    return Solution(mesh, [entry.time for entry in entries], frames)


@dataclass(frozen=True)
class Operators:
    """From nodal values to those at the points of the rule: of the function, and its derivative along each axis."""

    value: sparse.csr_matrix
    derivative: Sequence[sparse.csr_matrix]


class Body:
    """Integrals over the body by a Gauss rule in each cell of one mesh."""

    def __init__(self, mesh: Mesh) -> None:
        self.mesh, self.kept = mesh, dict[int, Operators]()
        rule, weights = basix.make_quadrature(mesh.kind.shape, max(2 * mesh.kind.degree, LEAST_RULE))
        self.rule = np.asarray(rule)
        jacobian = self._jacobian(mesh)
        geometry = Kind(mesh.kind.shape, 1, vertex_order(mesh.kind), mesh.kind.vertices).tabulate(self.rule)
        self.points = np.einsum("qv,cvi->cqi", geometry[0], mesh.corners).reshape(-1, mesh.dimension)
        self.weights = (np.abs(np.linalg.det(jacobian)) * weights).ravel()

    def _jacobian(self, mesh: Mesh) -> Array:
        """[cell, point of the rule, axis, reference axis]"""
        geometry = Kind(mesh.kind.shape, 1, vertex_order(mesh.kind), mesh.kind.vertices).tabulate(self.rule)
        jacobian: Array = np.einsum("rqv,cvi->cqir", geometry[1:], mesh.corners)
        return jacobian

    def operators(self, mesh: Mesh) -> Operators:
        if mesh.key not in self.kept:
            same = self._same_cells(mesh)
            self.kept[mesh.key] = self._in_same_cells(mesh) if same else self._anywhere(mesh)
        return self.kept[mesh.key]

    def _same_cells(self, mesh: Mesh) -> bool:
        own, other = self.mesh.corners, mesh.corners
        return (
            mesh.kind.shape == self.mesh.kind.shape
            and own.shape == other.shape
            and np.array_equal(own, other)
        )

    def _in_same_cells(self, mesh: Mesh) -> Operators:
        table = np.repeat(mesh.kind.tabulate(self.rule)[:, None], len(mesh.cells), axis=1)
        inverse = np.linalg.inv(self._jacobian(mesh))
        nodes = np.repeat(mesh.cells, len(self.rule), axis=0)
        flat = table.reshape(len(table), len(nodes), -1)
        return assembled(mesh, nodes, flat, inverse.reshape(-1, mesh.dimension, mesh.dimension))

    def _anywhere(self, mesh: Mesh) -> Operators:
        cell, place = mesh.locate(self.points)
        inverse = np.linalg.inv(mesh.jacobians())[cell]
        return assembled(mesh, mesh.cells[cell], mesh.kind.tabulate(place), inverse)

    def squares(self, mesh: Mesh, frame: Frame, other: Mesh, exact: Frame | None) -> Array:
        """[norm, point of the rule]: w.w, eps(u):eps(u) and theta^2 of the difference; `exact` None: of `frame`."""
        result = np.zeros((len(NORMS), len(self.weights)))
        for row, name in enumerate(FIELDS):
            if name not in frame:
                continue
            one = self._evaluated(mesh, frame, name)
            two = None if exact is None else self._evaluated(other, exact, name)
            result[row] = np.square(one if two is None else one - two).sum(axis=1)
        return result

    def _evaluated(self, mesh: Mesh, frame: Frame, name: str) -> Array:
        operators = self.operators(mesh)
        values = frame[name].reshape(len(mesh.points), -1)[:, : mesh.dimension]
        if name != "displacement":
            flat: Array = operators.value @ values
            return flat
        gradient = np.stack([along @ values for along in operators.derivative], axis=2)
        strain = 0.5 * (gradient + gradient.transpose(0, 2, 1))
        return strain.reshape(len(strain), -1)

    def norms(self, one: Solution, two: Solution | None = None) -> Array:
        """[time, norm] of the difference of two solutions at the same times, or of one. Raises ValueError."""
        if two and not (len(one.times) == len(two.times) and np.allclose(one.times, two.times, rtol=1e-9)):
            raise ValueError(f"outputs at {len(one.times)} and {len(two.times)} times that differ")
        others: list[Frame | None] = list(two.frames) if two else [None for _ in one.frames]
        rows = []
        for frame, exact in zip(one.frames, others):
            if two and two.mesh.key == one.mesh.key and exact is not None:
                frame, exact = {name: frame[name] - exact[name] for name in frame}, None
            squares = self.squares(one.mesh, frame, two.mesh if two else one.mesh, exact)
            rows.append(np.sqrt(squares @ self.weights))
        return np.array(rows)


def vertex_order(kind: Kind) -> Sequence[int]:
    """Of the element of degree 1 on the same cell."""
    name = str(kind.shape).rsplit(".", 1)[-1]
    return vtu.VTK_CELLS[(name, kind.vertices)][1]


def assembled(mesh: Mesh, nodes: Integers, table: Array, inverse: Array) -> Operators:
    """`nodes`[point, node of the cell], `table`[1 + d, point, node], `inverse`[point, reference axis, axis]."""
    rows = np.repeat(np.arange(len(nodes)), nodes.shape[1])
    shape = (len(nodes), len(mesh.points))

    def matrix(entries: Array) -> sparse.csr_matrix:
        return sparse.csr_matrix((entries.ravel(), (rows, nodes.ravel())), shape=shape)

    slopes = np.einsum("rpn,pri->ipn", table[1:], inverse)
    return Operators(matrix(table[0]), [matrix(along) for along in slopes])
