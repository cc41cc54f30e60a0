"""The two balances of a step, their linear parts assembled once for each tau."""

from collections.abc import Callable
from typing import Any

import ufl
from dolfinx import fem
from petsc4py import PETSc

from oracle_parts.body_laws import add_body_force, add_sources, stress_power
from oracle_parts.domain import Loads, Nodal, Prescribed
from oracle_parts.exact_friction import FrictionTerm, solve_with_multipliers
from oracle_parts.newton import StepEquation, Term
from oracle_parts.portability import petsc_vector
from oracle_parts.problem import Problem, assembled_matrix, strain
from oracle_parts.time_steps import Evolution, Step


class Equations:
    """The equation of one balance for each tau in use."""

    def __init__(self, tau: Any, make: Callable[[], StepEquation]) -> None:
        self.tau, self.make = tau, make
        self.made: dict[float, StepEquation] = {}

    def of(self, step: Step) -> StepEquation:
        self.tau.value = step.tau
        if step.tau not in self.made:
            self.made[step.tau] = self.make()
        return self.made[step.tau]

    @property
    def solver_seconds(self) -> float:
        return sum(equation.solver_seconds for equation in self.made.values())


class Momentum:
    """Finds w_s, then moves u and w on."""

    def __init__(self, problem: Problem) -> None:
        scene, tau = problem.scene, problem.tau
        material, heat = scene.material, scene.heat
        assert material is not None and problem.u is not None and problem.w is not None
        self.u, self.w = Evolution(problem.u), Evolution(problem.w)
        self.stage_u: Any = problem.stage_u
        self.stage_w: Any = problem.stage_w
        self.base_u, self.base_w = fem.Function(problem.V), fem.Function(problem.V)
        self.w_vector = petsc_vector(problem.w)
        self.base_w_vector = petsc_vector(self.base_w)
        self.base_u_vector = petsc_vector(self.base_u)
        self.deformation = fem.Function(problem.V)  # displacement less its mean
        self.deformation_vector = petsc_vector(self.deformation)
        self.keeps_rates = scene.radius is not None
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
            linear += (1 / tau) * inertia
        if material.viscosity:
            linear += stress_power(problem, "viscosity", strain(trial), strain(v))
        self.stiffness: Any = None
        if material.elasticity:
            elastic = stress_power(problem, "elasticity", strain(trial), strain(v))
            self.stiffness = assembled_matrix(elastic)
            linear += tau * elastic
        self.thermal: Any = None
        if heat and heat.thermal_stress is not None:
            theta_trial = ufl.TrialFunction(problem.Q)
            coupling = problem.sum(
                lambda law, part: theta_trial * dot(law(part.heat.thermal_stress), strain(v))
            )
            self.thermal = assembled_matrix(coupling)
            self.coupling_theta = fem.Function(problem.Q)
            self.coupling_vector = petsc_vector(self.coupling_theta)

        # Loads f0, f1 and prescribed displacements
        self.loads = Loads(fem.form(dot(problem.constant(scene.dimension * [0.0]), v) * dx))
        add_body_force(problem, v, self.loads)
        self.prescribed = Prescribed(problem.V, scene)
        springs: list[Any] = []  # side by side
        for name, boundary in scene.boundaries.items():
            side = problem.sides[name]
            if boundary.spring:
                k_s = problem.constant(boundary.spring.stiffness)
                springs.append(dot(k_s * trial, v) * side.ds())
                if boundary.spring.anchor:
                    far_end = Nodal(problem.V, scene, boundary.spring.anchor, side)
                    self.loads.add(far_end, fem.form(dot(k_s * far_end.function, v) * side.ds()))
            if boundary.traction:
                f1 = Nodal(problem.V, scene, boundary.traction, side)
                self.loads.add(f1, fem.form(dot(f1.function, v) * side.ds()))
            for component, value in enumerate(boundary.displacement or []):
                if value is not None:
                    self.prescribed.add(side, component, value)

        self.springs = [assembled_matrix(spring) for spring in springs]
        pulling = [tau * spring for spring in springs]

        # The contact terms, implicit in u_s = u_b + tau w_s
        terms = [
            term for side in problem.contacts for term in side.momentum_terms(self.base_u, tau, self.stage_w)
        ]
        self.frictions = [term for term in terms if isinstance(term, FrictionTerm)]
        self.comm, self.tolerance = problem.mesh.comm, scene.tolerance
        self.equations = Equations(
            tau,
            lambda: StepEquation(
                "momentum balance",
                assembled_matrix(linear, on_sides=pulling),
                assembled_matrix(linear, self.prescribed.bcs, pulling),
                self.prescribed.bcs,
                self.prescribed.dofs,
                self.stage_w,
                terms,
                nonlinear=bool(terms),
                tolerances=problem.tolerances,
                solver=problem.solver,
                symmetric=not any(contact.friction for contact in scene.contacts.values()),
            ),
        )

    def deformation_of(self, u: Any) -> Any:
        """u less its mean over the nodes, as a vector: translations have no strain.

        Products with u itself lose it where a body has moved far: the sum of a row's terms |A_ij u_j| = |A_ij| d, d the
        distance, is rounded to 2^-53 of its size, and in (A u, u) once more times d. ||e(u)||^2 is then wrong by d^2
        2^-53 times the matrix's size, more than its own at d = 100 m in scenes/benchmarks/sliding-block.toml.
        """
        index_map, components = u.function_space.dofmap.index_map, u.function_space.dofmap.index_map_bs
        rows = u.x.array.reshape(-1, components)
        total = rows[: index_map.size_local].sum(axis=0)
        mean = u.function_space.mesh.comm.allreduce(total) / index_map.size_global
        self.deformation.x.array[:] = (rows - mean).ravel()
        return self.deformation_vector

    def begin(self, step: Step) -> None:
        self.base_u.x.array[:] = self.u.base(step)
        self.base_w.x.array[:] = self.w.base(step)
        self.stage_w.x.array[:] = self.w.expected(step)
        base = self.base_u.x.array
        self.prescribed.apply(
            self.stage_w,
            step.end,
            lambda value, dofs: (self.u.at_stage(step, value, dofs) - base[dofs]) / step.tau,
        )

    def solve(self, step: Step, theta: Any) -> int:
        b = self.loads.at(step.stage)
        if self.inertia:
            b.axpy(1.0 / step.tau, self.inertia * self.base_w_vector)
        if self.stiffness:
            b.axpy(-1.0, self.stiffness * self.deformation_of(self.base_u))
        for spring in self.springs:
            b.axpy(-1.0, spring * self.base_u_vector)
        if self.thermal:
            self.coupling_theta.x.array[:] = theta
            b.axpy(1.0, self.thermal * self.coupling_vector)
        equation = self.equations.of(step)
        for term in self.frictions:
            term.friction.set_stiffness(equation.matrix)
        iterations = solve_with_multipliers(
            lambda polish: equation.solve(b, polish), self.frictions, self.comm, self.tolerance
        )
        self.stage_u.x.array[:] = self.base_u.x.array + step.tau * self.stage_w.x.array
        return iterations

    def move(self, step: Step) -> None:
        self.u.move(step, self.stage_u.x.array, self.keeps_rates)
        self.w.move(step, self.stage_w.x.array, self.keeps_rates)


