"""The study of one scene: its reference and how far that may be off, the error of each configuration by source."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from lattice_errors import Array, Body
from tradeoff_parts.bounds import Bound, bound
from tradeoff_parts.choice import SOURCES, Choice, present
from tradeoff_parts.plan import Configuration, Plan
from tradeoff_parts.runs import Done, Failed, Runs, Seconds

TOLD_APART = 3.0  # errors above this many bounds of the reference's own are known to a third


class NoReference(Exception):
    """The reference could not be solved."""


@dataclass(frozen=True)
class Error:
    """Each norm's largest value over the output times, over that of the reference's field: w, eps(u), theta."""

    norms: tuple[float, float, float]

    @property
    def largest(self) -> float:
        return max(self.norms)


@dataclass(frozen=True)
class Point:
    configuration: Configuration
    error: Error
    parts: Mapping[str, Error]  # by source
    seconds: Seconds
    margin: float  # the error over the bound of the reference's own

    @property
    def told(self) -> bool:
        """From the reference: known to a third."""
        return self.margin > TOLD_APART


@dataclass(frozen=True)
class Lost:
    configuration: Configuration
    reason: str


class Reference:
    """Raises NoReference where it fails."""

    def __init__(self, runs: Runs, choice: Choice) -> None:
        found = runs.of(choice)
        if isinstance(found, Failed):
            raise NoReference(found.reason)
        self.choice, self.solution = choice, found.solution
        self.body = Body(found.solution.mesh)
        size = self.body.norms(found.solution).max(axis=0)
        # a field that is not there, or that nothing moves, counts as it is
        self.scale: Array = np.where(size > 0, size, 1.0)

    def distance(self, one: Done, two: Done) -> Error:
        apart = self.body.norms(one.solution, two.solution).max(axis=0) / self.scale
        return Error((float(apart[0]), float(apart[1]), float(apart[2])))


def chain(choice: Choice, best: Choice) -> list[Choice]:
    """From a choice to the reference, one source after the other made the reference's, each in SOURCES' order."""
    links = [choice]
    for source in SOURCES:
        links.append(replace(links[-1], **{source: getattr(best, source)}))
    return links


def best_grading(runs: Runs, plan: Plan) -> tuple[float, ...] | None:
    """The one with which refinement moves the solution least, if by a twentieth less than the uniform mesh; None where the
    mesh cannot be graded."""
    tried = plan.gradings()
    if not tried:
        return None
    runs.all([choice for grading in tried for choice in plan.pilots(grading)])
    found = {grading: moved(runs, plan, grading) for grading in tried}
    best = min(found, key=lambda grading: found[grading])
    return best if found[best] < 0.95 * found[tried[0]] else tried[0]


def moved(runs: Runs, plan: Plan, grading: tuple[float, ...]) -> float:
    """By the refinement of the pilots' mesh; infinite where one of them failed."""
    coarse, fine = (runs.of(choice) for choice in plan.pilots(grading))
    if isinstance(coarse, Failed) or isinstance(fine, Failed):
        return np.inf
    body = Body(fine.solution.mesh)
    size = body.norms(fine.solution).max(axis=0)
    apart = body.norms(coarse.solution, fine.solution).max(axis=0)
    return float(max(a / s for a, s in zip(apart, size) if s > 0))


def bounds(runs: Runs, plan: Plan, best: Reference) -> tuple[list[Bound], list[str]]:
    """Of the reference's error by source, and what could not be bounded."""
    sources = present(plan.facts)
    coarser = {source: of for source, of in plan.coarser().items() if source in sources}
    runs.all([choice for _, _, choices in coarser.values() for choice in choices])
    found, missing = [], []
    whole = runs.of(best.choice)
    for source in sources:
        if source not in coarser:
            missing.append(f"{source}: not bounded, errors are those on this mesh")
            continue
        ratios, theory, choices = coarser[source]
        done = [runs.of(choice) for choice in choices]
        failed = [run for run in done if isinstance(run, Failed)]
        if failed or isinstance(whole, Failed):
            missing.append(f"{source}: not bounded: {failed[0].reason if failed else ''}")
            continue
        finished = [whole, *(run for run in done if isinstance(run, Done))]
        apart = [best.distance(b, a).largest for a, b in zip(finished, finished[1:])]
        found.append(bound(source, ratios, theory, apart))
    return found, missing


def split(runs: Runs, best: Reference, choice: Choice) -> Mapping[str, Error]:
    """The links of the chain by source; those that a run failed on are missing. Their sum is at least the error."""
    links = chain(choice, best.choice)
    found = {}
    for source, one, two in zip(SOURCES, links, links[1:]):
        if runs.key(one) == runs.key(two):
            continue
        here, there = runs.of(one), runs.of(two)
        if isinstance(here, Done) and isinstance(there, Done):
            found[source] = best.distance(here, there)
    return found


def measured(
    runs: Runs,
    best: Reference,
    own: float,
    configurations: Sequence[Configuration],
    rounds: int,
    say: Callable[[str], None],
) -> tuple[list[Point], list[Lost]]:
    """`own`: the bound of the reference's error."""
    choices = [of.choice for of in configurations]
    runs.all(choices)
    finished = [of for of in configurations if isinstance(runs.of(of.choice), Done)]
    say(f"{len(finished)} configurations, by source")
    runs.all([link for of in finished for link in chain(of.choice, best.choice)])
    say(f"{len(finished)} configurations, {rounds} rounds of time")
    times = runs.seconds(list(dict.fromkeys(of.choice for of in finished)), rounds)
    points, lost = [], []
    whole = runs.of(best.choice)
    for of in configurations:
        run, time = runs.of(of.choice), times.get(of.choice)
        if isinstance(run, Failed):
            lost.append(Lost(of, run.reason))
        elif isinstance(time, Failed):
            lost.append(Lost(of, time.reason))
        elif time and isinstance(whole, Done):
            error = best.distance(run, whole)
            margin = error.largest / own if own > 0 else np.inf
            points.append(Point(of, error, split(runs, best, of.choice), time, margin))
    return points, lost
