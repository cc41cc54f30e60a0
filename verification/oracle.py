"""The oracle: the same scene as thermocontact's, solved with dolfinx from a weak form of its own.

    mpirun -n P python3 verification/oracle.py SCENE.toml --output DIR [--set KEY=VALUE]... [--quiet]
        [--solver amg] [--follow DIR]

Where time.tolerance adapts the steps, `--follow` names the results of the driver, whose steps.csv says which steps it
has taken: the oracle judges what is solved in them, not how they were chosen (adaptive.py does). So with the meshes of
mesh.refinement, which are those of the driver's fields at each step (refinement.py judges how they are chosen).

Each step solves, first, the momentum balance for the velocity w_s at its stage (time_steps.py; of backward Euler, its
end), with u_s = u_b + tau w_s and u_b, w_b, theta_b what the step knows of these before,

    rho (w_s - w_b, v)/tau + (V e(w_s) + E e(u_s), e(v)) - (theta' M, e(v))
      + int_C p_n(r) v.n + int_C p_t(r) w_st.v_t / |w_st|_eps  =  (f0, v) + int f1.v,

with the penetration r = u_s.n - g, and then the heat balance for theta_s,

    c (theta_s - theta_b, eta)/tau + (K grad theta_s, grad eta) - (R : e(u') + R' : e(w'), eta)
      + int_C k_c(r) phi_L(theta_s - theta_F) eta + int h (theta_s - theta_a) eta
      =  (q0, eta) + int q_in eta + share int_C p_t(r) |w_st|^2 / |w_st|_eps eta.

w_st is the tangential velocity over the foundation, which may move. The coupling terms are lagged, theta' = theta_{n-1},
u' = u_{n-1}, w' = w_{n-1} in backward Euler and in the other schemes what the rates lead to expect of theta_s, and u_s,
w_s; or both are solved in turn until theta_s no longer changes.

Physics that the scene leaves out contributes no form. Exit codes: 0 completed, 1 system, 2 scene, 3 numerics.
"""

import argparse
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from mpi4py import MPI
from petsc4py import PETSc

from oracle_parts import vtu
from oracle_parts.balances import HeatBalance, Momentum
from oracle_parts.body_laws import measure, stress
from oracle_parts.course import Parts, equal_steps, followed_steps
from oracle_parts.domain import follow as follow_mesh
from oracle_parts.errors import NumericsError, SceneError
from oracle_parts.followed_mesh import Carrier, read_mesh
from oracle_parts.problem import Problem, strain
from oracle_parts.results import CellStress, FieldWriter, History, Stopwatch
from oracle_parts.read_scene import read_scene
from oracle_parts.scene import Scene
from oracle_parts.summary import summary, write_summary
from oracle_parts.time_steps import Step, step_of

MOST_TURNS = 50  # of iterated coupling


def l2_norm(matrix: Any, vector: Any) -> float:
    """sqrt(x.A x): the norm that the matrix represents."""
    return float(np.sqrt(max(0.0, vector.dot(matrix * vector))))


def solve_in_turn(problem: Problem, step: Step, momentum: Momentum, heat: HeatBalance) -> int:
    """Each balance with what the other has just given, until theta_s no longer changes."""
    iterations, theta = 0, heat.theta.expected(step)
    for _ in range(MOST_TURNS):
        iterations += momentum.solve(step, theta)
        iterations += heat.solve(step, momentum.stage_u.x.array, momentum.stage_w.x.array)
        new = heat.stage_theta.x.array.copy()
        sizes = [float(np.abs(values).max(initial=0.0)) for values in (new - theta, new)]
        change, size = (problem.mesh.comm.allreduce(value, op=MPI.MAX) for value in sizes)
        if change <= problem.scene.coupling_tolerance * size:
            return iterations
        theta = new
    raise NumericsError("the coupling of momentum and heat balance did not converge")