class HeatBalance:
    """Finds theta_s, with u_s in the conductance, then moves theta on."""

    def __init__(self, problem: Problem) -> None:
        scene, tau = problem.scene, problem.tau
        heat = scene.heat
        assert heat is not None and problem.theta is not None
        self.theta, self.theta_vector = Evolution(problem.theta), petsc_vector(problem.theta)
        self.stage_theta, self.base_theta = fem.Function(problem.Q), fem.Function(problem.Q)
        self.base_vector = petsc_vector(self.base_theta)
        self.keeps_rates = scene.radius is not None
        trial, eta = ufl.TrialFunction(problem.Q), ufl.TestFunction(problem.Q)

        dx = problem.dx
        self.mass = assembled_matrix(trial * eta * dx)
        linear = 0
        self.capacity: Any = None
        if heat.capacity is not None:
            capacity = problem.sum(lambda law, part: law(part.heat.capacity) * trial * eta)
            self.capacity = assembled_matrix(capacity)
            linear += (1 / tau) * capacity
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
            self.coupling_u = fem.Function(problem.V)
            self.coupling_vector = petsc_vector(self.coupling_u)
        self.rate_heating: Any = None
        if heat.strain_rate_heating is not None:
            w_trial = ufl.TrialFunction(problem.V)
            coupling = problem.sum(
                lambda law, part: ufl.inner(law(part.heat.strain_rate_heating), strain(w_trial)) * eta
            )
            self.rate_heating = assembled_matrix(coupling)
            self.coupling_w = fem.Function(problem.V)
            self.rate_vector = petsc_vector(self.coupling_w)

        # Sources q0, fluxes q_in and prescribed temperatures
        self.loads = Loads(fem.form(problem.constant(0.0) * eta * dx))
        add_sources(problem, eta, self.loads)
        self.prescribed = Prescribed(problem.Q, scene)
        exchange: list[Any] = []  # with the air, side by side
        for name, boundary in scene.boundaries.items():
            side = problem.sides[name]
            if boundary.heat_flux:
                q_in = Nodal(problem.Q, scene, [boundary.heat_flux], side)
                self.loads.add(q_in, fem.form(q_in.function * eta * side.ds()))
            if boundary.convection:
                h = problem.constant(boundary.convection.coefficient)
                exchange.append(h * trial * eta * side.ds())
                theta_a = Nodal(problem.Q, scene, [boundary.convection.ambient_temperature], side)
                self.loads.add(theta_a, fem.form(h * theta_a.function * eta * side.ds()))
            if boundary.temperature:
                self.prescribed.add(side, 0, boundary.temperature)

        # The contact's conductance; it is nonlinear in theta only where phi_L has a finite limit
        terms: list[Term] = [
            term for side in problem.contacts if (term := side.heat_term(problem.stage_u, self.stage_theta))
        ]
        self.rubbing = [
            heat_of_side
            for side in problem.contacts
            if (heat_of_side := side.friction_heat(problem.stage_u, problem.stage_w))
        ]
        self.rubbed = fem.Function(problem.Q)
        self.rubbed_vector = petsc_vector(self.rubbed)
        laws = [contact.conductance for contact in scene.contacts.values()]
        self.equations = Equations(
            tau,
            lambda: StepEquation(
                "heat balance",
                assembled_matrix(linear, on_sides=exchange),
                assembled_matrix(linear, self.prescribed.bcs, exchange),
                self.prescribed.bcs,
                self.prescribed.dofs,
                self.stage_theta,
                terms,
                nonlinear=any(law is not None and (law.limit is not None or law.own) for law in laws),
                tolerances=problem.tolerances,
                solver=problem.solver,
                symmetric=True,
            ),
        )

    def begin(self, step: Step) -> None:
        self.base_theta.x.array[:] = self.theta.base(step)
        self.stage_theta.x.array[:] = self.theta.expected(step)
        self.prescribed.apply(
            self.stage_theta, step.end, lambda value, dofs: self.theta.at_stage(step, value, dofs)
        )

    def solve(self, step: Step, u: Any, w: Any) -> int:
        """`u` and `w` of the coupling; the heat of friction takes what the momentum balance has just found."""
        b = self.loads.at(step.stage)
        if self.capacity:
            b.axpy(1.0 / step.tau, self.capacity * self.base_vector)
        if self.strain_heating:
            self.coupling_u.x.array[:] = u
            b.axpy(1.0, self.strain_heating * self.coupling_vector)
        if self.rate_heating:
            self.coupling_w.x.array[:] = w
            b.axpy(1.0, self.rate_heating * self.rate_vector)
        if self.rubbing:
            vector = self.rubbed_vector
            with vector.localForm() as local:
                local.set(0.0)
            for heat_of_side in self.rubbing:
                heat_of_side.add_to(vector)
            vector.ghostUpdate(addv=PETSc.InsertMode.ADD, mode=PETSc.ScatterMode.REVERSE)
            b.axpy(1.0, vector)
        return self.equations.of(step).solve(b)

    def move(self, step: Step) -> None:
        self.theta.move(step, self.stage_theta.x.array, self.keeps_rates)
