"""The oracle: the same scene as thermocontact's, solved with dolfinx from a weak form of its own.

    mpirun -n P python3 verification/oracle.py SCENE.toml --output DIR [--set KEY=VALUE]... [--quiet]

Backward Euler with step k for u, w = u', theta. Each step solves, first, the momentum balance for w_n,

    rho (w_n - w_{n-1}, v)/k + (V e(w_n) + E e(u_n), e(v)) - (theta_{n-1} M, e(v))
      + int_C p_n(r) v.n + int_C p_t(r) w_nt.v_t / |w_nt|_eps  =  (f0, v) + int f1.v,     u_n = u_{n-1} + k w_n,

with the penetration r = u_n.n - g, and then the heat balance for theta_n,

    c (theta_n - theta_{n-1}, eta)/k + (K grad theta_n, grad eta) - (R : e(u_{n-1}), eta)
      + int_C k_c(r) phi_L(theta_n - theta_F) eta  =  (q0, eta) + int q_in eta.

Physics that the scene leaves out contributes no form. Exit codes: 0 completed, 1 system, 2 scene, 3 numerics.
"""

import argparse
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import ufl
from dolfinx import fem
from dolfinx.fem import petsc as fem_petsc
from mpi4py import MPI
from petsc4py import PETSc

from oracle_parts.contact import ContactSide
from oracle_parts.domain import Body, Loads, Nodal, Prescribed, Side, create_body
from oracle_parts.errors import NumericsError, SceneError
from oracle_parts.newton import StepEquation, Term, Tolerances
from oracle_parts.portability import lagrange_space, petsc_vector
from oracle_parts.results import CellStress, FieldWriter, History, Stopwatch
from oracle_parts.scene import Heat, Material, Scene, read_scene
from oracle_parts.summary import summary, write_summary


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


def assembled_matrix(form: Any, bcs: Sequence[Any] = ()) -> Any:
    matrix = fem_petsc.assemble_matrix(fem.form(form), bcs=list(bcs))
    matrix.assemble()
    return matrix


def l2_norm(matrix: Any, vector: Any) -> float:
    """sqrt(x.A x): the norm that the matrix represents."""
    return float(np.sqrt(max(0.0, vector.dot(matrix * vector))))


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

    def __init__(self, comm: Any, scene: Scene) -> None:
        self.scene, self.body = scene, create_body(comm, scene)
        self.mesh, self.dx, self.pieces = self.body.mesh, self.body.dx(), pieces_of(self.body, scene)
        self.k = fem.Constant(self.mesh, scene.step)
        self.Q = lagrange_space(self.mesh, scene.degree)
        self.V = lagrange_space(self.mesh, scene.degree, scene.dimension) if scene.material else None
        self.u = self.w = self.theta = None
        if scene.material:
            self.u = Nodal(self.V, scene, scene.initial_displacement).function
            self.w = Nodal(self.V, scene, scene.initial_velocity).function
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


class Momentum:
    """Finds w_n, then moves u on by k w_n."""

    def __init__(self, problem: Problem) -> None:
        scene, k, u, w = problem.scene, problem.k, problem.u, problem.w
        material, heat = scene.material, scene.heat
        assert material is not None and u is not None and w is not None
        self.u, self.w, self.step = u, w, scene.step
        self.u_vector, self.w_vector = petsc_vector(u), petsc_vector(w)
        trial, v = ufl.TrialFunction(problem.V), ufl.TestFunction(problem.V)

        # The linear part, and the matrices that carry the previous step to the right-hand side
        dot, dx = ufl.inner, problem.dx
        self.mass = assembled_matrix(dot(trial, v) * dx)
        self.strain_product = assembled_matrix(dot(strain(trial), strain(v)) * dx)
        linear = 0
        self.inertia: Any = None
        if material.density is not None:
            inertia = problem.sum(lambda law, part: law(part.material.density) * dot(trial, v))
            self.inertia = assembled_matrix(inertia)
            linear += (1 / k) * inertia
        if material.viscosity:
            linear += self._stress_form(problem, "viscosity", trial, v)
        self.stiffness: Any = None
        if material.elasticity:
            elastic = self._stress_form(problem, "elasticity", trial, v)
            self.stiffness = assembled_matrix(elastic)
            linear += k * elastic
        self.thermal: Any = None
        if heat and heat.thermal_stress is not None:
            theta_trial = ufl.TrialFunction(problem.Q)
            coupling = problem.sum(
                lambda law, part: theta_trial * dot(law(part.heat.thermal_stress), strain(v))
            )
            self.thermal = assembled_matrix(coupling)
            self.theta_vector = petsc_vector(problem.theta)

        # Loads f0, f1 and prescribed displacements
        self.loads = Loads(fem.form(dot(problem.constant(scene.dimension * [0.0]), v) * dx))
        if scene.body_force:
            f0 = Nodal(problem.V, scene, scene.body_force)
            self.loads.add(f0, fem.form(dot(f0.function, v) * dx))
        self.prescribed = Prescribed(problem.V, scene)
        for name, boundary in scene.boundaries.items():
            side = problem.sides[name]
            if boundary.traction:
                f1 = Nodal(problem.V, scene, boundary.traction, side)
                self.loads.add(f1, fem.form(dot(f1.function, v) * side.ds()))
            for component, value in enumerate(boundary.displacement or []):
                if value is not None:
                    self.prescribed.add(side, component, value)

        # The contact terms, implicit in u_n = u_{n-1} + k w_n
        terms = [term for side in problem.contacts if (term := side.momentum_term(u + k * w, w))]
        self.equation = StepEquation(
            "momentum balance",
            assembled_matrix(linear),
            assembled_matrix(linear, self.prescribed.bcs),
            self.prescribed.bcs,
            self.prescribed.dofs,
            w,
            terms,
            nonlinear=bool(terms),
            tolerances=problem.tolerances,
        )

    @staticmethod
    def _stress_form(problem: Problem, law: str, trial: Any, v: Any) -> Any:
        def stress_power(constant: Callable[[Any], Any], part: Piece) -> Any:
            voigt = constant(getattr(part.material, law).voigt)
            return ufl.inner(apply_voigt(voigt, strain(trial)), strain(v))

        return problem.sum(stress_power)

    def advance(self, time: float) -> int:
        b = self.loads.at(time)
        if self.inertia:
            b.axpy(1.0 / self.step, self.inertia * self.w_vector)
        if self.stiffness:
            b.axpy(-1.0, self.stiffness * self.u_vector)
        if self.thermal:
            b.axpy(1.0, self.thermal * self.theta_vector)
        old = self.u.x.array
        self.prescribed.apply(self.w, time, lambda value, dofs: (value - old[dofs]) / self.step)
        iterations = self.equation.solve(b)
        self.u.x.array[:] += self.step * self.w.x.array
        return iterations


