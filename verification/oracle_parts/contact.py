"""One contact side: its terms in the two balances, its resultants, and its laws at the nodes for output."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
import ufl
from dolfinx import fem
from dolfinx.mesh import CellType
from dolfinx.fem import petsc as fem_petsc
from mpi4py import MPI

from oracle_parts import laws
from oracle_parts.domain import Nodal, Side, node_points
from oracle_parts.exact_friction import ExactFriction, FrictionTerm
from oracle_parts.newton import CompiledTerm, Term
from oracle_parts.portability import cell_nodes, lagrange_space
from oracle_parts.scene import Contact, Scene

Array = npt.NDArray[np.float64]
MEASURES = (
    "normal_force",
    "tangential_force",
    "max_penetration",
    "contact_fraction",
    "slip_fraction",
    "heat_flow",
)
OPEN, STICK, SLIP = 0, 1, 2
FACETS_IN_SPACE = {CellType.tetrahedron: "triangle", CellType.hexahedron: "quadrilateral"}
# Reference places of the nodes of a quadrilateral: corners, midpoints of the edges, centre
SQUARE = ((0, 0), (1, 0), (0, 1), (1, 1), (0.5, 0), (0, 0.5), (1, 0.5), (0.5, 1), (0.5, 0.5))


def quadrature_metadata(rule: int | str, degree: int, facet: str) -> dict[str, Any]:
    """A Gauss rule by its degree, or "vertex": trapezoid for degree 1, Simpson for degree 2, or products of these.

    On triangles the rule at the corners for degree 1, at the midpoints of the edges for degree 2.
    """
    if rule != "vertex":
        return {"quadrature_degree": rule}
    ends = [(0.0, 1 / 2), (1.0, 1 / 2)] if degree == 1 else [(0.0, 1 / 6), (0.5, 4 / 6), (1.0, 1 / 6)]
    pairs: list[tuple[tuple[float, ...], float]] = [((s,), weight) for s, weight in ends]
    if facet == "quadrilateral":
        pairs = [((s, t), a * b) for s, a in ends for t, b in ends]
    if facet == "triangle":
        places = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)] if degree == 1 else [(0.5, 0.0), (0.0, 0.5), (0.5, 0.5)]
        pairs = [(place, 1 / 6) for place in places]
    return {
        "quadrature_rule": "custom",
        "quadrature_degree": 1,
        "quadrature_points": tuple(point for point, _ in pairs),
        "quadrature_weights": tuple(weight for _, weight in pairs),
    }


class ContactSide:
    """`displacement_space` is None in a scene without mechanics: then u = 0 in the penetration."""

    def __init__(
        self,
        side: Side,
        contact: Contact,
        index: int,
        displacement_space: Any,
        scalar_space: Any,
        scene: Scene,
    ) -> None:
        self.name, self.index, self.contact, mesh = side.name, index, contact, side.mesh
        self.mesh, self.displacement_space, self.scalar_space = mesh, displacement_space, scalar_space
        self.facet = "interval" if side.dimension == 1 else FACETS_IN_SPACE[mesh.topology.cell_type]
        self.ds = side.ds(quadrature_metadata(contact.quadrature, scene.degree, self.facet))
        self.normal = ufl.FacetNormal(mesh)
        self.gap = Nodal(scalar_space, scene, [contact.gap], side)
        self.belt: Nodal | None = None  # the foundation's velocity
        if contact.foundation_velocity:
            self.belt = Nodal(displacement_space, scene, contact.foundation_velocity, side)
        if contact.compliance:
            self.stiffness = _constant(mesh, contact.compliance.stiffness)
            self.exponent = _constant(mesh, contact.compliance.exponent)
        if contact.friction:
            self.friction = _constant(mesh, contact.friction.coefficient)
            self.epsilon = _constant(mesh, contact.friction.regularisation)
        if contact.conductance:
            self.coefficient = _constant(mesh, contact.conductance.coefficient)
            self.onset = _constant(mesh, contact.conductance.onset)
            foundation = contact.conductance.foundation_temperature
            self.foundation = Nodal(scalar_space, scene, [foundation], side)
            limit = contact.conductance.limit
            self.limit = None if limit is None else _constant(mesh, limit)
        self._locate_nodes(side, scene)
        self.exact: ExactFriction | None = None
        if contact.friction and contact.friction.regularisation == 0.0:
            rule = quadrature_metadata(contact.quadrature, scene.degree, self.facet)
            self.exact = ExactFriction(self, scene, self.local_facets, rule)

    def update(self, time: float) -> None:
        self.gap.update(time)
        if self.belt:
            self.belt.update(time)
        if self.contact.conductance:
            self.foundation.update(time)

    # The weak forms, over UFL

    def penetration(self, u: Any | None) -> Any:
        """r = u_n - g."""
        u_n = ufl.dot(u, self.normal) if u is not None else 0.0
        return u_n - self.gap.function

    def tangential(self, w: Any) -> Any:
        return w - ufl.dot(w, self.normal) * self.normal

    def slip(self, w: Any) -> Any:
        """The tangential velocity over the foundation."""
        return self.tangential(w) - self.tangential(self.belt.function) if self.belt else self.tangential(w)

    def pressure(self, r: Any) -> Any:
        return laws.pressure(laws.UFL, r, self.stiffness, self.exponent)

    def friction_stress(self, r: Any, w: Any) -> Any:
        """-sigma_t = p_t s / |s|_epsilon of the slip velocity s."""
        slip = self.slip(w)
        norm = laws.regularised_norm(laws.UFL, ufl.dot(slip, slip), self.epsilon)
        return self.friction * self.pressure(r) * slip / norm

    def heat_flow(self, r: Any, theta: Any) -> Any:
        """q.n = k_c(r) phi_L(theta - theta_F)."""
        k_c = laws.conductance(laws.UFL, r, self.coefficient, self.onset)
        return k_c * laws.clamped(laws.UFL, theta - self.foundation.function, self.limit)

    def momentum_terms(self, u_base: Any, tau: Any, w: Any) -> list[Term]:
        """The displacement is u_base + tau w with the unknown w."""
        if not self.contact.compliance:
            return []
        v = ufl.TestFunction(w.function_space)
        r = self.penetration(u_base + tau * w)
        form = self.pressure(r) * ufl.dot(v, self.normal) * self.ds
        if self.contact.friction and not self.exact:
            form += ufl.dot(self.friction_stress(r, w), self.tangential(v)) * self.ds
        terms: list[Term] = [_term(form, w)]
        if self.exact:
            terms.append(FrictionTerm(self.exact, u_base, tau, w))
        return terms

    def heat_term(self, u: Any | None, theta: Any) -> Term | None:
        if not self.contact.conductance:
            return None
        eta = ufl.TestFunction(theta.function_space)
        return _term(self.heat_flow(self.penetration(u), theta) * eta * self.ds, theta)

    def friction_heat(self, u: Any, w: Any) -> "FrictionHeat | ExactFrictionHeat | None":
        """The heat that the body gets of what friction dissipates."""
        law = self.contact.friction
        if law is None or law.heat_share == 0.0:
            return None
        if self.exact:
            return ExactFrictionHeat(self.exact, law.heat_share, u, w)
        eta = ufl.TestFunction(self.scalar_space)
        power = ufl.dot(self.friction_stress(self.penetration(u), w), self.slip(w))
        return FrictionHeat(fem.form(_constant(self.mesh, law.heat_share) * power * eta * self.ds))

    # Resultants over the side

    def prepare_measures(self, u: Any | None, w: Any | None, theta: Any | None) -> None:
        """One form for all integrals: tested with piecewise constants, whose entries are then summed."""
        r = self.penetration(u)
        closed = ufl.conditional(r >= 0.0, 1.0, 0.0)
        zero = 0.0 * closed
        d = len(self.normal)
        normal, friction, slip, heat = zero, d * [zero], closed, zero
        if self.contact.compliance:
            normal = self.pressure(r)
        if self.contact.friction and not self.exact:
            friction = [self.friction_stress(r, w)[axis] for axis in range(d)]
            speed = ufl.sqrt(ufl.dot(self.slip(w), self.slip(w)))
            slip = closed * ufl.conditional(speed > self.epsilon, 1.0, 0.0)
        if self.contact.conductance:
            heat = self.heat_flow(r, theta)
        integrands = (normal, closed, slip, heat, 1.0 + zero, *friction)
        q = ufl.TestFunction(lagrange_space(self.mesh, 0, len(integrands)))
        self.integrals = fem.form(ufl.dot(ufl.as_vector(integrands), q) * self.ds)

    def measures(self, u: Any | None, w: Any | None) -> dict[str, float]:
        vector = fem_petsc.assemble_vector(self.integrals)
        local = vector.array.reshape(-1, 5 + len(self.normal)).sum(axis=0)
        vector.destroy()
        if self.exact and u is not None and w is not None:
            local[5:], local[2] = self.exact.force(u.x.array, w.x.array)
        normal, closed, slip, heat, area, *friction = self.mesh.comm.allreduce(local)
        deepest = max(0.0, self.nodal_penetration(u).max(initial=0.0))
        values = (
            normal,
            float(np.linalg.norm(friction)),
            self.mesh.comm.allreduce(deepest, op=MPI.MAX),
            closed / area,
            slip / area,
            heat,
        )
        return {name: float(value) for name, value in zip(MEASURES, values)}

    # The laws at the facets' own nodes, over numpy

    def _locate_nodes(self, side: Side, scene: Scene) -> None:
        """Cells, nodes, points and outward unit normals at these, one row per facet."""
        topology = side.mesh.topology
        tdim = topology.dim
        to_cells, to_facets = topology.connectivity(tdim - 1, tdim), topology.connectivity(tdim, tdim - 1)
        self.cells = np.array([to_cells.links(facet)[0] for facet in side.facets], dtype=np.int32)
        local = [list(to_facets.links(cell)).index(facet) for cell, facet in zip(self.cells, side.facets)]
        self.scalar_nodes = _facet_nodes(self.scalar_space, self.cells, local)
        if self.displacement_space is not None:
            self.vector_nodes = _facet_nodes(self.displacement_space, self.cells, local)
        points = node_points(self.scalar_space, scene)
        self.local_facets = local
        self.points: Array = points[self.scalar_nodes]
        normals = _normals(self.points, self.facet)
        cell_points = points[cell_nodes(self.scalar_space, topology.index_map(tdim).size_local)[self.cells]]
        inward = cell_points.mean(axis=1)[:, None, :] - self.points
        normals[np.sum(normals * inward, axis=2) > 0.0] *= -1.0
        self.normals: Array = normals[:, :, :tdim]

    def _at_nodes(self, function: Any) -> Array:
        """Values of a vector function, shape (facets, nodes, d)."""
        return function.x.array.reshape(-1, self.normals.shape[2])[self.vector_nodes]

    def nodal_penetration(self, u: Any | None) -> Array:
        gap = self.gap.function.x.array[self.scalar_nodes]
        return (np.sum(self._at_nodes(u) * self.normals, axis=2) if u is not None else 0.0) - gap

    def nodal(self, u: Any, w: Any, theta: Any) -> dict[str, Array]:
        """Each result of this side at its facets' nodes: shape (facets, nodes) or (facets, nodes, d)."""
        contact, m = self.contact, laws.NUMPY
        r = self.nodal_penetration(u)
        result: dict[str, Array] = {"gap": -r, "state": np.where(r < 0.0, OPEN, SLIP)}
        if w is not None:
            velocity = self._at_nodes(w)
            if self.belt:
                velocity = velocity - self._at_nodes(self.belt.function)
            normal_velocity = np.sum(velocity * self.normals, axis=2)
            slip = velocity - normal_velocity[:, :, None] * self.normals
            result["slip_velocity"] = slip
        if contact.compliance:
            pressure = laws.pressure(m, r, contact.compliance.stiffness, contact.compliance.exponent)
            result["pressure"] = pressure
        if self.exact:
            result["traction"], slips = self.exact.nodal_traction(slip, self.exact.bound(r))
            result["state"] = np.where((r >= 0.0) & ~slips, STICK, result["state"])
        elif contact.friction:
            epsilon = contact.friction.regularisation
            norm = laws.regularised_norm(m, np.sum(slip**2, axis=2), epsilon)
            result["traction"] = -contact.friction.coefficient * (pressure / norm)[:, :, None] * slip
            sticks = (r >= 0.0) & (np.linalg.norm(slip, axis=2) <= epsilon)
            result["state"] = np.where(sticks, STICK, result["state"])
        if contact.conductance:
            law = contact.conductance
            above = (theta.x.array - self.foundation.function.x.array)[self.scalar_nodes]
            k_c = laws.conductance(m, r, law.coefficient, law.onset)
            result["heat_flow"] = k_c * laws.clamped(m, above, law.limit)
        return result


