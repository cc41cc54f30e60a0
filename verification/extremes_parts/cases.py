"""The cases: each parameter alone, in space and by the other strategy, pairs on a grid, random draws, and situations.

A case is a name (unique, what it does), a group, and a scene. Draws come from one seed, so that a name always means
the same scene.
"""

import itertools
import random
from collections.abc import Iterator
from dataclasses import dataclass

from extremes_parts.parameters import BASE, BY_NAME, CONTACT, IN_SPACE, PAIRS, PARAMETERS, Parameter, in_space
from extremes_parts.situations import situations, situations_in_space
from matrix_parts.scenes import Flat, changed

# They stopped or ended badly once: motions that nothing held, round-off beyond the tolerance, friction half way from
# the regularisation that continuation begins with, balances that were not kept
MENDED = frozenset(
    (
        "static and free, open",
        "static, held by frictionless contact only",
        "stationary heat, insulated",
        "impact on a stiff foundation, aslant",
        "epsilon = 1e-14",
        "epsilon = 1e-14, mu = 1",
        "a coupling that blows up",
        "heat that flows no more, steps of 2e-6",
        "a stiff body turned by its initial displacement",
        *(f"draw {number}" for number in (69, 72, 74, 150, 157, 199, 217)),
    )
)
# Driver and oracle once differed by more than 1e-9 (the oracle's normals were rounded; multipliers of a friction of
# 1e-4 of the pressure ended with Newton's iteration; in the oracle an open node pressed on its neighbour by a rounding;
# tractions that stick were taken to be unique): compared in every run
CONTESTED = frozenset(
    f"epsilon = 0, {what}"
    for what in ("c_n = 1.47e+11", "c_n = 1e+14", "a body of 1e6 m", "nodal contact", "one cell of degree 2")
)
NEWTON_KRYLOV = {"solver.strategy": "newton-krylov"}
MOST_STEPS = 100  # of situations by that strategy
EXACT_FRICTION = {f"{CONTACT}.friction.regularisation": 0.0}
BESIDE_EXACT_FRICTION = ("c_n", "mu", "poisson", "viscosity", "young", "density", "T")
GRID = 4  # values of each of a pair
SEED = 20260101


@dataclass(frozen=True)
class Case:
    name: str
    group: str  # of report.GROUPS
    scene: Flat
    values: tuple[tuple[str, float], ...] = ()
    singular: bool = (
        False  # the scene has no unique solution, so that stopping with that reason is the right end
    )


def all_cases(draws: int, seed: int = SEED) -> list[Case]:
    cases = [*_alone(), *_exact_friction(), *_in_space(), *_newton_krylov(), *_pairs(), *_draws(draws, seed)]
    cases += [Case(s.name, "situation", s.scene, (), s.singular) for s in situations()]
    names = [case.name for case in cases]
    if len(set(names)) != len(names):
        raise AssertionError("two cases have one name")
    return cases


def _case(group: str, chosen: list[tuple[Parameter, float]], name: str = "") -> Case:
    scene = dict(BASE)
    for parameter, value in chosen:
        scene = changed(scene, parameter.keys(value))
    values = tuple((parameter.name, value) for parameter, value in chosen)
    text = name or ", ".join(f"{parameter} = {value:.6g}" for parameter, value in values)
    return Case(text, group, scene, values)


def _alone() -> Iterator[Case]:
    for parameter in PARAMETERS:
        for value in parameter.values:
            yield _case("alone", [(parameter, value)])


def _exact_friction() -> Iterator[Case]:
    """epsilon = 0, alone and beside the limits of what friction works against."""
    yield Case("epsilon = 0", "exact friction", {**BASE, **EXACT_FRICTION})
    for parameter in (BY_NAME[name] for name in BESIDE_EXACT_FRICTION):
        for value in parameter.values:
            case = _case("", [(parameter, value)])
            yield Case(f"epsilon = 0, {case.name}", "exact friction", {**case.scene, **EXACT_FRICTION})
    for s in situations():
        if f"{CONTACT}.friction.coefficient" in s.scene:
            scene = {**s.scene, **EXACT_FRICTION}
            yield Case(f"epsilon = 0, {s.name}", "exact friction", scene, (), s.singular)


def _limits(parameter: Parameter) -> list[float]:
    """The first value, which is zero where there is one, and the least and greatest."""
    return sorted({parameter.values[0], min(parameter.values), max(parameter.values)})


def _in_space() -> Iterator[Case]:
    """Tetrahedra and hexahedra in turn."""
    cells = itertools.cycle(("simplex", "tensor"))
    for parameter in PARAMETERS:
        for value in _limits(parameter):
            scene = changed({**IN_SPACE, "mesh.cell": next(cells)}, in_space(parameter.keys(value)))
            yield Case(f"in space, {parameter.name} = {value:.6g}", "in space", scene)
    for s in situations_in_space():
        yield Case(f"in space, {s.name}", "in space", s.scene, (), s.singular)


def _newton_krylov() -> Iterator[Case]:
    for parameter in PARAMETERS:
        for value in _limits(parameter):
            case = _case("", [(parameter, value)])
            yield Case(f"newton-krylov, {case.name}", "newton-krylov", {**case.scene, **NEWTON_KRYLOV})
    for scene, name in ((BASE, "epsilon = 0"), (IN_SPACE, "in space, epsilon = 0")):
        yield Case(f"newton-krylov, {name}", "newton-krylov", {**scene, **EXACT_FRICTION, **NEWTON_KRYLOV})
    for s in situations():
        if s.scene["time.steps"] <= MOST_STEPS and "contact" in " ".join(s.scene):
            scene = {**s.scene, **NEWTON_KRYLOV}
            yield Case(f"newton-krylov, {s.name}", "newton-krylov", scene, (), s.singular)


def _spread(parameter: Parameter) -> list[float]:
    """GRID of its values, the limits among them."""
    last = len(parameter.values) - 1
    return [parameter.values[round(i * last / (GRID - 1))] for i in range(GRID)]


def _pairs() -> Iterator[Case]:
    for first, second in PAIRS:
        a, b = BY_NAME[first], BY_NAME[second]
        for value, other in itertools.product(_spread(a), _spread(b)):
            yield _case("pair", [(a, value), (b, other)])


def _draws(count: int, seed: int) -> Iterator[Case]:
    generator = random.Random(seed)
    for number in range(count):
        # half of them draw a few parameters, the others all
        some = generator.randint(2, 5) if number % 2 == 0 else len(PARAMETERS)
        chosen = generator.sample(PARAMETERS, some)
        pairs = [(parameter, parameter.between(generator.random())) for parameter in chosen]
        yield _case("draw", pairs, f"draw {number}")
