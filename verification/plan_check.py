"""What `run --accuracy` promises against what it keeps: error and time, on several scenes and accuracies.

    python3 verification/plan_check.py [SCENE...] [--accuracy 1e-1 1e-2 1e-3] [--output FILE.csv] [--limit SECONDS]

The error that is achieved is measured independently of the program's own estimate: the run is made again from the
settings that it prints, with fields at the eight instants, and compared (lattice_errors.py) with a reference of degree
2 and, as far as --limit lets it, two to four times the cells and four times the steps. What the reference errs by is
bounded by what it differs by from one of half its cells and steps, for orders of at least 1, and stated. A request is
met if the error lies between a third of what was asked and what was asked, within that bound, and the time within a
factor 1.5 of the prediction; one that is refused (exit 3) must say why.

Exits 1 if a run fails otherwise, or errs by more than it was asked to and the bound of the reference leaves no doubt.
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
    asked: float
    outcome: str  # met, accurate (more than asked), missed, refused
    predicted: float = np.nan
    achieved: float = np.nan  # measured
    bound: float = np.nan  # of the reference's own error
    estimated: float = np.nan  # by the program
    predicted_seconds: float = np.nan
    seconds: float = np.nan
    planning_seconds: float = np.nan
    remark: str = ""

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

    def measure(self, asked: float, summary: Mapping[str, Any], folder: Path) -> Row:
        plan = summary["plan"]
        settings = Settings(plan["settings"], summary["steps"])
        taken, components = plan["achieved"]["seconds"], plan["components"]
        self.names = [FIELDS[name] for name in components]
        reference, half = self.reference(settings, taken, folder)
        achieved = errors(self.fields(settings, folder / "again"), reference, components)
        bound = errors(half, reference, components)
        inside = achieved + bound >= asked / 3 and achieved - bound <= asked
        outcome = "met" if inside else "missed" if achieved > asked else "accurate"
        return Row(
            self.scene,
            asked,
            outcome,
            plan["predicted"]["error"],
            achieved,
            bound,
            plan["achieved"].get("error", np.nan),
            plan["predicted"]["seconds"],
            taken,
            plan["pilots"]["seconds"],
        )

    def check(self, asked: float, folder: Path) -> Row:
        done = self.program.call(
            "run", self.scene, "--accuracy", repr(asked), "--output", str(folder / "run")
        )
        if done.returncode == 3:
            return Row(self.scene, asked, "refused", remark=done.stderr.strip().splitlines()[-1])
        if done.returncode != 0:
            raise RuntimeError(f"{self.scene}: exit {done.returncode}: {done.stderr}")
        summary = json.loads((folder / "run" / "summary.json").read_text(encoding="utf-8"))
        return self.measure(asked, summary, folder)


def table(rows: Sequence[Row]) -> str:
    lines = [
        "| scene | asked | outcome | predicted | achieved | reference ± | own estimate | time, of predicted | planning |",
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    for row in rows:
        scene = Path(row.scene).name
        if row.outcome == "refused":
            lines.append(f"| `{scene}` | {row.asked:.0e} | refused | | | | | | |")
            continue
        lines.append(
            f"| `{scene}` | {row.asked:.0e} | {row.outcome} | {row.predicted:.1e} | {row.achieved:.1e} | {row.bound:.0e} "
            f"| {row.estimated:.1e} | {row.seconds:.2g} s, {row.seconds / row.predicted_seconds:.2f} "
            f"| {row.planning_seconds:.2g} s |"
        )
    return "\n".join(lines)


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("scenes", nargs="*", default=list(SCENES), metavar="SCENE")
    parser.add_argument("--accuracy", type=float, nargs="+", default=[1e-1, 1e-2, 1e-3])
    parser.add_argument("--output", type=Path)
    parser.add_argument("--limit", type=float, default=600.0, help="seconds that a reference may take")
    parser.add_argument("--driver", type=Path, default=ROOT / "build" / "thermocontact")
    options = parser.parse_args()
    program, rows = Program(options.driver, ROOT / "scenes"), []
    for scene in options.scenes:
        for asked in options.accuracy:
            with tempfile.TemporaryDirectory() as name:
                rows.append(Case(program, scene, options.limit).check(asked, Path(name)))
            print(table(rows[-1:]).splitlines()[-1], rows[-1].remark, flush=True)
    print("\n" + table(rows))
    if options.output:
        with options.output.open("w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, list(asdict(rows[0])))
            writer.writeheader()
            writer.writerows(asdict(row) for row in rows)
    beyond = [row for row in rows if row.outcome == "missed"]
    late = [row for row in rows if row.outcome != "refused" and not row.in_time]
    print(
        f"\n{len(rows)} requests, {len(beyond)} missed, {len(late)} beyond a factor {TIME_FACTOR} of the time predicted"
    )
    return 1 if beyond else 0


if __name__ == "__main__":
    sys.exit(main())