def take(problem: Problem, step: Step, momentum: Momentum | None, heat: HeatBalance | None) -> int:
    """One step; returns the Newton iterations."""
    for side in problem.contacts:
        side.update(step.stage)
    balances = [balance for balance in (momentum, heat) if balance]
    for balance in balances:
        balance.begin(step)
    iterations = 0
    if momentum and heat and problem.scene.coupling_tolerance is not None:
        iterations += solve_in_turn(problem, step, momentum, heat)
    else:
        if momentum:
            iterations += momentum.solve(step, heat.theta.expected(step) if heat else None)
        if heat:
            lagged = problem.scene.radius is None
            u, w = (problem.u, problem.w) if lagged else (problem.stage_u, problem.stage_w)
            motion = (None, None) if u is None or w is None else (u.x.array, w.x.array)
            iterations += heat.solve(step, *motion)
    for balance in balances:
        balance.move(step)
    for side in problem.contacts:
        side.update(step.end)
    return iterations


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
                part, part_zz = stress(problem.mesh, tensor, strain(field))
                sigma, sigma_zz = sigma + part, sigma_zz + part_zz
        if heat and heat.thermal_stress is not None:
            sigma -= problem.theta * problem.constant(heat.thermal_stress)
            sigma_zz -= problem.theta * problem.constant(heat.thermal_stress_zz)
        own = any(tensor and tensor.own for tensor in (material.elasticity, material.viscosity))
        parts.append((sigma, sigma_zz, measure(problem.body, problem.scene.degree, piece.dx, own)))
    return CellStress(problem.body, parts)


def diagnostics(problem: Problem, momentum: Momentum | None, heat: HeatBalance | None) -> dict[str, float]:
    values = {"velocity_l2": 0.0, "displacement_strain_l2": 0.0, "temperature_l2": 0.0}
    if momentum:
        values["velocity_l2"] = l2_norm(momentum.mass, momentum.w_vector)
        values["displacement_strain_l2"] = l2_norm(
            momentum.strain_product, momentum.deformation_of(problem.u)
        )
    if heat:
        values["temperature_l2"] = l2_norm(heat.mass, heat.theta_vector)
    for side in problem.contacts:
        measures = side.measures(problem.u, problem.w).items()
        values.update({f"contact.{side.name}.{measure}": value for measure, value in measures})
    if not np.all(np.isfinite(list(values.values()))):
        raise NumericsError("a non-finite value in the solution")
    return values


class March:
    """The balances on the mesh at hand, and what follows when that changes."""

    def __init__(self, problem: Problem, directory: Path, watch: Stopwatch, follow: Path | None) -> None:
        self.directory, self.watch, self.follow = directory, watch, follow
        self.base = problem.body
        self.datasets: list[vtu.DataSet] = []
        self.mesh = read_mesh(follow, 0) if problem.scene.adapts_mesh else None
        self.solver_seconds = 0.0
        self._settle(problem)

    def _settle(self, problem: Problem) -> None:
        scene = problem.scene
        self.problem = problem
        self.momentum = Momentum(problem) if scene.material else None
        self.heat = HeatBalance(problem) if scene.heat else None
        fields = {"displacement": problem.u, "velocity": problem.w, "temperature": problem.theta}
        state = {name: function for name, function in fields.items() if function is not None}
        wants_stress = bool({"stress", "von_mises"} & set(scene.fields))
        stress = cell_stress(problem) if wants_stress else None
        writer = FieldWriter(self.directory, scene, problem.mesh, problem.Q, state, stress, problem.contacts)
        writer.datasets = self.datasets
        self.writer = writer

    @property
    def balances(self) -> list[Any]:
        return [balance for balance in (self.momentum, self.heat) if balance]

    @property
    def evolutions(self) -> list[Any]:
        of_momentum = [self.momentum.u, self.momentum.w] if self.momentum else []
        return of_momentum + ([self.heat.theta] if self.heat else [])

    def factor_seconds(self) -> float:
        equations = [balance.equations for balance in self.balances]
        return self.solver_seconds + sum(equation.solver_seconds for equation in equations)

    def change_mesh(self, step: int, time: float) -> None:
        """To that of the step, where it is another; before the first one, what the scene begins with is there anew."""
        next_mesh = read_mesh(self.follow, step)
        assert self.mesh is not None
        if next_mesh.same_as(self.mesh):
            return
        old, evolutions = self.problem, self.evolutions
        self.mesh, self.solver_seconds = next_mesh, self.factor_seconds()
        scene = replace(old.scene, places=next_mesh.nodes)
        body = follow_mesh(old.mesh.comm, scene, self.base, next_mesh)
        self._settle(Problem(old.mesh.comm, scene, old.solver, body))
        for side in self.problem.contacts:
            side.update(time)
        if step == 1:
            return
        for before, now in zip(evolutions, self.evolutions):
            carry = Carrier(before.function.function_space, now.function.function_space, scene.degree)
            now.function.x.array[:] = carry(before.function.x.array)
            now.rate = carry(before.rate)
        for balance, function in ((self.momentum, self.problem.u), (self.heat, self.problem.theta)):
            if balance:
                balance.prescribed.apply(function, time, lambda values, _: values)


