"""The laws of the body over UFL: the stress of a strain, heat sources and body forces, of the scene or of its law files.

Laws of files are integrated by one rule, exact to degree 2 p + 2 on simplices, with p + 1 Gauss points a direction on
tensor cells; p is the degree of the fields.
"""

from typing import Any

import ufl
from dolfinx import fem

from oracle_parts.domain import Body, Loads, Nodal
from oracle_parts.own_laws import LawOnMesh, OwnLaw
from oracle_parts.problem import Problem, apply_voigt
from oracle_parts.scene import Expression, Tensor4


def measure(body: Body, degree: int, dx: Any, own: bool) -> Any:
    """`dx`, with the rule for laws of files if there is one."""
    if not own:
        return dx
    rule = body.full_rule or {"quadrature_degree": 2 * degree + 2}
    return dx.reconstruct(metadata=rule)


def stress(mesh: Any, tensor: Tensor4, strain: Any) -> tuple[Any, Any]:
    """sigma (d x d) and sigma_zz of a strain or its rate."""
    if tensor.own is None:
        zz = fem.Constant(mesh, tensor.out_of_plane) * ufl.tr(strain)
        return apply_voigt(fem.Constant(mesh, tensor.voigt), strain), zz
    law = LawOnMesh(tensor.own, lambda value: fem.Constant(mesh, value))
    d = strain.ufl_shape[0]
    size = 3 if tensor.plane_strain else d
    given = ufl.as_matrix(
        [[strain[i, j] if max(i, j) < d else 0.0 for j in range(size)] for i in range(size)]
    )
    sigma = law(strain=given, strain_rate=given, x=ufl.SpatialCoordinate(mesh))
    in_plane = ufl.as_matrix([[sigma[i, j] for j in range(d)] for i in range(d)])
    return in_plane, sigma[2, 2] if size == 3 else 0.0 * ufl.tr(strain)


def stress_power(problem: Problem, law: str, of: Any, with_: Any) -> Any:
    """The integral over the body of sigma(of) : with_."""
    total = 0
    for piece in problem.pieces:
        tensor = getattr(piece.material, law)
        dx = measure(problem.body, problem.scene.degree, piece.dx, tensor.own is not None)
        total += ufl.inner(stress(problem.mesh, tensor, of)[0], with_) * dx
    return total


class Moment:
    """The time that a load of a law file takes; what `Loads` wants of a load's data."""

    def __init__(self, mesh: Any, law: LawOnMesh) -> None:
        self.time = fem.Constant(mesh, 0.0)
        self.varies_in_time = "t" in law.takes

    def update(self, time: float) -> None:
        self.time.value = time


def add_body_force(problem: Problem, v: Any, loads: Loads) -> None:
    force = problem.scene.body_force
    if isinstance(force, OwnLaw):
        _add_own(problem, force, v, problem.dx, loads)
    elif force:
        f0 = Nodal(problem.V, problem.scene, force)
        loads.add(f0, fem.form(ufl.inner(f0.function, v) * problem.dx))


def add_sources(problem: Problem, eta: Any, loads: Loads) -> None:
    for piece in problem.pieces:
        source = piece.heat.source if piece.heat else None
        if isinstance(source, OwnLaw):
            _add_own(problem, source, eta, piece.dx, loads)
        elif isinstance(source, Expression):
            q0 = Nodal(problem.Q, problem.scene, [source])
            loads.add(q0, fem.form(q0.function * eta * piece.dx))


def _add_own(problem: Problem, own: OwnLaw, test: Any, dx: Any, loads: Loads) -> None:
    law = LawOnMesh(own, problem.constant)
    moment = Moment(problem.mesh, law)
    load = law(x=ufl.SpatialCoordinate(problem.mesh), t=moment.time)
    own_dx = measure(problem.body, problem.scene.degree, dx, True)
    loads.add(moment, fem.form(ufl.inner(load, test) * own_dx))