@dataclass(frozen=True)
class FrictionHeat:
    form: Any

    def add_to(self, vector: Any) -> None:
        fem_petsc.assemble_vector(vector, self.form)


@dataclass(frozen=True)
class ExactFrictionHeat:
    friction: ExactFriction
    share: float
    u: Any
    w: Any

    def add_to(self, vector: Any) -> None:
        self.friction.add_heat(vector, self.share, self.u.x.array, self.w.x.array)


def _constant(mesh: Any, value: float) -> Any:
    return fem.Constant(mesh, float(value))


def _term(form: Any, unknown: Any) -> CompiledTerm:
    trial = ufl.TrialFunction(unknown.function_space)
    return CompiledTerm(fem.form(form), fem.form(ufl.derivative(form, unknown, trial)))


def _normals(points: Array, facet: str) -> Array:
    """Unit normals, either way, at the nodes of each facet from its vertices, which come first; shape (.., .., 3)."""
    along = points[:, 1] - points[:, 0]
    if facet == "interval":
        normals = np.column_stack((along[:, 1], -along[:, 0], 0 * along[:, 0]))[:, None, :]
    elif facet == "triangle":
        normals = np.cross(along, points[:, 2] - points[:, 0])[:, None, :]
    else:
        a, b, c, d = (points[:, None, vertex] for vertex in range(4))
        s, t = (np.array(SQUARE)[None, : points.shape[1], [axis]].T for axis in range(2))
        s, t = s.reshape(1, -1, 1), t.reshape(1, -1, 1)
        normals = np.cross((1 - t) * (b - a) + t * (d - c), (1 - s) * (c - a) + s * (d - b))
    normals = normals / np.linalg.norm(normals, axis=2, keepdims=True)
    return np.broadcast_to(normals, points.shape).copy()


def _facet_nodes(space: Any, cells: npt.NDArray[np.int32], local_facets: list[int]) -> npt.NDArray[np.int32]:
    """Nodes of each facet: its vertices, then for degree 2 those inside its edges, then its own."""
    layout, tdim = space.dofmap.dof_layout, space.mesh.topology.dim
    facets = {CellType.triangle: 3, CellType.hexahedron: 6}.get(space.mesh.topology.cell_type, 4)
    closure = np.array([layout.entity_closure_dofs(tdim - 1, facet) for facet in range(facets)])
    nodes = cell_nodes(space, int(cells.max(initial=-1)) + 1)
    return nodes[cells[:, None], closure[np.array(local_facets, dtype=int)]]
