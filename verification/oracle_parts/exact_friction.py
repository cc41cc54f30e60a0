"""Coulomb's law itself, friction.regularisation = 0, on one contact side: numpy at the points of the contact rule.

With a multiplier m at each point, -sigma_t = P(m + gamma w_t), P the projection onto the disc of radius p_t = mu p_n(r).
The momentum balance is solved for a given m, which then becomes -sigma_t, until that changes nothing (method of
multipliers). Then w_t = 0 where |m| < p_t, and m = p_t w_t / |w_t| where w_t is not 0.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import basix
import numpy as np
import numpy.typing as npt
from dolfinx.mesh import CellType
from mpi4py import MPI
from petsc4py import PETSc

from oracle_parts.errors import NumericsError
from oracle_parts.portability import cell_nodes

Array = npt.NDArray[np.float64]
FACETS = {
    CellType.triangle: basix.CellType.interval,
    CellType.quadrilateral: basix.CellType.interval,
    CellType.tetrahedron: basix.CellType.triangle,
    CellType.hexahedron: basix.CellType.quadrilateral,
}
# gamma over the body's largest resistance to slip: soft at first, so that Newton's method finds which points slip; then
# ten times as much where an update changes more than a tenth of what the last one did
SOFT, STIFF, STIFFEST = 0.2, 200.0, 2e5
SETTLED = 1e-3  # of the multiplier: smaller changes are no longer those of points that begin or end to slip
MOST_UPDATES = 60
HALF_A_BIT = 2.0**-53  # the relative error of rounding to double precision
ROUNDINGS = 10.0  # a slip is a sum over the nodes of a facet, each rounded
FALLING = 0.5  # of the change before: an update that does some good leaves less
VANISHING = 1e-13  # value of a function at a point: rounding is below, functions that do not vanish far above
SLIPS = 1e-6  # |w_t| gamma beyond this share of p_t


def lagrange(cell: Any, degree: int) -> Any:
    return basix.create_element(basix.ElementFamily.P, cell, degree, basix.LagrangeVariant.gll_warped)


def lagrange_at(cell: Any, degree: int, points: Array) -> Array:
    """Values and first derivatives of the Lagrange functions, shape (1 + d, points, functions)."""
    values: Array = lagrange(cell, degree).tabulate(1, points)
    return values[..., 0]


class ExactFriction:
    def __init__(self, side: Any, scene: Any, local_facets: list[int], metadata: dict[str, Any]) -> None:
        """`side`: the ContactSide, whose cells are those of `local_facets`; `metadata` of its rule."""
        self.side, self.degree = side, scene.degree
        self.dimension = scene.dimension
        cell = getattr(basix.CellType, side.mesh.topology.cell_type.name)
        points, self.weights = _rule(FACETS[side.mesh.topology.cell_type], metadata)
        corners, facets = basix.geometry(cell), basix.topology(cell)[self.dimension - 1]
        facet_slopes = lagrange_at(FACETS[side.mesh.topology.cell_type], 1, points)[1:]
        tabulated = []
        for facet in facets:
            origin = corners[facet[0]]
            # vertices 1 (and 2) of the facet span it from vertex 0
            along = np.array([corners[vertex] - origin for vertex in facet[1 : self.dimension]])
            inside = origin + points @ along
            values = lagrange_at(cell, scene.degree, inside)[0]
            # those of nodes off the facet vanish there, at a node those of all others, but for a rounding that would
            # carry displacements of the interior, and of nodes that are open, into the pressure
            values[np.abs(values) < VANISHING] = 0.0
            tabulated.append((facet, values))
        count = side.mesh.topology.index_map(self.dimension).size_local
        geometry = np.asarray(
            side.mesh.geometry.dofmap.array
            if hasattr(side.mesh.geometry.dofmap, "array")
            else side.mesh.geometry.dofmap
        ).reshape(count, -1)
        vertices = side.mesh.geometry.x[geometry[side.cells]]
        self.nodes = cell_nodes(side.displacement_space, count)[side.cells]
        self.gap_nodes = cell_nodes(side.scalar_space, count)[side.cells]
        n = (len(local_facets), len(self.weights))
        self.basis = np.zeros((*n, self.nodes.shape[1]))
        self.normals = np.zeros((*n, self.dimension))
        self.area = np.zeros(n)  # times weight: of each point
        for row, local in enumerate(local_facets):
            facet, self.basis[row] = tabulated[local]
            self.normals[row], size = _normal_and_size(vertices[row], facet, facet_slopes)
            self.area[row] = self.weights * size
        self.multiplier = np.zeros((*n, self.dimension))
        self.resistance = self.gamma = 0.0

    def set_stiffness(self, matrix: Any) -> None:
        """gamma from the diagonal of the linear part, by what area each node has."""
        d = self.dimension
        diagonal = matrix.createVecRight()
        matrix.getDiagonal(diagonal)
        owned = diagonal.array.reshape(-1, d).max(axis=1)
        shares = np.zeros(int(self.nodes.max(initial=-1)) + 1)
        # squares, as some functions of degree 2 have no integral; over them a node of degree 1 in 2D has 2/3 its area
        np.add.at(shares, self.nodes, np.einsum("fq,fqi->fi", self.area, self.basis**2))
        here = np.flatnonzero(
            shares[: len(owned)] > 1e-10 * shares.max(initial=0.0)
        )  # off the side: round-off
        stiffest = (owned[here] / shares[here]).max(initial=0.0)
        self.resistance = self.side.mesh.comm.allreduce(stiffest, op=MPI.MAX)
        diagonal.destroy()

    # At the points

    def _state(self, u: Array, w: Array) -> tuple[Array, Array, Array]:
        """Penetration, bound of friction p_t, and slip velocity over the foundation from nodal values [nodes * d]."""
        values = [
            np.einsum("fqi,fic->fqc", self.basis, field.reshape(-1, self.dimension)[self.nodes])
            for field in (u, w)
        ]
        gap = np.einsum("fqi,fi->fq", self.basis, self.side.gap.function.x.array[self.gap_nodes])
        r = np.sum(values[0] * self.normals, axis=2) - gap
        velocity = values[1]
        if self.side.belt is not None:
            of_belt = self.side.belt.function.x.array.reshape(-1, self.dimension)[self.nodes]
            velocity = velocity - np.einsum("fqi,fic->fqc", self.basis, of_belt)
        return r, self.side.bound_at(r), self._tangential(velocity)

    def _tangential(self, field: Array) -> Array:
        tangential: Array = field - np.sum(field * self.normals, axis=2)[..., None] * self.normals
        return tangential

    def update(self, u: Array, w: Array) -> tuple[float, float, float]:
        """The multiplier becomes the friction; on this process, the squares of its change, of its size, and of what
        rounding the velocities of body and foundation makes of gamma times the slip."""
        _, bound, slip = self._state(u, w)
        new = projected(self.multiplier + self.gamma * slip, bound)
        change, size = float(np.sum((new - self.multiplier) ** 2)), float(np.sum(new**2))
        self.multiplier = new
        velocity = np.abs(w.reshape(-1, self.dimension)[self.nodes]).max(initial=0.0)
        belt = np.abs(self.side.belt.function.x.array).max(initial=0.0) if self.side.belt is not None else 0.0
        rounded = HALF_A_BIT * self.gamma * (velocity + belt)
        return change, size, new.size * rounded**2

    def add_heat(self, vector: Any, share: float, u: Array, w: Array) -> None:
        """That share of -sigma_t . slip, tested with the functions of the temperature."""
        _, bound, slip = self._state(u, w)
        stress = projected(self.multiplier + self.gamma * slip, bound)
        power = share * self.area * np.sum(stress * slip, axis=2)
        with vector.localForm() as local:
            np.add.at(local.array, self.gap_nodes, np.einsum("fq,fqi->fi", power, self.basis))

    # As a term of the equation

    def add_force(self, vector: Any, u: Array, w: Array) -> None:
        _, bound, slip = self._state(u, w)
        stress = projected(self.multiplier + self.gamma * slip, bound)
        forces = np.einsum("fq,fqi,fqc->fic", self.area, self.basis, self._tangential(stress))
        with vector.localForm() as local:
            dofs = self._dofs()
            np.add.at(local.array, dofs, forces.reshape(dofs.shape))

    def add_derivative(
        self, matrix: Any, constrained: npt.NDArray[np.int32], u: Array, w: Array, tau: float
    ) -> None:
        """d/dw: of the slip, gamma P' (I - n n), and of the pressure through u = u_b + tau w."""
        d, n = self.dimension, self.normals
        r, bound, slip = self._state(u, w)
        trial = self.multiplier + self.gamma * slip
        size = np.linalg.norm(trial, axis=2)
        slides = size > bound
        safe = np.where(slides, size, 1.0)
        direction = trial / safe[..., None]
        onto_plane = np.eye(d) - n[..., :, None] * n[..., None, :]
        along = direction[..., :, None] * direction[..., None, :]
        sliding = (bound / safe)[..., None, None] * (onto_plane - along)
        by_slip = self.gamma * np.where(slides[..., None, None], sliding, onto_plane)
        slope = self.side.bound_slope_at(r)
        by_pressure = (
            np.where(slides, tau * slope, 0.0)[..., None, None] * direction[..., :, None] * n[..., None, :]
        )
        blocks = np.einsum(
            "fq,fqi,fqab,fqj->fiajb", self.area, self.basis, by_slip + by_pressure, self.basis, optimize=True
        )
        dofs = self._dofs()
        dofs = np.where(np.isin(dofs, constrained), -1, dofs).astype(np.int32)
        for row, block in zip(dofs, blocks.reshape(*dofs.shape, dofs.shape[1])):
            matrix.setValuesLocal(row, row, block, addv=PETSc.InsertMode.ADD)

    def _dofs(self) -> npt.NDArray[np.int32]:
        d = self.dimension
        facets, nodes = self.nodes.shape  # of this process: maybe none
        dofs: npt.NDArray[np.int32] = (self.nodes[:, :, None] * d + np.arange(d)).reshape(facets, nodes * d)
        return dofs

    # Results

    def force(self, u: Array, w: Array) -> tuple[Array, float]:
        """The integrals of -sigma_t and of the closed area that slips, on this process."""
        r, bound, slip = self._state(u, w)
        slips = self.slips(slip, bound)
        stress = np.where(slips[..., None], bound[..., None] * unit(slip), projected(self.multiplier, bound))
        return np.einsum("fq,fqc->c", self.area, stress), float(np.sum(self.area * ((r >= 0.0) & slips)))

    def slips(self, slip: Array, bound: Array) -> npt.NDArray[np.bool_]:
        share = SLIPS / self.gamma if self.gamma > 0 else 0.0  # nothing sticks before the first step
        result: npt.NDArray[np.bool_] = np.linalg.norm(slip, axis=2) > share * bound
        return result

    def nodal_traction(self, slip: Array, bound: Array) -> tuple[Array, npt.NDArray[np.bool_]]:
        """sigma_t at a facet's nodes and whether they slip; where they stick the mean of the points, within the bound.

        There it is not unique: only what all points exert together on each node of the body is.
        """
        slips = self.slips(slip, bound)
        mean = np.broadcast_to(self.multiplier.mean(axis=1, keepdims=True), slip.shape)
        return -np.where(slips[..., None], bound[..., None] * unit(slip), projected(mean, bound)), slips


