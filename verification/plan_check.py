"""What `run --accuracy` promises against what it keeps: error and time, on several scenes and accuracies.

    python3 verification/plan_check.py [SCENE...] [--accuracy 1e-1 1e-2 1e-3] [--budget 2 30] [--printed]
                                       [--set KEY=VALUE]... [--longest S] [--output FILE.csv] [--limit SECONDS]

The error that is achieved is measured independently of the program's own estimate: the run is made again from the
settings that it prints, with fields at the eight instants, and compared (lattice_errors.py) with a reference, of degree
2 and by a scheme of second order: that of the scene in plan_parts/references.py, or of a scene not listed there one of
two to four times the run's cells, as far as --limit lets it, and four times its steps. What the reference errs by is
bounded from it made coarser twice in space and in time (tradeoff_parts/bounds.py), and stated. A request is met if the
error lies between a third of what was asked and what was asked, within that bound, and surely if it does whatever the
reference errs by; and if the time lies within a factor 1.5 of the prediction. One that is refused (exit 3) must say why. A
budget is kept if plan and run together take no longer, and its promise if the error lies within a factor 3 of the
predicted one.

--set KEY=VALUE changes the scenes. --longest S: what is foreseen to take more than S seconds is told, and not run.

--printed: the command that `plan` prints runs as printed, with just these settings in force, of few digits.

Exits 1 if a run fails otherwise, errs by more than it was asked to (of a budget: three times the predicted error) and
the bound of the reference leaves no doubt, or is foreseen to take more than the pilots left of its budget.
"""

import argparse
import csv
import json
import re
import sys
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from plan_parts.calls import Program, Settings
from plan_parts.references import REFERENCES, Judged, Reference, finer_than

ROOT = Path(__file__).resolve().parents[1]
SCENES = ("paper", "paper-isotropic", "impact", "benchmarks/rod-impact", "benchmarks/slope-slide", "box")
TIME_FACTOR = 1.5
CHOSEN = re.compile(r"^chosen +error (\S+) in (\S+) (s|min|h):", re.MULTILINE)
SECONDS_OF = {"s": 1.0, "min": 60.0, "h": 3600.0}


@dataclass(frozen=True)
class Row:
    scene: str
    asked: float  # accuracy, or seconds
    request: str  # "accuracy", "budget"
    outcome: str  # met (surely), accurate (more than asked), missed, late (of a budget), refused, not run
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


def outcome_of(judged: Judged, least: float, most: float) -> str:
    """Of an error that is to lie between these."""
    if judged.least >= least and judged.most <= most:
        return "surely met"
    if judged.most >= least and judged.least <= most:
        return "met"
    return "missed" if judged.error > most else "accurate"


