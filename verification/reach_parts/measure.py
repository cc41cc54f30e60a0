"""Errors against the reference, the bound of its own, times; and which configuration reaches the paper's error."""

import statistics
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from lattice_errors import NORMS, Array, Body, Solution, read
from reach_parts.configurations import Configuration, Plan
from tradeoff_parts.bounds import Bound, bound
from tradeoff_parts.runs import PARTS, Failed, run

LIMIT = 900.0  # s, of one run
THETA_F = "boundary.bottom.contact.conductance.foundation_temperature"
FIELDS = ["displacement", "velocity", "temperature"]
HALVED, LOOSER = 2.0, 10.0  # ratios of the runs that bound the reference
IN_SPACE, IN_TIME = (
    1.0,
    2.0 / 3.0,
)  # theory: no smoother than that at corners; error against tolerance in second order


class RunFailed(Exception):
    """A run of the driver did not end as it should."""


@dataclass(frozen=True)
class Driver:
    program: Path
    scene: Path

    def solve(self, settings: Mapping[str, Any], folder: Path, fields: Sequence[str]) -> Mapping[str, Any]:
        """The summary. Raises RunFailed."""
        every = {THETA_F: 10.0, **settings, "output.fields": list(fields)}
        summary = run(self.program, self.scene, folder, every, LIMIT)
        if isinstance(summary, Failed):
            raise RunFailed(f"{settings}: {summary.reason}")
        return summary

    def solution(self, of: Configuration, outputs: int) -> Solution:
        with TemporaryDirectory() as name:
            self.solve(of.all_settings(outputs), Path(name), FIELDS)
            return read(Path(name))


def at_times_of(whole: Solution, part: Solution) -> Solution:
    """The frames of `whole` at the times of `part`. Raises ValueError where one is missing."""
    places = [int(np.argmin(np.abs(np.array(whole.times) - time))) for time in part.times]
    if not np.allclose([whole.times[place] for place in places], part.times, rtol=0, atol=1e-9):
        raise ValueError("an output time that the reference does not have")
    return Solution(whole.mesh, part.times, [whole.frames[place] for place in places])


def thinned(solution: Solution, outputs: int) -> Solution:
    """At the common times alone: `outputs` of them and the start."""
    by = (len(solution.times) - 1) // outputs
    return Solution(solution.mesh, solution.times[::by], solution.frames[::by])


@dataclass(frozen=True)
class Seconds:
    """Medians over the rounds: what counts, the stepping alone, and the whole process."""

    counted: float
    steps: float
    process: float


@dataclass(frozen=True)
class Point:
    of: Configuration
    errors: Array  # [time, norm] at the common times, the start among them
    seconds: Seconds

    @property
    def norms(self) -> Array:
        """Each norm's largest over the times."""
        largest: Array = self.errors.max(axis=0)
        return largest

    @property
    def e_hk(self) -> float:
        return float(self.errors.sum(axis=1).max())


@dataclass(frozen=True)
class AtEnd:
    """Of an interactive setting, at T: error and difference of the norms, over the reference's norm."""

    of: Configuration
    errors: Array
    norms: Array
    seconds: Seconds


@dataclass(frozen=True)
class Errors:
    own_times: Mapping[
        int, float
    ]  # E_hk of the paper's scheme over all times that it has in common with the reference
    by_point: Sequence[Array]  # [time, norm] of the paper's and of the others
    at_end: Sequence[tuple[Array, Array]]  # of the interactive ones
    sizes: Array  # of the reference: each norm's largest
    bounds: Mapping[str, Sequence[Bound]]  # by norm
    resolved: Array  # the bound of the reference's error, by norm


@dataclass(frozen=True)
class Study:
    plan: Plan
    found: Errors
    paper: Mapping[int, Point]
    others: Sequence[Point]
    interactive: Sequence[AtEnd]


def reaches(point: Point, paper: Point, margin: Array) -> bool:
    """All three norms are at most the paper's, `margin` being what either may be off."""
    return bool(np.all(point.norms + margin <= paper.norms - margin))


def best(study: Study, n: int, sure: bool = False) -> Point | None:
    """The fastest that reaches the error of the paper's scheme at 1/n; `sure`: whatever the reference's does to both."""
    margin = study.found.resolved if sure else np.zeros(len(NORMS))
    able = [point for point in study.others if reaches(point, study.paper[n], margin)]
    return min(able, key=lambda point: point.seconds.counted) if able else None