@dataclass(frozen=True)
class FrictionTerm:
    """The term of the momentum balance for w, with u = base_u + tau w."""

    friction: ExactFriction
    base_u: Any
    tau: Any
    w: Any

    def fields(self) -> tuple[Array, Array]:
        w = self.w.x.array
        return self.base_u.x.array + float(self.tau.value) * w, w

    def add_residual(self, vector: Any) -> None:
        self.friction.add_force(vector, *self.fields())

    def add_jacobian(self, matrix: Any, bcs: Sequence[Any]) -> None:
        constrained = [bc.dof_indices()[0] for bc in bcs]
        dofs = np.unique(np.concatenate(constrained)) if constrained else np.empty(0, dtype=np.int32)
        self.friction.add_derivative(matrix, dofs, *self.fields(), float(self.tau.value))

    def update(self) -> tuple[float, float, float]:
        return self.friction.update(*self.fields())


def solve_with_multipliers(
    solve: Callable[[bool], int], terms: Sequence[FrictionTerm], comm: Any, tolerance: float
) -> int:
    """Solve, and let the multipliers follow, until they stay; returns the Newton iterations.

    They stay where their change is small beside themselves, not beside the forces of the body, which is all that
    Newton's method looks at: `solve` is asked to polish what it finds solved. Where it does no more than that and the
    changes fall no longer, they are round-off.
    """
    if not terms:
        return solve(False)
    iterations, stiffening, change = 0, SOFT, np.inf
    for _ in range(MOST_UPDATES):
        for term in terms:
            term.friction.gamma = stiffening * term.friction.resistance
        taken = solve(stiffening >= STIFF)
        iterations += taken
        before = change
        sums = comm.allreduce(np.sum([term.update() for term in terms], axis=0))
        change, noise = np.sqrt(sums[[0, 2]] / sums[1]) if sums[1] > 0 else (0.0, 0.0)
        settled = change <= max(tolerance, ROUNDINGS * noise) or taken == 0 and change > FALLING * before
        if stiffening >= STIFF and settled:
            return iterations
        if stiffening < STIFF or (0.1 * before < change < SETTLED and stiffening < STIFFEST):
            stiffening *= 10.0
    raise NumericsError(f"the multipliers of friction did not settle in {MOST_UPDATES} updates")


