"""What is drawn of a body: in the plane its cells, in space the faces that are seen from one side."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.tri import Triangulation

from oracle_parts import vtu
from plotting.results import Array

# VTK's types of plane cells: how each is split into straight triangles through all its nodes, and its edges
TRIANGLES: dict[int, tuple[tuple[int, ...], ...]] = {
    5: ((0, 1, 2),),
    22: ((0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5)),
    9: ((0, 1, 2), (0, 2, 3)),
    28: ((0, 4, 8), (0, 8, 7), (4, 1, 5), (4, 5, 8), (8, 5, 2), (8, 2, 6), (7, 8, 6), (7, 6, 3)),
}
EDGES: dict[int, tuple[tuple[int, ...], ...]] = {
    5: ((0, 1), (1, 2), (2, 0)),
    22: ((0, 3, 1), (1, 4, 2), (2, 5, 0)),
    9: ((0, 1), (1, 2), (2, 3), (3, 0)),
    28: ((0, 4, 1), (1, 5, 2), (2, 6, 3), (3, 7, 0)),
}
# of solid cells: the type of the faces, and their nodes in its order
FACES: dict[int, tuple[int, tuple[tuple[int, ...], ...]]] = {
    10: (5, ((0, 1, 2), (0, 1, 3), (1, 2, 3), (0, 2, 3))),
    24: (22, ((0, 1, 2, 4, 5, 6), (0, 1, 3, 4, 8, 7), (1, 2, 3, 5, 9, 8), (0, 2, 3, 6, 9, 7))),
    12: (9, ((0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 2, 6, 7), (0, 1, 2, 3), (4, 5, 6, 7))),
    29: (
        28,
        (
            (0, 4, 7, 3, 16, 15, 19, 11, 20),
            (1, 2, 6, 5, 9, 18, 13, 17, 21),
            (0, 1, 5, 4, 8, 17, 12, 16, 22),
            (3, 2, 6, 7, 10, 18, 14, 19, 23),
            (0, 1, 2, 3, 8, 9, 10, 11, 24),
            (4, 5, 6, 7, 12, 13, 14, 15, 25),
        ),
    ),
}
EYE = (0.45, 0.4, 0.8)  # towards the viewer of a body in space, y upwards
SHARP = np.cos(np.radians(30.0))  # between the normals of two faces: a more acute edge belongs to the outline


@dataclass(frozen=True)
class View:
    """From where a body is looked at: rows of `axes` are the picture's axes to the right, upwards and to the viewer."""

    axes: Array
    solid: bool

    def project(self, points: Array) -> Array:
        return np.asarray(points @ self.axes[:2].T)


def view_of(body: vtu.Grid, contact: vtu.Grid | None) -> View:
    """The plane as it is; a body in space from above, or from below where its contact boundary lies low."""
    if body.cell_type not in FACES:
        return View(np.eye(3), False)
    below = contact is not None and contact.points[:, 1].mean() < body.points[:, 1].mean()
    eye = np.array(EYE) * (1.0, -1.0 if below else 1.0, 1.0)
    eye /= np.linalg.norm(eye)
    right = np.cross([0.0, 1.0, 0.0], eye)
    right /= np.linalg.norm(right)
    return View(np.array([right, np.cross(eye, right), eye]), True)


@dataclass(frozen=True)
class Surface:
    """Plane cells over the body's points: cells[n, nodes], the body's cell behind each, hindmost first."""

    cells: Array
    cell_type: int
    owners: Array

    def triangles(self) -> tuple[Array, Array]:
        """All straight triangles, and the body's cell behind each."""
        parts = TRIANGLES[self.cell_type]
        split = np.stack([self.cells[:, part] for part in parts], axis=1).reshape(-1, 3)
        return split, np.repeat(self.owners, len(parts))

    def edges(self) -> tuple[Array, Array]:
        """Each edge once as a row of nodes from end to end, and the surface's cells beside it: -1 if only one."""
        rows = EDGES[self.cell_type]
        every = np.concatenate([self.cells[:, row] for row in rows])
        cells = np.tile(np.arange(len(self.cells)), len(rows))
        ends = np.sort(every[:, [0, -1]], axis=1)
        order = np.lexsort((ends[:, 1], ends[:, 0]))
        first = np.ones(len(order), dtype=bool)
        first[1:] = (ends[order[1:]] != ends[order[:-1]]).any(axis=1)
        starts = np.flatnonzero(first)
        counts = np.diff(np.append(starts, len(order)))
        second = np.where(counts > 1, cells[order[np.minimum(starts + 1, len(order) - 1)]], -1)
        return every[order[starts]], np.stack((cells[order[starts]], second), axis=1)


def surface(grid: vtu.Grid, view: View, points: Array) -> Surface:
    """The cells of a plane grid; of a solid one at these points the outer faces that the viewer sees, hindmost first."""
    if not view.solid:
        return Surface(grid.cells, grid.cell_type, np.arange(len(grid.cells)))
    kind, faces = FACES[grid.cell_type]
    corners = vtu.VERTICES[kind]
    every = np.concatenate([grid.cells[:, face] for face in faces])
    owners = np.tile(np.arange(len(grid.cells)), len(faces))
    keys = np.sort(every[:, :corners], axis=1)
    _, first, count = np.unique(keys, axis=0, return_index=True, return_counts=True)
    outer = first[count == 1]
    every, owners = every[outer], owners[outer]
    middle = points[every[:, :corners]].mean(axis=1)
    inside = points[grid.cells[owners, : vtu.VERTICES[grid.cell_type]]].mean(axis=1)
    facing = _towards(normals(points, every), middle - inside) @ view.axes[2] > 0.0
    depth = middle @ view.axes[2]
    order = np.flatnonzero(facing)[np.argsort(depth[facing], kind="stable")]
    return Surface(every[order], kind, owners[order])


def normals(points: Array, cells: Array) -> Array:
    """Unit normals of plane cells, of either direction."""
    a, b, c = (points[cells[:, corner]] for corner in range(3))
    normal = np.cross(b - a, c - a)
    return np.asarray(normal / np.linalg.norm(normal, axis=1, keepdims=True))


def _towards(vectors: Array, directions: Array) -> Array:
    return np.asarray(vectors * np.sign(np.einsum("ij,ij->i", vectors, directions))[:, None])


def outline(grid: vtu.Grid, view: View) -> Array:
    """Edges at the border of what is seen, and in space those between faces that meet at an angle."""
    seen = surface(grid, view, grid.points)
    edges, beside = seen.edges()
    kept = beside[:, 1] < 0
    if view.solid:
        normal = normals(grid.points, seen.cells)
        along = np.abs(np.einsum("ij,ij->i", normal[beside[:, 0]], normal[beside[:, 1]]))
        kept |= along < SHARP
    return np.asarray(edges[kept])


def triangulation(view: View, points: Array, triangles: Array) -> Triangulation:
    flat = view.project(points)
    return Triangulation(flat[:, 0], flat[:, 1], triangles)


def plane_of(points: Array) -> Sequence[int]:
    """The two axes in which a contact boundary in space extends most."""
    return sorted(np.argsort(np.ptp(points, axis=0), kind="stable")[1:].tolist())