class Case:
    """One scene. `limit`: seconds that a reference which is not in the table may take."""

    def __init__(self, program: Program, scene: str, limit: float, longest: float) -> None:
        self.program, self.scene, self.limit, self.longest = program, scene, limit, longest
        self.kept: Reference | None = None

    def reference(self, settings: Settings, seconds: float, components: Sequence[str]) -> Reference:
        if self.kept:
            return self.kept
        if fine := None if self.program.changed else REFERENCES.get(self.scene):
            self.kept = Reference(self.program, self.scene, fine, components)
            return self.kept
        expected = 8 * seconds * 4 ** (1.2 * len(settings.cells))
        ratio = 4 if expected <= self.limit else 2
        return Reference(self.program, self.scene, finer_than(settings, ratio), components)

    def measure(self, request: str, asked: float, summary: Mapping[str, Any]) -> Row:
        plan = summary["plan"]
        settings = Settings(plan["settings"], summary["steps"])
        taken, predicted = plan["achieved"]["seconds"], plan["predicted"]["error"]
        reference = self.reference(settings, taken, plan["components"])
        judged = reference.judge(reference.fields(settings))
        least, most = (asked / 3, asked) if request == "accuracy" else (predicted / 3, 3 * predicted)
        outcome = outcome_of(judged, least, most)
        if request == "budget" and plan["pilots"]["seconds"] + taken > asked:
            outcome = "late"
        return Row(
            self.scene,
            asked,
            request,
            outcome,
            predicted,
            judged.error,
            judged.bound,
            plan["achieved"].get("error", np.nan),
            plan["predicted"]["seconds"],
            taken,
            plan["pilots"]["seconds"],
            " ".join(plan["settings"]),
        )

    def check(self, request: str, asked: float, folder: Path) -> Row:
        words = (f"--{request}", repr(asked))
        if self.longest < np.inf and request == "accuracy":
            told = self.program.call("plan", self.scene, *words)
            foreseen = foreseen_by(told.stdout)
            if foreseen and foreseen[1] > self.longest:
                return Row(self.scene, asked, request, "not run", foreseen[0], predicted_seconds=foreseen[1])
        done = self.program.call("run", self.scene, *words, "--output", str(folder / "run"))
        if done.returncode == 3:
            return Row(self.scene, asked, request, "refused", remark=done.stderr.strip().splitlines()[-1])
        if done.returncode != 0:
            raise RuntimeError(f"{self.scene}: exit {done.returncode}: {done.stderr}")
        return self.measure(
            request, asked, json.loads((folder / "run" / "summary.json").read_text(encoding="utf-8"))
        )


def foreseen_by(told: str) -> tuple[float, float] | None:
    """Error and seconds of what a plan chooses; nothing where it refuses."""
    found = CHOSEN.search(told)
    return (float(found[1]), float(found[2]) * SECONDS_OF[found[3]]) if found else None


def check_printed(program: Program, scene: str, asked: float, folder: Path) -> None:
    """Raises AssertionError, RuntimeError."""
    settings, summary = program.printed(scene, folder, "--accuracy", repr(asked))
    for setting in settings:
        key, _, text = setting.partition("=")
        value: Any = summary["scene"]
        for part in key.split("."):
            value = value[part]
        assert value == json.loads(text), f"{setting}: in force is {value!r}"
        digits = [] if text.startswith('"') else text.strip("[]").split(",")
        assert all(len(number) <= 16 for number in digits), f"{setting}: too many digits"


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
        if row.outcome == "not run":
            time = f"{row.predicted_seconds:.2g} s foreseen"
            lines.append(f"| `{scene}` | {asked} | not run | {row.predicted:.1e} | | | | {time} | |")
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
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE")
    parser.add_argument("--longest", type=float, default=np.inf, metavar="S")
    parser.add_argument("--limit", type=float, default=600.0, help="seconds that a reference may take")
    parser.add_argument("--driver", type=Path, default=ROOT / "build" / "thermocontact")
    options = parser.parse_args()
    program, rows = Program(options.driver, ROOT / "scenes", tuple(options.set)), []
    requests = [("accuracy", asked) for asked in options.accuracy]
    requests += [("budget", seconds) for seconds in options.budget]
    for scene in options.scenes:
        if options.printed:
            with tempfile.TemporaryDirectory() as name:
                check_printed(program, scene, max(options.accuracy), Path(name))
        case = Case(program, scene, options.limit, options.longest)
        for request, asked in requests:
            with tempfile.TemporaryDirectory() as name:
                rows.append(case.check(request, asked, Path(name)))
            print(table(rows[-1:]).splitlines()[-1], rows[-1].remark, flush=True)
    print("\n" + table(rows))
    if options.output:
        with options.output.open("w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, list(asdict(rows[0])))
            writer.writeheader()
            writer.writerows(asdict(row) for row in rows)
    beyond = [row for row in rows if row.outcome == "missed" or row.overdrawn]
    late = [row for row in rows if row.outcome not in ("refused", "not run") and not row.in_time]
    print(
        f"\n{len(rows)} requests, {len(beyond)} missed, {len(late)} beyond a factor {TIME_FACTOR} of the time predicted"
    )
    return 1 if beyond else 0


if __name__ == "__main__":
    sys.exit(main())