def march(
    problem: Problem,
    parts: Parts,
    directory: Path,
    watch: Stopwatch,
    history: History,
    quiet: bool,
    follow: Path | None,
) -> Problem:
    """Returns the problem at the end, which is another one where the mesh has changed."""
    scene, comm = problem.scene, problem.mesh.comm
    course = March(problem, directory, watch, follow)
    watch.seconds["setup"] = watch.totals()["total"]

    with watch.timing("output"):
        course.writer.write(0, 0.0)
    before: float | None = None
    time = 0.0
    for step in range(1, scene.steps + 1):
        with watch.timing("steps"):
            if scene.adapts_mesh:
                course.change_mesh(step, time)
            problem = course.problem
            iterations = 0
            for end, size in parts[step]:
                one = step_of(scene.radius, time, end, size, before)
                iterations += take(problem, one, course.momentum, course.heat)
                time, before = end, size
            values = diagnostics(problem, course.momentum, course.heat)
        history.append(step, time, iterations, values)
        with watch.timing("output"):
            if step % scene.every == 0 or step == scene.steps:
                course.writer.write(step, time)
        if comm.rank == 0 and not quiet:
            print(f"step {step}/{scene.steps}  t = {time:g}  Newton iterations {iterations}", flush=True)
    watch.seconds["factor"] = course.factor_seconds()
    return problem


def run(comm: Any, scene: Scene, directory: Path, quiet: bool, solver: str, follow: Path | None) -> None:
    watch = Stopwatch()
    parts = followed_steps(scene, follow) if scene.adapts else equal_steps(scene)
    if comm.rank == 0:
        directory.mkdir(parents=True, exist_ok=True)
        for stale in ("fields.pvd", "history.csv", "summary.json"):
            (directory / stale).unlink(missing_ok=True)
    problem = Problem(comm, scene, solver)
    history = History(directory, comm)
    failure: NumericsError | None = None
    try:
        problem = march(problem, parts, directory, watch, history, quiet, follow)
    except NumericsError as caught:
        failure = caught
    history.close()
    status = "failed" if failure else "completed"
    write_summary(
        directory, comm, summary(scene, problem.mesh, problem.unknowns, status, history, watch, solver)
    )
    if failure:
        raise failure


def main(arguments: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(description="Solve a scene of thermocontact with dolfinx.")
    parser.add_argument("scene", type=Path)
    parser.add_argument("--output", type=Path, required=True, metavar="DIR")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", dest="settings")
    parser.add_argument("--follow", type=Path, metavar="DIR", help="results whose steps and meshes to take")
    parser.add_argument("--quiet", action="store_true")
    parser.add_argument("--solver", choices=("direct", "amg"), default="direct", help="MUMPS, or multigrid")
    options = parser.parse_args(arguments)
    comm = MPI.COMM_WORLD
    try:
        scene = read_scene(options.scene, options.settings)
        run(comm, scene, options.output, options.quiet, options.solver, options.follow)
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
