"""Meshes that the driver has adapted: read from its fields, the scene's boundaries and regions found on them, and fields
carried from one to the next.

The oracle judges what is solved on these meshes and how fields come to them, not how they were chosen. Values at the
nodes of the next mesh are those that the old field has there, from the barycentric coordinates in the cell of the old
mesh that holds the node, found by trying all. Prescribed values are those of the scene at the time.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from dolfinx import mesh as dmesh

from oracle_parts import vtu
from oracle_parts.errors import SceneError
from oracle_parts.portability import cell_nodes, corner_points, simplex_domain

Array = npt.NDArray[Any]
INSIDE = 1e-9  # how far outside of its cell round-off may put a point, in barycentric coordinates


@dataclass(frozen=True)
class FollowedMesh:
    """Nodes as the driver wrote them, and cells by their corners."""

    nodes: Array
    cells: Array

    def same_as(self, other: "FollowedMesh") -> bool:
        return np.array_equal(self.nodes, other.nodes) and np.array_equal(self.cells, other.cells)


def read_mesh(results: Path | None, step: int) -> FollowedMesh:
    """The mesh of a step in a folder of the driver's results, which has the fields of every step."""
    if results is None:
        raise SceneError(
            "mesh.refinement: the oracle adapts no mesh; --follow names results that it is to follow"
        )
    for extension in ("vtu", "pvtu"):
        file = results / "fields" / f"body_{step:06d}.{extension}"
        if file.exists():
            grid = vtu.without_seams(vtu.read_grid(file))
            return FollowedMesh(grid.points, grid.cells[:, : vtu.VERTICES[grid.cell_type]])
    raise SceneError(f"mesh.refinement: {results} has no fields of step {step}; write them at every step")


def create(comm: Any, followed: FollowedMesh, dimension: int) -> Any:
    """A mesh of the corners; one process."""
    if comm.size > 1:
        raise SceneError("mesh.refinement: the oracle follows meshes on one process only")
    corners, numbers = np.unique(followed.cells, return_inverse=True)
    kind = "triangle" if dimension == 2 else "tetrahedron"
    cells = numbers.reshape(followed.cells.shape).astype(np.int64)
    return dmesh.create_mesh(
        comm, cells, followed.nodes[corners, :dimension].copy(), simplex_domain(kind, dimension)
    )


def barycentric(corners: Array, points: Array) -> Array:
    """Of each point in each simplex, [points, simplices, corners]; simplices may lie in a plane or on a line."""
    origin, edges = corners[:, 0], corners[:, 1:] - corners[:, :1]
    inverse = np.linalg.pinv(edges)  # [simplices, 3, edges]: from positions to coordinates
    rest = np.einsum("psi,sie->pse", points[:, None] - origin[None], inverse)
    return np.concatenate([1 - rest.sum(axis=2, keepdims=True), rest], axis=2)


def holders(corners: Array, points: Array) -> tuple[Array, Array]:
    """The simplex that holds each point, -1: none, and the coordinates there."""
    cells, places = np.full(len(points), -1), np.zeros((len(points), corners.shape[1]))
    flat = corners.shape[1] <= 3 and len(corners) > 0
    for first in range(0, len(points), 64):
        some = points[first : first + 64]
        found = barycentric(corners, some)
        worst = found.min(axis=2)
        if flat:  # of facets, a point may lie beside the plane as well
            away = np.einsum("psc,sci->psi", found, corners) - some[:, None]
            size = np.abs(corners - corners[:, :1]).max(axis=(1, 2))
            worst = np.where(np.abs(away).max(axis=2) < INSIDE * size, worst, -1.0)
        best = worst.argmax(axis=1)
        rows = np.arange(len(some))
        inside = worst[rows, best] > -INSIDE
        cells[first : first + 64] = np.where(inside, best, -1)
        places[first : first + 64] = found[rows, best]
    return cells, places


def shape_functions(places: Array, degree: int, pairs: list[tuple[int, int]]) -> Array:
    """Of Lagrange's simplex at barycentric coordinates [points, corners]; `pairs`: the ends of its edges in order."""
    if degree == 1:
        return places
    edges = [4 * places[:, a] * places[:, b] for a, b in pairs]
    return np.concatenate([places * (2 * places - 1), np.stack(edges, axis=1)], axis=1)


PAIRS = {3: [(1, 2), (0, 2), (0, 1)], 4: [(2, 3), (1, 3), (1, 2), (0, 3), (0, 2), (0, 1)]}


class Carrier:
    """Carries functions of one space of Lagrange's elements to another of the same kind."""

    def __init__(self, old: Any, new: Any, degree: int) -> None:
        points = old.tabulate_dof_coordinates()
        self.nodes = cell_nodes(old, old.mesh.topology.index_map(old.mesh.topology.dim).size_local)
        count = old.mesh.topology.dim + 1
        cells, places = holders(points[self.nodes[:, :count]], new.tabulate_dof_coordinates())
        if (cells < 0).any():
            raise SceneError("mesh.refinement: a node of the next mesh lies outside of the last one")
        self.rows, self.weights = self.nodes[cells], shape_functions(places, degree, PAIRS[count])
        self.size = old.dofmap.index_map_bs

    def __call__(self, values: Array) -> Array:
        nodal = values.reshape(-1, self.size)
        return np.einsum("nj,njc->nc", self.weights, nodal[self.rows]).ravel()


def named_parts(
    mesh: Any, base: Any, boundaries: Mapping[str, Array], regions: Mapping[str, Array]
) -> tuple[dict[str, Array], dict[str, Array]]:
    """The facets and cells of `mesh` that lie in those of each name of `base`."""
    tdim = mesh.topology.dim
    found: list[dict[str, Array]] = [{}, {}]
    exterior = dmesh.exterior_facet_indices(mesh.topology)
    every = np.arange(mesh.topology.index_map(tdim).size_local, dtype=np.int32)
    for parts, entities, dimension, result in (
        (boundaries, exterior, tdim - 1, found[0]),
        (regions, every, tdim, found[1]),
    ):
        middles = dmesh.compute_midpoints(mesh, dimension, entities)
        for name, indices in parts.items():
            cells, _ = holders(base.geometry.x[corner_points(base, dimension, indices)], middles)
            result[name] = np.sort(entities[cells >= 0]).astype(np.int32)
    return found[0], found[1]
