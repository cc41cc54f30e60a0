"""Every mutation in turn: which test notices it first."""

import csv
import textwrap
import time
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Any

from .mutation import Mutation
from .suite import Suite
from .workspace import Workspace, stamp

SURVIVED, NOT_COMPILED = "nothing", "not compiled"
WAITS = "not cpp"  # the C++ tests pass, the others were not asked yet
CPP, CPP_TARGET = "cpp", "thermocontact_tests"  # the test that comes first, and what it needs

# Tests that look at a room and are asked before the others
FIRST = {
    "theory": ("theory.",),
    "parallel": ("verification.processes", "cross.box-in-crumbs", "cross.rectangle-in-crumbs"),
    "petsc": ("verification.strategies", "cross.heat-only", "cross.box-in-crumbs"),
    "app": ("exit_codes",),
    "output": ("exit_codes", "cross.heat-only"),
}


@dataclass(frozen=True)
class Verdict:
    mutation: str
    digest: str
    room: str
    file: str
    kind: str
    noticed_by: str  # a test of ctest, or one of the three words above
    seconds: int
    how: str

    @property
    def noticed(self) -> bool:
        return self.noticed_by not in (SURVIVED, NOT_COMPILED, WAITS)


Asked = Callable[[Mutation, Workspace, Suite], tuple[str, str]]


def judge(asked: Asked, mutation: Mutation, workspace: Workspace, suite: Suite) -> Verdict:
    """Make the change, build, and ask tests until one fails."""
    start = time.monotonic()
    with workspace.mutated(mutation):
        by, how = asked(mutation, workspace, suite)
    seconds = round(time.monotonic() - start)
    file = mutation.file
    return Verdict(mutation.name, mutation.digest, mutation.room, file, mutation.kind, by, seconds, how)


def by_cpp(mutation: Mutation, workspace: Workspace, suite: Suite) -> tuple[str, str]:
    """The C++ tests need but one of the programs: most mutations go no further."""
    program = workspace.build / "tests" / CPP_TARGET
    before = stamp(program)
    if problem := workspace.make(CPP_TARGET):
        return NOT_COMPILED, problem
    if stamp(program) != before:
        outcome = suite.run(CPP)
        if not outcome.passed:
            return CPP, outcome.how
    return WAITS, ""


def by_others(mutation: Mutation, workspace: Workspace, suite: Suite) -> tuple[str, str]:
    """All other tests, those that look at the mutation's room first."""
    if problem := workspace.make():
        return NOT_COMPILED, problem
    for name in suite.order(FIRST.get(mutation.room, ())):
        if name != CPP:
            outcome = suite.run(name)
            if not outcome.passed:
                return name, outcome.how
    return SURVIVED, mutation.equivalent


def mixed(mutations: Sequence[Mutation]) -> list[Mutation]:
    """An order in which all rooms advance evenly, by chance in each: what is done at any time is a fair sample."""
    places: dict[Mutation, float] = {}
    for room in {mutation.room for mutation in mutations}:
        members = sorted((m for m in mutations if m.room == room), key=lambda m: m.digest)
        places |= {member: (place + 0.5) / len(members) for place, member in enumerate(members)}
    return sorted(mutations, key=lambda mutation: (places[mutation], mutation.digest))


def problem(verdict: Verdict, mutation: Mutation) -> str:
    """Empty, or why this verdict makes the whole run fail."""
    if verdict.noticed_by == NOT_COMPILED:
        return "does not compile; replace it by one that does"
    if verdict.noticed_by == WAITS:
        return "not noticed by the C++ tests; the others were not asked"
    if verdict.noticed_by == SURVIVED and not mutation.equivalent:
        return "no test notices it"
    if verdict.noticed and mutation.equivalent:
        return "is noticed, though it is explained as equivalent"
    return ""


COLUMNS = [field.name for field in fields(Verdict)]


def read(path: Path) -> dict[tuple[str, str], Verdict]:
    """Verdicts of an earlier run by name and digest."""
    with path.open(encoding="utf-8", newline="") as file:
        cells: Iterable[dict[str, Any]] = csv.DictReader(file)
        rows = [Verdict(seconds=int(row.pop("seconds")), **row) for row in cells]
    return {(row.mutation, row.digest): row for row in rows}


def write(path: Path, verdicts: Iterable[Verdict]) -> None:
    with path.open("w", encoding="utf-8", newline="") as file:
        table = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        table.writeheader()
        table.writerows(map(asdict, verdicts))


def line(verdict: Verdict) -> str:
    how = textwrap.shorten(verdict.how, 90)
    place = f"{verdict.room}: {verdict.mutation}"
    return f"{place:<40} {verdict.kind:<8} {verdict.noticed_by:<28} {verdict.seconds:>4} s  {how}"


def by_room(verdicts: Sequence[Verdict]) -> str:
    """A table in Markdown: how many mutations a room has, what noticed them, and how long that took."""
    rows = ["| room | mutations | noticed by | survived | s |", "| --- | --- | --- | --- | --- |"]
    for room in dict.fromkeys(verdict.room for verdict in verdicts):
        of_room = [verdict for verdict in verdicts if verdict.room == room]
        counts = Counter(verdict.noticed_by for verdict in of_room if verdict.noticed)
        told = ", ".join(f"{name} {count}" for name, count in counts.most_common())
        seconds = sum(verdict.seconds for verdict in of_room)
        rows.append(f"| `{room}` | {len(of_room)} | {told} | {len(of_room) - counts.total()} | {seconds} |")
    return "\n".join(rows)
