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

from oracle_parts import laws
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
SLIPS = 1e-6  # |w_t| gamma beyond this share of p_t


def lagrange_at(cell: Any, degree: int, points: Array) -> Array:
    """Values and first derivatives of the Lagrange functions, shape (1 + d, points, functions)."""
    kind = basix.LagrangeVariant.gll_warped
    values: Array = basix.create_element(basix.ElementFamily.P, cell, degree, kind).tabulate(1, points)
    return values[..., 0]


class ExactFriction:
    def __init__(self, side: Any, scene: Any, local_facets: list[int], metadata: dict[str, Any]) -> None:
        """`side`: the ContactSide, whose cells are those of `local_facets`; `metadata` of its rule."""
        self.side, self.degree = side, scene.degree
        self.dimension = scene.dimension
        cell = getattr(basix.CellType, side.mesh.topology.cell_type.name)
        points, self.weights = _rule(FACETS[side.mesh.topology.cell_type], metadata)
        corners, facets = basix.geometry(cell), basix.topology(cell)[self.dimension - 1]
        tabulated = []
        for facet in facets:
            origin = corners[facet[0]]
            # vertices 1 (and 2) of the facet span it from vertex 0
            along = np.array([corners[vertex] - origin for vertex in facet[1 : self.dimension]])
            inside = origin + points @ along
            tabulated.append(
                (lagrange_at(cell, 1, inside), lagrange_at(cell, scene.degree, inside)[0], along)
            )
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
            linear, self.basis[row], along = tabulated[local]
            self.normals[row], size = _normal_and_size(vertices[row], linear, along)
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
        return r, self.bound(r), self._tangential(velocity)

    def bound(self, r: Array) -> Array:
        contact = self.side.contact
        law = contact.compliance
        return contact.friction.coefficient * laws.pressure(laws.NUMPY, r, law.stiffness, law.exponent)

    def _tangential(self, field: Array) -> Array:
        tangential: Array = field - np.sum(field * self.normals, axis=2)[..., None] * self.normals
        return tangential

    def update(self, u: Array, w: Array) -> tuple[float, float]:
        """The multiplier becomes the friction; the squares of its change and of its size, on this process."""
        _, bound, slip = self._state(u, w)
        new = projected(self.multiplier + self.gamma * slip, bound)
        change, size = float(np.sum((new - self.multiplier) ** 2)), float(np.sum(new**2))
        self.multiplier = new
        return change, size

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
            np.add.at(local.array, self._dofs(), forces.reshape(len(forces), -1))

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
        law, mu = self.side.contact.compliance, self.side.contact.friction.coefficient
        slope = np.where(r >= 0.0, mu * law.stiffness * law.exponent * np.abs(r) ** (law.exponent - 1), 0.0)
        by_pressure = (
            np.where(slides, tau * slope, 0.0)[..., None, None] * direction[..., :, None] * n[..., None, :]
        )
        blocks = np.einsum(
            "fq,fqi,fqab,fqj->fiajb", self.area, self.basis, by_slip + by_pressure, self.basis, optimize=True
        )
        dofs = self._dofs()
        dofs = np.where(np.isin(dofs, constrained), -1, dofs).astype(np.int32)
        for row, block in zip(dofs, blocks.reshape(len(dofs), dofs.shape[1], dofs.shape[1])):
            matrix.setValuesLocal(row, row, block, addv=PETSc.InsertMode.ADD)

    def _dofs(self) -> npt.NDArray[np.int32]:
        d = self.dimension
        dofs: npt.NDArray[np.int32] = (self.nodes[:, :, None] * d + np.arange(d)).reshape(len(self.nodes), -1)
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

    def update(self) -> tuple[float, float]:
        return self.friction.update(*self.fields())


def solve_with_multipliers(
    solve: Callable[[], int], terms: Sequence[FrictionTerm], comm: Any, tolerance: float
) -> int:
    """Solve, and let the multipliers follow, until they stay; returns the Newton iterations."""
    if not terms:
        return solve()
    iterations, stiffening, change = 0, SOFT, np.inf
    for _ in range(MOST_UPDATES):
        for term in terms:
            term.friction.gamma = stiffening * term.friction.resistance
        taken = solve()
        iterations += taken
        before = change
        sums = comm.allreduce(np.sum([term.update() for term in terms], axis=0))
        change = np.sqrt(sums[0] / sums[1]) if sums[1] > 0 else 0.0
        if stiffening >= STIFF and (change <= tolerance or taken == 0):
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


def _normal_and_size(vertices: Array, linear: Array, along: Array) -> tuple[Array, Array]:
    """Unit outward normals at the points of a facet, and the size of area per size in the reference facet."""
    d = along.shape[1]
    jacobian = np.einsum("kqi,ic->qck", linear[1:], vertices[:, :d])
    tangents = np.einsum("qck,ak->qac", jacobian, along)
    if d == 2:
        normal = np.stack((tangents[:, 0, 1], -tangents[:, 0, 0]), axis=1)
    else:
        normal = np.cross(tangents[:, 0], tangents[:, 1])
    size = np.linalg.norm(normal, axis=1)
    normal = normal / size[:, None]
    outward = np.einsum("qi,ic->qc", linear[0], vertices[:, :d]) - vertices[:, :d].mean(axis=0)
    normal[np.sum(normal * outward, axis=1) < 0] *= -1.0
    return normal, size
