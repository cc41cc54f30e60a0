"""What `run --accuracy` promises against what it keeps: error and time, on several scenes and accuracies.

    python3 verification/plan_check.py [SCENE...] [--accuracy 1e-1 1e-2 1e-3] [--budget 2 30] [--printed]
                                       [--output FILE.csv] [--limit SECONDS]

The error that is achieved is measured independently of the program's own estimate: the run is made again from the
settings that it prints, with fields at the eight instants, and compared (lattice_errors.py) with a reference of degree
2 and, as far as --limit lets it, two to four times the cells and four times the steps. What the reference errs by is
bounded by what it differs by from one of half its cells and steps, for orders of at least 1, and stated. A request is
met if the error lies between a third of what was asked and what was asked, within that bound, and the time within a
factor 1.5 of the prediction; one that is refused (exit 3) must say why. A budget is kept if plan and run together take
no longer, and its promise if the error lies within a factor 3 of the predicted one.

--printed: the command that `plan` prints runs as printed, with just these settings in force, of few digits.

Exits 1 if a run fails otherwise, errs by more than it was asked to (of a budget: three times the predicted error) and
the bound of the reference leaves no doubt, or is foreseen to take more than the pilots left of its budget.
"""

import argparse
import csv
import json
import sys
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from lattice_errors import NORMS, Body, Solution, read
from plan_parts.calls import Program, Settings

ROOT = Path(__file__).resolve().parents[1]
SCENES = ("paper", "paper-isotropic", "impact", "benchmarks/rod-impact", "benchmarks/slope-slide", "box")
COMPONENTS = dict(zip(("velocity", "strain", "temperature"), NORMS))
FIELDS = {"velocity": "velocity", "strain": "displacement", "temperature": "temperature"}
INSTANTS = 8
TIME_FACTOR = 1.5


@dataclass(frozen=True)
class Row:
    scene: str
    asked: float  # accuracy, or seconds
    request: str  # "accuracy", "budget"
    outcome: str  # met, accurate (more than asked), missed, late (of a budget), refused
    predicted: float = np.nan
    achieved: float = np.nan  # measured
    bound: float = np.nan  # of the reference's own error
    estimated: float = np.nan  # by the program
    predicted_seconds: float = np.nan
    seconds: float = np.nan
    planning_seconds: float = np.nan
    remark: str = ""

    @property
    def overdrawn(self) -> bool:
        """What was foreseen after the pilots is more than the budget leaves: no fault of a busy machine."""
        return self.request == "budget" and self.planning_seconds + self.predicted_seconds > self.asked

    @property
    def in_time(self) -> bool:
        return 1 / TIME_FACTOR <= self.seconds / self.predicted_seconds <= TIME_FACTOR


def errors(run: Solution, reference: Solution, components: Sequence[str]) -> float:
    """The largest of the components' errors, relative to the largest norm of each."""
    body = Body(reference.mesh)
    apart, own = body.norms(reference, run).max(axis=0), body.norms(reference).max(axis=0)
    columns = [NORMS.index(COMPONENTS[name]) for name in components]
    return float(max(apart[at] / own[at] for at in columns if own[at] > 0))