class HeatBalance:
    """Finds theta_n, with u_n in the conductance and u_{n-1} in the strain heating."""

    def __init__(self, problem: Problem) -> None:
        scene, k, theta = problem.scene, problem.k, problem.theta
        heat = scene.heat
        assert heat is not None and theta is not None
        self.theta, self.step, self.theta_vector = theta, scene.step, petsc_vector(theta)
        trial, eta = ufl.TrialFunction(problem.Q), ufl.TestFunction(problem.Q)

        dx = problem.dx
        self.mass = assembled_matrix(trial * eta * dx)
        linear = 0
        self.capacity: Any = None
        if heat.capacity is not None:
            capacity = problem.sum(lambda law, part: law(part.heat.capacity) * trial * eta)
            self.capacity = assembled_matrix(capacity)
            linear += (1 / k) * capacity
        if heat.conductivity is not None:
            linear += problem.sum(
                lambda law, part: ufl.inner(law(part.heat.conductivity) * ufl.grad(trial), ufl.grad(eta))
            )
        self.strain_heating: Any = None
        if heat.strain_heating is not None:
            u_trial = ufl.TrialFunction(problem.V)
            coupling = problem.sum(
                lambda law, part: ufl.inner(law(part.heat.strain_heating), strain(u_trial)) * eta
            )
            self.strain_heating = assembled_matrix(coupling)
            self.u_vector = petsc_vector(problem.u)

        # Sources q0, fluxes q_in and prescribed temperatures
        self.loads = Loads(fem.form(problem.constant(0.0) * eta * dx))
        for piece in problem.pieces:
            if piece.heat and piece.heat.source:
                q0 = Nodal(problem.Q, scene, [piece.heat.source])
                self.loads.add(q0, fem.form(q0.function * eta * piece.dx))
        self.prescribed = Prescribed(problem.Q, scene)
        for name, boundary in scene.boundaries.items():
            side = problem.sides[name]
            if boundary.heat_flux:
                q_in = Nodal(problem.Q, scene, [boundary.heat_flux], side)
                self.loads.add(q_in, fem.form(q_in.function * eta * side.ds()))
            if boundary.temperature:
                self.prescribed.add(side, 0, boundary.temperature)

        # The contact's conductance; it is nonlinear in theta only where phi_L has a finite limit
        terms: list[Term] = [term for side in problem.contacts if (term := side.heat_term(problem.u, theta))]
        laws = [contact.conductance for contact in scene.contacts.values()]
        self.equation = StepEquation(
            "heat balance",
            assembled_matrix(linear),
            assembled_matrix(linear, self.prescribed.bcs),
            self.prescribed.bcs,
            self.prescribed.dofs,
            theta,
            terms,
            nonlinear=any(law is not None and law.limit is not None for law in laws),
            tolerances=problem.tolerances,
        )

    def right_hand_side(self, time: float) -> Any:
        """To be asked for before the momentum balance moves u on: the coupling takes u_{n-1}."""
        b = self.loads.at(time)
        if self.capacity:
            b.axpy(1.0 / self.step, self.capacity * self.theta_vector)
        if self.strain_heating:
            b.axpy(1.0, self.strain_heating * self.u_vector)
        return b

    def advance(self, time: float, b: Any) -> int:
        self.prescribed.apply(self.theta, time, lambda value, dofs: value)
        return self.equation.solve(b)