def bounds_of(body: Body, links: Sequence[Solution], source: str, ratio: float, theory: float) -> list[Bound]:
    """By norm, of the first of three runs, each coarser by the ratio than the one before."""
    apart = [body.norms(two, one).max(axis=0) for one, two in zip(links, links[1:])]
    return [
        bound(source, (ratio, ratio**2), theory, (float(a), float(b))) for a, b in zip(apart[0], apart[1])
    ]


def seconds(driver: Driver, choices: Sequence[Configuration], outputs: int, rounds: int) -> list[Seconds]:
    """All choices in turn, round after round."""
    rows: list[list[tuple[float, float, float]]] = [[] for _ in choices]
    for _ in range(rounds):
        for row, of in zip(rows, choices):
            with TemporaryDirectory() as name:
                taken = driver.solve(of.all_settings(outputs), Path(name), [])["seconds"]
            row.append((sum(taken[part] for part in PARTS), taken["steps"], taken["total"]))
    return [Seconds(*(statistics.median(column) for column in zip(*row))) for row in rows]


def measured(driver: Driver, plan: Plan, say: Callable[[str], None]) -> Errors:
    say("the reference, and coarser ones in space alone and in time alone")
    whole = driver.solution(plan.reference, 2 * plan.outputs)
    body = Body(whole.mesh)
    common = thinned(whole, plan.outputs)
    space, time = (
        [thinned(driver.solution(of, 2 * plan.outputs), plan.outputs) for of in coarser]
        for coarser in (plan.coarser_in_space, plan.coarser_in_time)
    )
    by_source = [
        bounds_of(body, [common, *space], "space", HALVED, IN_SPACE),
        bounds_of(body, [space[0], *time], "time", LOOSER, IN_TIME),
    ]
    resolved = np.array([sum(found.value for found in pair) for pair in zip(*by_source)])
    say(
        f"its error is at most {', '.join(f'{value:.1e}' for value in resolved)} in the norms {', '.join(NORMS)}"
    )
    own_times, errors = {}, []
    for number, of in plan.paper.items():
        solution = driver.solution(of, 2 * plan.outputs)
        own_times[number] = float(body.norms(solution, at_times_of(whole, solution)).sum(axis=1).max())
        errors.append(body.norms(thinned(solution, plan.outputs), common))
        body.kept.clear()  # the operators of a mesh that does not come again
    for of in plan.others:
        solution = driver.solution(of, plan.outputs)
        errors.append(body.norms(solution, at_times_of(whole, solution)))
        body.kept.clear()
        say(f"{of.name}: {', '.join(f'{value:.2e}' for value in errors[-1].max(axis=0))}")
    ends = [at_end(driver, body, whole, of) for of in plan.interactive]
    bounds = {name: [of_source[at] for of_source in by_source] for at, name in enumerate(NORMS)}
    return Errors(own_times, errors, ends, body.norms(common).max(axis=0), bounds, resolved)


def timed(driver: Driver, plan: Plan, found: Errors, rounds: int) -> Study:
    taken = seconds(driver, [*plan.paper.values(), *plan.others], plan.outputs, rounds)
    choices = [*plan.paper.values(), *plan.others]
    points = [Point(of, error, time) for of, error, time in zip(choices, found.by_point, taken)]
    quick = seconds(driver, plan.interactive, 1, rounds)
    return Study(
        plan,
        found,
        dict(zip(plan.paper, points)),
        points[len(plan.paper) :],
        [AtEnd(of, *end, time) for of, end, time in zip(plan.interactive, found.at_end, quick)],
    )


def at_end(driver: Driver, body: Body, whole: Solution, of: Configuration) -> tuple[Array, Array]:
    solution = driver.solution(of, 1)
    last = Solution(solution.mesh, solution.times[-1:], solution.frames[-1:])
    exact = Solution(whole.mesh, whole.times[-1:], whole.frames[-1:])
    size = body.norms(exact)[0]
    own = Body(last.mesh).norms(last)[0]
    error = body.norms(last, exact)[0]
    body.kept.clear()
    return error / size, np.abs(own - size) / size
