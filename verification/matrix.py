"""An oracle for every switch: each key of the schema is varied, and driver and oracle must agree every time.

    python3 verification/matrix.py [--driver PROGRAM] [--workers N] [--table FILE.md] [GROUP...]

What must be tried comes from `thermocontact schema`: every key, every choice, every form of a value, both states of
what may be absent, every side; of plane bodies, and of bodies in space all that means something else there or meets
other code. A key without a case is a failure, and so is a case whose key is gone. Besides there are all pairs of
physics switches (in the plane), scenes in which several things meet, and scenes that must be refused. Some GROUPs
(keys, or base, pairs, together) alone are run without asking what is missing.

Three things are asked of each case:

- driver against oracle, as compare.py measures it: at most 1e-9 in every field at every step, and every tenth case
  once more with the oracle on two processes. The bound: a step is solved to a relative residual of 1e-12, and the
  error of its unknowns is at most the condition number of the Jacobian, scaled to a unit diagonal, times that. On
  these meshes (h >= 1/7, steps of 0.06 and more) it is 3 to 120, in space 2 to 80, the largest for degree 2 and for
  quasi-static scenes; there are up to five steps: 6e-10. As Newton's last step overshoots the tolerance, less is seen.
- driver against the driver's result for the base scene: more than 1e-6 of some field. A case below that cannot fail,
  since a program that ignores the key would pass it too.
- where the key cannot matter, the table says why, and then the two results must agree to 1e-9.

Exit codes: 0 all of it holds, 1 something does not.
"""

import argparse
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import compare
from matrix_parts import coverage, runs
from matrix_parts.cases import Case, base_cases
from matrix_parts.change import change
from matrix_parts.pairs import pair_cases
from matrix_parts.refusals import refusals
from matrix_parts.scenes import write
from matrix_parts.together import together_cases
from matrix_parts.variations import ALIKE as ALIKE_IN_PLANE
from matrix_parts.variations import VARIATIONS
from matrix_parts.variations_in_space import ALIKE, IN_SPACE

TOLERANCE = 1e-9
MATTERS = 1e-6
TENTH, RANKS = 10, 2
TABLES = (coverage.Table("rectangle", VARIATIONS, ALIKE_IN_PLANE), coverage.Table("box", IN_SPACE, ALIKE))


@dataclass(frozen=True)
class Verdict:
    case: Case
    difference: float | None = None  # driver against oracle
    where: str = ""
    changed: float | None = None  # driver against the driver's base scene
    failure: str = ""


def every_case() -> list[Case]:
    varied = [
        variation.case(key)
        for table in TABLES
        for key, variations in table.variations.items()
        for variation in variations
    ]
    return [*base_cases(), *varied, *pair_cases(), *together_cases()]


class Matrix:
    """All cases in one folder: NUMBER.toml, and NUMBER/driver, oracle and ranks for their results."""

    def __init__(self, driver: runs.Driver, cases: Sequence[Case], folder: Path) -> None:
        self.driver, self.cases, self.folder = driver, cases, folder
        self.base = {case.label: number for number, case in enumerate(cases) if case.group == "base"}
        self.problems: list[str] = []

    def scene(self, number: int) -> Path:
        return self.folder / f"{number}.toml"

    def results(self, number: int, program: str) -> Path:
        return self.folder / str(number) / program

    def solve(self, workers: int) -> None:
        """Fill the folder. The oracle is not asked about what the driver could not do."""
        for number, case in enumerate(self.cases):
            (self.folder / str(number)).mkdir()
            write(self.scene(number), case.scene)
            self.problems.append(self.driver.run(self.scene(number), self.results(number, "driver")))
        able = [number for number, problem in enumerate(self.problems) if not problem]
        # the oracle follows meshes that adapt on one process
        still = [number for number in able if "mesh.refinement.tolerance" not in self.cases[number].scene]
        self.ranked = still[::TENTH]
        jobs = [(self.scene(number), self.results(number, "oracle")) for number in able]
        runs.oracle(jobs, self.folder, workers)
        jobs = [(self.scene(number), self.results(number, "ranks")) for number in self.ranked]
        runs.oracle_on_ranks(jobs, self.folder, RANKS)

    def judge(self, number: int) -> Verdict:
        case = self.cases[number]
        if self.problems[number]:
            return Verdict(case, failure=self.problems[number])
        try:
            difference, where = self._against_oracle(number)
            changed, place = self._against_base(case, number)
        except compare.Unusable as problem:
            return Verdict(case, failure=str(problem))
        failure = ""
        if not difference <= TOLERANCE:
            failure = f"driver and oracle differ by {difference:.1e} in {where}"
        elif changed is not None and case.same and not changed <= TOLERANCE:
            failure = f"differs from {case.base} by {changed:.1e} in {place}, though it is {case.same}"
        elif changed is not None and not case.same and not changed > MATTERS:
            failure = f"differs from {case.base} by {changed:.1e} only: this case cannot fail"
        return Verdict(case, difference, where, changed, failure)

    def _against_oracle(self, number: int) -> tuple[float, str]:
        found = []
        for program in ("oracle", "ranks") if number in self.ranked else ("oracle",):
            directory = self.results(number, program)
            problem = runs.oracle_failure(directory)
            if problem:
                raise compare.Unusable(problem)
            for worst in compare.compare(self.results(number, "driver"), directory, TOLERANCE):
                found.append((worst.relative, worst.name))
        return max(found)

    def _against_base(self, case: Case, number: int) -> tuple[float | None, str]:
        if case.base is None:
            return None, ""
        return change(self.results(self.base[case.base], "driver"), self.results(number, "driver"))