def projected(t: Array, bound: Array) -> Array:
    """Onto the disc around 0 of that radius."""
    size = np.linalg.norm(t, axis=2)
    shrink = np.where(size > bound, bound / np.where(size > bound, size, 1.0), 1.0)
    return shrink[..., None] * t


def unit(vectors: Array) -> Array:
    size = np.linalg.norm(vectors, axis=2, keepdims=True)
    result: Array = vectors / np.where(size > 0.0, size, 1.0)
    return result


def _rule(facet: Any, metadata: dict[str, Any]) -> tuple[Array, Array]:
    if "quadrature_points" in metadata:
        return np.array(metadata["quadrature_points"]), np.array(metadata["quadrature_weights"])
    points, weights = basix.make_quadrature(facet, metadata["quadrature_degree"])
    return np.asarray(points), np.asarray(weights)


def _normal_and_size(vertices: Array, facet: Sequence[int], slopes: Array) -> tuple[Array, Array]:
    """Unit outward normals at the points of a facet, and the size of area per size in the reference facet.

    `facet`: its vertices; `slopes` of its linear functions at the points. Only differences to its first vertex enter:
    what they have in common leaves no rounding, and a facet along an axis has exact zeros in its normal. The share of a
    large slip that they would let into the penetration (1e-16 of it) is much of one under contact as stiff as 1e14.
    """
    d = vertices.shape[1] if len(facet) > 2 else 2
    spans = vertices[list(facet), :d] - vertices[facet[0], :d]
    tangents = np.einsum("aqi,ic->qac", slopes, spans)
    if d == 2:
        normal = np.stack((tangents[:, 0, 1], -tangents[:, 0, 0]), axis=1)
    else:
        normal = np.cross(tangents[:, 0], tangents[:, 1])
    size = np.linalg.norm(normal, axis=1)
    normal = normal / size[:, None]
    outward = vertices[list(facet), :d].mean(axis=0) - vertices[:, :d].mean(axis=0)
    normal[normal @ outward < 0] *= -1.0
    return normal, size
