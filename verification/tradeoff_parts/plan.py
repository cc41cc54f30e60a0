"""The designed set of configurations: each knob turned alone from one base, the scene as it is, the paper's choice, bargains."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from tradeoff_parts.choice import Choice, Coupling, Quadrature, Regularisation, Solver, Space, Time
from tradeoff_parts.facts import Facts

DEFAULT, PAPER, BARGAIN = "the scene as it is", "the paper's h = k", "bargains"
FINE, FINER = 4.0, 16.0  # ratios of the grading at a side, tried for the reference
REFINED = {0: 16, 2: 32, 3: 16}  # the reference's steps over the scene's, by dimension (0: a mesh of a file)
COARSER = (2.0, 4.0)  # by what the reference's h and k are made coarser
EXACT_RULE = 4  # the finest one that goes with Coulomb's law itself
TIGHT = 1e-12  # Newton's relative residual in all that is not about it
TIGHT_COUPLING = 1e-6
BASE_COUPLING = 1e-3
FIRST_ORDER, PREFERRED = "backward-euler", "bdf2"
NOT_ADAPTIVE = "midpoint"


@dataclass(frozen=True)
class Knob:
    """`theory`: orders in `value` of ||w||_L2, ||eps(u)||_L2, ||theta||_L2 for smooth solutions; `why` where it has none.
    `ways`: of one that leads to the same solution either way, by the numbers 1 and 2, what these are."""

    source: str | None  # whose error it turns; None: several
    theory: tuple[float, float, float] | None = None
    why: str = ""
    ways: tuple[str, str] | None = None


@dataclass(frozen=True)
class Configuration:
    """`value` places it on its knob: the error is expected to fall with value^order."""

    knob: str
    value: float
    choice: Choice


def step_knob(scheme: str) -> str:
    return f"step, {scheme}"


def tolerance_knob(scheme: str) -> str:
    return f"tolerance, {scheme}"


def lagged_knob(scheme: str) -> str:
    return f"lagged coupling, {scheme}"


MESH_1, MESH_2, GRADED = "mesh, degree 1", "mesh, degree 2", "mesh, degree 2, graded"
DEGREE, EPSILON, EXACT, RULE = "degree", "epsilon", "exact Coulomb", "contact quadrature"
NEWTON, ITERATED, STRATEGY = "Newton tolerance", "coupling tolerance", "strategy"
FACTOR = "precision of the factor"
STRATEGIES, FACTORS = ("condensed", "newton-krylov"), ("double", "single")


def knobs(facts: Facts) -> Mapping[str, Knob]:
    """In the order in which tables and pictures have them."""
    found = {}
    for scheme in facts.schemes:
        order = 1.0 if scheme == FIRST_ORDER else 2.0
        found[step_knob(scheme)] = Knob("time", (order, order, order))
    for scheme in facts.schemes:
        # errors of a step are k^(p+1), of all of them the tolerance^(p/(p+1))
        order = 1 / 2 if scheme == FIRST_ORDER else 2 / 3
        found[tolerance_knob(scheme)] = Knob("time", (order, order, order))
    lagged = {
        lagged_knob(scheme): Knob("coupling", found[step_knob(scheme)].theory) for scheme in facts.schemes
    }
    kinks = "integrands with kinks where contact ends: no order"
    return found | {
        MESH_1: Knob("space", (2.0, 1.0, 2.0)),
        MESH_2: Knob("space", (3.0, 2.0, 3.0)),
        GRADED: Knob("space", (3.0, 2.0, 3.0)),
        DEGREE: Knob("space", why="two degrees on one mesh: no order"),
        EPSILON: Knob("regularisation", (1.0, 1.0, 1.0)),
        EXACT: Knob("regularisation", why="the limit itself"),
        RULE: Knob("quadrature", why=kinks),
        NEWTON: Knob("solver", (1.0, 1.0, 1.0)),
        ITERATED: Knob("coupling", (1.0, 1.0, 1.0)),
        **lagged,
        STRATEGY: Knob("solver", why="the same solution by another way", ways=STRATEGIES),
        FACTOR: Knob("solver", why="the same solution from half the bytes", ways=FACTORS),
        DEFAULT: Knob(None),
        PAPER: Knob(None, why="h, k, epsilon and lagged coupling at once"),
        BARGAIN: Knob(None, why="several knobs at once"),
    }


def scaled(cells: tuple[int, ...] | None, factor: float) -> tuple[int, ...] | None:
    return None if cells is None else tuple(max(1, round(count * factor)) for count in cells)


def as_it_is(facts: Facts) -> Choice:
    return Choice(
        Solver(facts.solver_tolerance, facts.strategy, facts.factor),
        Coupling(facts.iterated),
        Time(facts.scheme, facts.steps),
        Regularisation(1.0),
        Quadrature(None),
        Space(facts.cells, facts.degree),
    )


@dataclass(frozen=True)
class Plan:
    """`finer` times the cells and steps of the default reference; its `grading`, None where there is none."""

    facts: Facts
    finer: int = 1
    grading: tuple[float, ...] | None = None

    @property
    def uniform(self) -> tuple[float, ...] | None:
        return (1.0,) * len(self.facts.sides) if self.facts.gradable else None

    @property
    def factor(self) -> int:
        """Of the scene's cells, in the default reference."""
        return 2 if self.facts.dimension == 2 else 3

    def finest(self, coarser: float = 1.0) -> tuple[int, ...] | None:
        """The reference's cells, to the next multiple of four so that they can be halved twice; or made coarser."""
        cells = self.facts.cells
        if cells is None:
            return None
        return tuple(
            round(4 * max(1, round(count * self.factor * self.finer / 4)) / coarser) for count in cells
        )

    def gradings(self) -> list[tuple[float, ...]]:
        """That the reference may have, the uniform one first; none where the mesh cannot be graded."""
        if self.uniform is None:
            return []
        sides, contacts = self.facts.sides, self.facts.contacts
        tried = [self.uniform, *((ratio,) * len(sides) for ratio in (FINE, FINER))]
        if contacts:
            tried.append(tuple(FINE if side in contacts else 1.0 for side in sides))
            tried.append(tuple(1.0 if side in contacts else FINER for side in sides))
        return tried

    @property
    def best_rule(self) -> int:
        """Of the contact integrals: the schema's finest, of Coulomb's law itself the finest that it has."""
        return EXACT_RULE if self.facts.exact else 9

    @property
    def second_order(self) -> str:
        return PREFERRED if PREFERRED in self.facts.schemes else self.facts.schemes[-1]

    def reference(self) -> Choice:
        """Beyond every configuration in all that errs."""
        return Choice(
            Solver(TIGHT, "auto"),
            Coupling(TIGHT_COUPLING),
            Time(self.second_order, REFINED[self.facts.dimension] * self.finer * self.facts.steps),
            Regularisation(0.01),
            Quadrature(self.best_rule if self.facts.contacts else None),
            Space(self.finest(), 2, self.grading),
        )

    def coarser(self) -> Mapping[str, tuple[Sequence[float], float, list[Choice]]]:
        """For each source: ratios to the reference, theory's order in the worst of the norms, the reference made coarser
        by these, once or twice. The contact rule has no order; 3 points in place of 5 (2 of 3) count as a ratio of 5/3, of order 1.
        """
        best = self.reference()
        time, space = best.time, best.space
        times = [replace(time, steps=round(time.steps / coarser)) for coarser in COARSER]
        found: dict[str, tuple[Sequence[float], float, list[Choice]]] = {
            "solver": ([100.0], 1.0, [replace(best, solver=Solver(100 * TIGHT, "auto"))]),
            "coupling": ([10.0], 1.0, [replace(best, coupling=Coupling(10 * TIGHT_COUPLING))]),
            "time": (COARSER, 2.0, [replace(best, time=coarse) for coarse in times]),
            "regularisation": (
                [10.0, 100.0],
                1.0,
                [replace(best, regularisation=Regularisation(factor)) for factor in (0.1, 1.0)],
            ),
            "quadrature": (
                [5 / 3],
                1.0,
                [replace(best, quadrature=Quadrature(4 if self.best_rule > 4 else 2))],
            ),
        }
        if self.facts.cells:
            meshes = [replace(space, cells=self.finest(coarser)) for coarser in COARSER]
            found["space"] = (COARSER, 2.0, [replace(best, space=mesh) for mesh in meshes])
        return found

    def pilots(self, grading: tuple[float, ...]) -> tuple[Choice, Choice]:
        """With that grading two meshes in few steps: the better it is, the less do they differ."""
        coarse, fine = (self.finest(coarser) for coarser in reversed(COARSER))
        base = replace(self.base(), time=Time(self.second_order, self.facts.steps))
        return replace(base, space=Space(coarse, 2, grading)), replace(base, space=Space(fine, 2, grading))

    def base(self) -> Choice:
        """Where all knobs stand that are not turned."""
        return Choice(
            Solver(TIGHT, "auto"),
            Coupling(BASE_COUPLING),
            Time(self.second_order, 4 * self.facts.steps),
            Regularisation(0.1),
            Quadrature(self.best_rule if self.facts.contacts else None),
            Space(
                scaled(self.facts.cells, self.sizes[1] if self.facts.dimension == 2 else 1.0), 2, self.grading
            ),
        )

    @property
    def sizes(self) -> list[float]:
        """Of uniform meshes, as factors of the scene's cells."""
        return [0.25, 0.5, 1.0, 2.0] if self.facts.dimension == 2 else [1.0, 2.0, 3.0]

    def step_counts(self) -> list[int]:
        counts, count = [], self.facts.outputs
        while count <= 4 * self.facts.steps:
            counts += [count] if 2 * count >= self.facts.steps else []
            count *= 2
        return counts

    def configurations(self) -> Iterator[Configuration]:
        yield Configuration(DEFAULT, 1.0, as_it_is(self.facts))
        yield from self._in_time()
        yield from self._in_space()
        yield from self._in_contact()
        yield from self._in_solver()
        yield from self._paper()
        yield from self._bargains()

    def _in_time(self) -> Iterator[Configuration]:
        base = self.base()
        for scheme in self.facts.schemes:
            for steps in self.step_counts():
                choice = replace(base, time=Time(scheme, steps))
                yield Configuration(step_knob(scheme), self.facts.end / steps, choice)
            for tolerance in (1e-2, 1e-3, 1e-4) if scheme in (FIRST_ORDER, self.second_order) else ():
                choice = replace(base, time=Time(scheme, self.facts.outputs, tolerance))
                yield Configuration(tolerance_knob(scheme), tolerance, choice)

    def _in_space(self) -> Iterator[Configuration]:
        base, cells = self.base(), self.facts.cells
        if cells is None:
            for degree in (1, 2):
                yield Configuration(DEGREE, 1.0 / degree, replace(base, space=Space(None, degree)))
            return
        sizes = self.sizes
        for knob, degree, ratio, factors in (
            (MESH_1, 1, self.uniform, sizes),
            (MESH_2, 2, self.uniform, sizes[:-1]),
            (GRADED, 2, self.grading, sizes[:-1] if self.grading != self.uniform else []),
        ):
            for factor in factors:
                mesh = Space(scaled(cells, factor), degree, ratio)
                yield Configuration(knob, 1 / factor, replace(base, space=mesh))

    def _in_contact(self) -> Iterator[Configuration]:
        base = self.base()
        for factor in (10.0, 1.0, 0.1) if self.facts.regularisation else ():
            yield Configuration(EPSILON, factor, replace(base, regularisation=Regularisation(factor)))
        if self.facts.regularisation and self.facts.may_be_exact:
            exact = replace(base, regularisation=Regularisation(0.0), quadrature=Quadrature(EXACT_RULE))
            yield Configuration(EXACT, 1.0, exact)
        for rule in [rule for rule in (2, 4, 6, 9) if rule <= self.best_rule] if self.facts.contacts else []:
            yield Configuration(RULE, 1 / (rule // 2 + 1), replace(base, quadrature=Quadrature(rule)))
        if self.facts.contacts:
            yield Configuration(RULE, 1 / 2, replace(base, quadrature=Quadrature("vertex")))

    def _in_solver(self) -> Iterator[Configuration]:
        base = self.base()
        for tolerance in (1e-2, 1e-3, 1e-4, 1e-6, 1e-8):
            yield Configuration(NEWTON, tolerance, replace(base, solver=Solver(tolerance, "auto")))
        for number, strategy in enumerate(STRATEGIES):
            yield Configuration(STRATEGY, number + 1.0, replace(base, solver=Solver(TIGHT, strategy)))
        for number, factor in enumerate(FACTORS):
            choice = replace(base, solver=Solver(TIGHT, "condensed", factor))
            yield Configuration(FACTOR, number + 1.0, choice)
        if self.facts.coupled:
            for tolerance in (1e-1, 1e-2, 1e-3, 1e-4):
                yield Configuration(ITERATED, tolerance, replace(base, coupling=Coupling(tolerance)))
            for scheme in (FIRST_ORDER, self.second_order):
                for steps in self.step_counts():
                    choice = replace(base, time=Time(scheme, steps), coupling=Coupling(None))
                    yield Configuration(lagged_knob(scheme), self.facts.end / steps, choice)

    def _paper(self) -> Iterator[Configuration]:
        """Backward Euler, lagged, uniform meshes of degree 1, the scene's epsilon; k falls as h does."""
        outputs, steps = self.facts.outputs, self.facts.steps
        for factor in self.sizes if self.facts.cells else []:
            count = max(1, round(factor * steps / outputs)) * outputs
            mesh = Space(scaled(self.facts.cells, factor), 1, self.uniform)
            choice = replace(as_it_is(self.facts), space=mesh, time=Time(FIRST_ORDER, count))
            yield Configuration(PAPER, 1 / factor, replace(choice, coupling=Coupling(None)))

    def _bargains(self) -> Iterator[Configuration]:
        base = self.base()
        meshes = (
            [scaled(self.facts.cells, self.factor / f) for f in (8, 4, 2)] if self.facts.cells else [None]
        )
        counts = [count * self.facts.steps for count in (1, 2, 4)]
        for cells, steps in zip(meshes, counts):
            mesh = Space(cells, 2, self.grading)
            yield Configuration(
                BARGAIN, 1 / steps, replace(base, space=mesh, time=Time(self.second_order, steps))
            )
        for cells, tolerance in zip(meshes[1:], (1e-2, 1e-3)):
            choice = replace(base, space=Space(cells, 2, self.grading))
            adapted = Time(self.second_order, self.facts.outputs, tolerance)
            yield Configuration(BARGAIN, tolerance, replace(choice, time=adapted))