def refused(driver: runs.Driver, schema: Sequence[coverage.Entry], folder: Path) -> tuple[int, list[str]]:
    """How many scenes that break a rule of the schema were tried, and which were not refused as they should."""
    failures = []
    wrong = refusals(schema)
    for refusal in wrong:
        write(folder / "refused.toml", refusal.scene)
        code, message = driver.check(folder / "refused.toml")
        if code != runs.REFUSED or refusal.key.split(".")[-1] not in message:
            failures.append(f"{refusal.key}, {refusal.why}: exit {code}, {message or 'no message'}")
    return len(wrong), failures


HEADER = ("key or family", "variation", "against the base", "driver against oracle", "largest in")


def cells(verdict: Verdict) -> tuple[str, ...]:
    changed = "" if verdict.changed is None else f"{verdict.changed:.1e}"
    if verdict.case.same:
        changed += f" ({verdict.case.same})"
    difference = "failed" if verdict.difference is None else f"{verdict.difference:.1e}"
    base = f" [{verdict.case.base}]" if verdict.case.base else ""
    return verdict.case.group, verdict.case.label + base, changed, difference, verdict.where


def print_table(verdicts: Sequence[Verdict]) -> None:
    for group, label, changed, difference, where in [HEADER, *map(cells, verdicts)]:
        print(f"{group:<52} {difference:>9}  {where:<30} {changed:<20} {label}")


def markdown(verdicts: Sequence[Verdict]) -> str:
    rows = [HEADER, ("---",) * len(HEADER), *map(cells, verdicts)]
    return "".join("| " + " | ".join(text.replace("|", "\\|") for text in row) + " |\n" for row in rows)


def parse(arguments: Sequence[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("groups", nargs="*", metavar="GROUP")
    parser.add_argument("--driver", type=Path, default=runs.HERE.parent / "build" / "thermocontact")
    parser.add_argument("--workers", type=int, default=2, metavar="N", help="oracles at a time")
    parser.add_argument("--table", type=Path, metavar="FILE.md", help="also write the table there")
    return parser.parse_args(arguments)


def main(arguments: Sequence[str]) -> int:
    options = parse(arguments)
    driver = runs.Driver(options.driver.resolve())
    schema = coverage.read(driver.schema())
    cases = every_case()
    failures = [] if options.groups else coverage.gaps(schema, TABLES, cases)
    if options.groups:
        cases = [case for case in cases if case.group in ("base", *options.groups)]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        tried, unrefused = refused(driver, schema, folder)
        matrix = Matrix(driver, cases, folder)
        matrix.solve(options.workers)
        verdicts = [matrix.judge(number) for number in range(len(cases))]
    print_table(verdicts)
    if options.table:
        options.table.write_text(markdown(verdicts), encoding="utf-8")
    failures += unrefused
    failures += [f"{v.case.group}: {v.case.label}: {v.failure}" for v in verdicts if v.failure]
    for failure in failures:
        print(f"FAILED {failure}")
    largest = max((v.difference for v in verdicts if v.difference is not None), default=0.0)
    print(
        f"{len(verdicts)} cases, {len(matrix.ranked)} of them also with the oracle on {RANKS} processes, "
        f"{tried} refusals; largest difference {largest:.1e}; {len(failures)} failures"
    )
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
