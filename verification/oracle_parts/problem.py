"""The fields of a scene and what its balances share; strain and stress over UFL."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import ufl
from dolfinx import fem
from dolfinx.fem import petsc as fem_petsc

from oracle_parts.contact import ContactSide
from oracle_parts.domain import Body, Nodal, Side, create_body
from oracle_parts.newton import Tolerances
from oracle_parts.portability import lagrange_space
from oracle_parts.scene import Scene


def strain(v: Any) -> Any:
    return ufl.sym(ufl.grad(v))


def apply_voigt(matrix: Any, tau: Any) -> Any:
    """The fourth-order tensor with that Voigt matrix, applied to a symmetric tensor."""
    if tau.ufl_shape == (2, 2):
        s = matrix * ufl.as_vector((tau[0, 0], tau[1, 1], 2 * tau[0, 1]))
        return ufl.as_tensor(((s[0], s[2]), (s[2], s[1])))
    normal = [tau[axis, axis] for axis in range(3)]
    s = matrix * ufl.as_vector((*normal, 2 * tau[1, 2], 2 * tau[0, 2], 2 * tau[0, 1]))
    return ufl.as_tensor(((s[0], s[5], s[4]), (s[5], s[1], s[3]), (s[4], s[3], s[2])))


def assembled_matrix(form: Any, bcs: Sequence[Any] = (), on_sides: Sequence[Any] = ()) -> Any:
    """Of the form and of those on single sides: a form of UFL takes the facets of one side only."""
    matrix = fem_petsc.assemble_matrix(fem.form(form), bcs=list(bcs))
    matrix.assemble()
    for on_side in on_sides:
        more = fem_petsc.assemble_matrix(fem.form(on_side), bcs=list(bcs), diagonal=0.0)
        more.assemble()
        matrix.axpy(1.0, more)
    return matrix


@dataclass(frozen=True)
class Piece:
    """Cells with one set of laws: a region, or the rest of the body."""

    dx: Any
    material: Any  # Material where the scene has one, Heat likewise
    heat: Any


def pieces_of(body: Body, scene: Scene) -> list[Piece]:
    if not scene.regions:
        return [Piece(body.dx(), scene.material, scene.heat)]
    laws = [*scene.regions.values(), (scene.material, scene.heat)]
    return [Piece(dx, *own) for dx, own in zip(body.dx_of(list(scene.regions)), laws)]


class Problem:
    """The fields of a scene, its boundary data and contact sides, and what the two balances share."""

    def __init__(self, comm: Any, scene: Scene, solver: str, body: Body | None = None) -> None:
        """`solver` of the linear systems: "direct" or "amg"; `body` in place of the scene's own."""
        self.solver = solver
        self.scene, self.body = scene, body or create_body(comm, scene)
        self.mesh, self.dx, self.pieces = self.body.mesh, self.body.dx(), pieces_of(self.body, scene)
        self.tau = fem.Constant(self.mesh, scene.step)
        self.Q = lagrange_space(self.mesh, scene.degree)
        self.V = lagrange_space(self.mesh, scene.degree, scene.dimension) if scene.material else None
        self.u = self.w = self.theta = None
        self.stage_u = self.stage_w = None
        if scene.material:
            self.u = Nodal(self.V, scene, scene.initial_displacement).function
            self.w = Nodal(self.V, scene, scene.initial_velocity).function
            self.stage_u, self.stage_w = fem.Function(self.V), fem.Function(self.V)
        if scene.heat:
            self.theta = Nodal(self.Q, scene, [scene.initial_temperature]).function
        self.sides = {name: Side(self.body, name) for name in scene.boundaries}
        self.contacts = [
            ContactSide(self.sides[name], contact, index, self.V, self.Q, scene)
            for index, (name, contact) in enumerate(scene.contacts.items())
        ]
        for side in self.contacts:
            side.prepare_measures(self.u, self.w, self.theta)
        self.tolerances = Tolerances(scene.tolerance, scene.max_iterations)

    @property
    def unknowns(self) -> dict[str, int]:
        spaces = {"displacement": self.V, "temperature": self.Q if self.scene.heat else None}
        sizes = {name: space.dofmap for name, space in spaces.items() if space}
        return {name: dofs.index_map.size_global * dofs.index_map_bs for name, dofs in sizes.items()}

    def constant(self, value: Any) -> Any:
        return fem.Constant(self.mesh, np.asarray(value, dtype=np.float64))

    def sum(self, integrand: Callable[[Callable[[Any], Any], Piece], Any]) -> Any:
        """The integral over the body of what `integrand` makes, piece by piece, of `constant` and the piece."""
        return sum(integrand(self.constant, piece) * piece.dx for piece in self.pieces)