def cell_stress(problem: Problem) -> CellStress:
    """sigma = E e(u) + V e(w) - theta M, all at the current step, and sigma_zz of plane strain."""
    parts = []
    for piece in problem.pieces:
        material, heat = piece.material, piece.heat
        assert material is not None
        zero = problem.constant(0.0)
        sigma, sigma_zz = zero * strain(problem.u), zero
        for tensor, field in ((material.elasticity, problem.u), (material.viscosity, problem.w)):
            if tensor:
                sigma += apply_voigt(problem.constant(tensor.voigt), strain(field))
                sigma_zz += problem.constant(tensor.out_of_plane) * ufl.tr(strain(field))
        if heat and heat.thermal_stress is not None:
            sigma -= problem.theta * problem.constant(heat.thermal_stress)
            sigma_zz -= problem.theta * problem.constant(heat.thermal_stress_zz)
        parts.append((sigma, sigma_zz, piece.dx))
    return CellStress(problem.body, parts)


def diagnostics(problem: Problem, momentum: Momentum | None, heat: HeatBalance | None) -> dict[str, float]:
    values = {"velocity_l2": 0.0, "displacement_strain_l2": 0.0, "temperature_l2": 0.0}
    if momentum:
        values["velocity_l2"] = l2_norm(momentum.mass, momentum.w_vector)
        values["displacement_strain_l2"] = l2_norm(momentum.strain_product, momentum.u_vector)
    if heat:
        values["temperature_l2"] = l2_norm(heat.mass, heat.theta_vector)
    for side in problem.contacts:
        measures = side.measures(problem.u).items()
        values.update({f"contact.{side.name}.{measure}": value for measure, value in measures})
    if not np.all(np.isfinite(list(values.values()))):
        raise NumericsError("a non-finite value in the solution")
    return values


def march(problem: Problem, directory: Path, watch: Stopwatch, history: History, quiet: bool) -> None:
    scene, comm = problem.scene, problem.mesh.comm
    momentum = Momentum(problem) if scene.material else None
    heat = HeatBalance(problem) if scene.heat else None
    fields = {"displacement": problem.u, "velocity": problem.w, "temperature": problem.theta}
    state = {name: function for name, function in fields.items() if function is not None}
    wants_stress = bool({"stress", "von_mises"} & set(scene.fields))
    stress = cell_stress(problem) if wants_stress else None
    writer = FieldWriter(directory, scene, problem.mesh, problem.Q, state, stress, problem.contacts)
    watch.seconds["setup"] = watch.totals()["total"]

    with watch.timing("output"):
        writer.write(0, 0.0)
    for step in range(1, scene.steps + 1):
        time = step * scene.step
        with watch.timing("steps"):
            for side in problem.contacts:
                side.update(time)
            iterations = 0
            heat_b = heat.right_hand_side(time) if heat else None
            if momentum:
                iterations += momentum.advance(time)
            if heat:
                iterations += heat.advance(time, heat_b)
            values = diagnostics(problem, momentum, heat)
        history.append(step, time, iterations, values)
        with watch.timing("output"):
            if step % scene.every == 0 or step == scene.steps:
                writer.write(step, time)
        if comm.rank == 0 and not quiet:
            print(f"step {step}/{scene.steps}  t = {time:g}  Newton iterations {iterations}", flush=True)
    equations = [balance.equation for balance in (momentum, heat) if balance]
    watch.seconds["factor"] = sum(equation.solver_seconds for equation in equations)


def run(comm: Any, scene: Scene, directory: Path, quiet: bool) -> None:
    watch = Stopwatch()
    if comm.rank == 0:
        directory.mkdir(parents=True, exist_ok=True)
        for stale in ("fields.pvd", "history.csv", "summary.json"):
            (directory / stale).unlink(missing_ok=True)
    problem = Problem(comm, scene)
    history = History(directory, comm)
    failure: NumericsError | None = None
    try:
        march(problem, directory, watch, history, quiet)
    except NumericsError as caught:
        failure = caught
    history.close()
    status = "failed" if failure else "completed"
    write_summary(directory, comm, summary(scene, problem.mesh, problem.unknowns, status, history, watch))
    if failure:
        raise failure


def main(arguments: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(description="Solve a scene of thermocontact with dolfinx.")
    parser.add_argument("scene", type=Path)
    parser.add_argument("--output", type=Path, required=True, metavar="DIR")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", dest="settings")
    parser.add_argument("--quiet", action="store_true")
    options = parser.parse_args(arguments)
    comm = MPI.COMM_WORLD
    try:
        run(comm, read_scene(options.scene, options.settings), options.output, options.quiet)
    except SceneError as problem:
        return report(comm, problem, 2)
    except NumericsError as problem:
        return report(comm, problem, 3)
    except (OSError, MemoryError, PETSc.Error) as problem:
        # The other processes may be waiting for this one: a plain return would leave them so.
        print(f"oracle: {problem}", file=sys.stderr, flush=True)
        if comm.size > 1:
            comm.Abort(1)
        return 1
    return 0


def report(comm: Any, problem: Exception, code: int) -> int:
    if comm.rank == 0:
        print(f"oracle: {problem}", file=sys.stderr)
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