class Case:
    """One scene and the fields of it that errors are of."""

    def __init__(self, program: Program, scene: str, limit: float) -> None:
        self.program, self.scene, self.limit = program, scene, limit
        self.names: Sequence[str] = ()

    def fields(self, settings: Settings, folder: Path) -> Solution:
        """At the instants, without the initial state: it is the same in all runs but for the mesh."""
        self.program.run(self.scene, folder, settings.at_instants(INSTANTS), self.names)
        solution = read(folder)
        return Solution(solution.mesh, solution.times[1:], solution.frames[1:])

    def reference(self, settings: Settings, seconds: float, folder: Path) -> tuple[Solution, Solution]:
        """The reference, and the run of half its cells and steps."""
        dimension = len(settings.cells)
        for ratio in (4, 2):
            if 8 * seconds * ratio ** (1.2 * dimension) <= self.limit or ratio == 2:
                fine = settings.refined(ratio, 4)
                return (
                    self.fields(fine, folder / "fine"),
                    self.fields(settings.refined(ratio // 2, 2), folder / "half"),
                )
        raise AssertionError

    def measure(self, request: str, asked: float, summary: Mapping[str, Any], folder: Path) -> Row:
        plan = summary["plan"]
        settings = Settings(plan["settings"], summary["steps"])
        taken, components = plan["achieved"]["seconds"], plan["components"]
        self.names = [FIELDS[name] for name in components]
        reference, half = self.reference(settings, taken, folder)
        achieved = errors(self.fields(settings, folder / "again"), reference, components)
        bound = errors(half, reference, components)
        predicted = plan["predicted"]["error"]
        least, most = (asked / 3, asked) if request == "accuracy" else (predicted / 3, 3 * predicted)
        inside = achieved + bound >= least and achieved - bound <= most
        outcome = "met" if inside else "missed" if achieved > most else "accurate"
        if request == "budget" and plan["pilots"]["seconds"] + taken > asked:
            outcome = "late"
        return Row(
            self.scene,
            asked,
            request,
            outcome,
            plan["predicted"]["error"],
            achieved,
            bound,
            plan["achieved"].get("error", np.nan),
            plan["predicted"]["seconds"],
            taken,
            plan["pilots"]["seconds"],
        )

    def check(self, request: str, asked: float, folder: Path) -> Row:
        done = self.program.call(
            "run", self.scene, f"--{request}", repr(asked), "--output", str(folder / "run")
        )
        if done.returncode == 3:
            return Row(self.scene, asked, request, "refused", remark=done.stderr.strip().splitlines()[-1])
        if done.returncode != 0:
            raise RuntimeError(f"{self.scene}: exit {done.returncode}: {done.stderr}")
        summary = json.loads((folder / "run" / "summary.json").read_text(encoding="utf-8"))
        return self.measure(request, asked, summary, folder)


def check_printed(program: Program, scene: str, asked: float, folder: Path) -> None:
    """Raises AssertionError, RuntimeError."""
    settings, summary = program.printed(scene, folder, "--accuracy", repr(asked))
    for setting in settings:
        key, _, text = setting.partition("=")
        value: Any = summary["scene"]
        for part in key.split("."):
            value = value[part]
        assert value == json.loads(text), f"{setting}: in force is {value!r}"
        assert all(len(word) <= 16 for word in text.strip("[]").split(",")), f"{setting}: too many digits"


def table(rows: Sequence[Row]) -> str:
    lines = [
        "| scene | asked | outcome | predicted | achieved | reference ± | own estimate | time, of predicted | planning |",
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    for row in rows:
        scene = Path(row.scene).name
        asked = f"{row.asked:.0e}" if row.request == "accuracy" else f"{row.asked:g} s"
        if row.outcome == "refused":
            lines.append(f"| `{scene}` | {asked} | refused | | | | | | |")
            continue
        lines.append(
            f"| `{scene}` | {asked} | {row.outcome} | {row.predicted:.1e} | {row.achieved:.1e} | {row.bound:.0e} "
            f"| {row.estimated:.1e} | {row.seconds:.2g} s, {row.seconds / row.predicted_seconds:.2f} "
            f"| {row.planning_seconds:.2g} s |"
        )
    return "\n".join(lines)


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("scenes", nargs="*", default=list(SCENES), metavar="SCENE")
    parser.add_argument("--accuracy", type=float, nargs="*", default=[1e-1, 1e-2, 1e-3])
    parser.add_argument("--budget", type=float, nargs="*", default=[], help="seconds")
    parser.add_argument("--printed", action="store_true")
    parser.add_argument("--output", type=Path)
    parser.add_argument("--limit", type=float, default=600.0, help="seconds that a reference may take")
    parser.add_argument("--driver", type=Path, default=ROOT / "build" / "thermocontact")
    options = parser.parse_args()
    program, rows = Program(options.driver, ROOT / "scenes"), []
    requests = [("accuracy", asked) for asked in options.accuracy]
    requests += [("budget", seconds) for seconds in options.budget]
    for scene in options.scenes:
        if options.printed:
            with tempfile.TemporaryDirectory() as name:
                check_printed(program, scene, max(options.accuracy), Path(name))
        for request, asked in requests:
            with tempfile.TemporaryDirectory() as name:
                rows.append(Case(program, scene, options.limit).check(request, asked, Path(name)))
            print(table(rows[-1:]).splitlines()[-1], rows[-1].remark, flush=True)
    print("\n" + table(rows))
    if options.output:
        with options.output.open("w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, list(asdict(rows[0])))
            writer.writeheader()
            writer.writerows(asdict(row) for row in rows)
    beyond = [row for row in rows if row.outcome == "missed" or row.overdrawn]
    late = [row for row in rows if row.outcome != "refused" and not row.in_time]
    print(
        f"\n{len(rows)} requests, {len(beyond)} missed, {len(late)} beyond a factor {TIME_FACTOR} of the time predicted"
    )
    return 1 if beyond else 0


if __name__ == "__main__":
    sys.exit(main())
