"""Cut a run at steps, go on from its checkpoint, and compare with the run that was not cut.

    cut_and_restart.py [SCENE.toml] [--cuts STEP...] [--set KEY=VALUE]... [--driver PROGRAM]

By default the paper's scene, whose body slips with friction at every step. The run is cut and gone on with on 1, 2
and 3 processes in every combination, where 1 is strategy condensed and 1k newton-krylov on one process. With the same
strategy on one process, condensed, every field must be the same to the last bit, and the history to 1e-13: its sums
over the nodes depend on where in memory the numbers lie. Otherwise the difference must be below 1e-12 of the largest
value: the runs ask for as much as round-off allows (solver.tolerance = 1e-15, where Newton stops at round-off).
As a test of the test, a run that goes on from a state that another friction coefficient led to must be seen.
"""

import argparse
import sys
import tempfile
import tomllib
from pathlib import Path
from typing import Any

from restart_parts.runs import CHECKPOINT, Program, RunFailed
from restart_parts.same import (
    Differs,
    check_same_files,
    field_distance,
    final_fields,
    history,
    history_distance,
)

HERE = Path(__file__).resolve().parent
ROUND_OFF = 1e-13  # of the history's sums
TOLERANCE = 1e-12  # of all else
FRICTION = "boundary.bottom.contact.friction.coefficient"
WAYS: dict[str, dict[str, Any]] = {
    "1": {"processes": 1, "solver__strategy": "condensed"},
    "1k": {"processes": 1, "solver__strategy": "newton-krylov"},
    "2": {"processes": 2, "solver__strategy": "newton-krylov"},
    "3": {"processes": 3, "solver__strategy": "newton-krylov"},
}


def parse() -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("scene", nargs="?", type=Path, default=HERE.parent / "scenes" / "paper.toml")
    parser.add_argument("--cuts", nargs="+", type=int, default=[7], metavar="STEP")
    parser.add_argument("--set", action="append", default=[], dest="settings", metavar="KEY=VALUE")
    parser.add_argument("--driver", type=Path, default=HERE.parent / "build" / "thermocontact")
    return parser.parse_args()


def flat(table: dict[str, Any], prefix: str = "") -> dict[str, Any]:
    """Keys of nested tables with dots."""
    found: dict[str, Any] = {}
    for key, value in table.items():
        found |= flat(value, f"{prefix}{key}.") if isinstance(value, dict) else {prefix + key: value}
    return found


class Study:
    """The runs of one scene below one folder."""

    def __init__(self, program: Program, folder: Path) -> None:
        self.program, self.folder = program, folder
        time = flat({**tomllib.loads(program.scene.read_text(encoding="utf-8"))})
        time |= {key: value for key, value in program.settings.items() if key.startswith("time.")}
        self.end, self.steps = float(time["time.end"]), int(time["time.steps"])
        self.failures = 0

    def run(self, name: str, way: str, restart: Path | None = None, **settings: Any) -> Path:
        folder = self.folder / name
        self.program.run(folder, restart, **WAYS[way], **settings)
        return folder

    def cut(self, way: str, step: int, **settings: Any) -> Path:
        """The checkpoint of a run that ends early."""
        short: dict[str, Any] = {"time__end": self.end * step / self.steps, "time__steps": step}
        return self.run(f"cut-{way}-{step}-{len(settings)}", way, **short | settings) / CHECKPOINT

    def fields(self, folder: Path) -> Any:
        """The final fields as one process writes them, whoever computed them."""
        seen = folder.with_name(folder.name + "-seen")
        if not seen.exists():
            self.program.run(seen, folder / CHECKPOINT, **WAYS["1"])
        return final_fields(seen)

    def distance(self, whole: Path, other: Path) -> float:
        return max(history_distance(whole, other), field_distance(self.fields(whole), self.fields(other)))

    def report(self, what: str, difference: float, allowed: float) -> None:
        good = difference <= allowed
        self.failures += not good
        print(f"{what:<58} {difference:9.1e} {allowed:9.0e}{'' if good else '  FAILED'}", flush=True)

    def check(self, step: int, wholes: dict[str, Path]) -> None:
        """Cut at a step every way, and go on every way."""
        for before in WAYS:
            checkpoint = self.cut(before, step)
            for after, whole in wholes.items():
                rest = self.run(f"rest-{before}-{after}-{step}", after, checkpoint)
                same = before == after == "1"
                what = f"cut at step {step} on {before}, gone on with on {after}"
                self.report(what, self.distance(whole, rest), ROUND_OFF if same else TOLERANCE)
                if same and field_distance(self.fields(whole), self.fields(rest)) != 0:
                    raise Differs("fields are not the same to the last bit")

    def check_same_folder(self, step: int, whole: Path) -> None:
        """Go on in the folder of the run itself."""
        folder = self.cut("1", step).parent
        self.program.run(folder, folder / CHECKPOINT, **WAYS["1"])
        check_same_files(whole, folder)
        self.report(
            f"cut at step {step}, gone on with in the same folder", history_distance(whole, folder), ROUND_OFF
        )

    def check_sensitivity(self, step: int, whole: Path) -> None:
        """A thousandth more friction before the cut must be seen after it."""
        coefficient = flat(tomllib.loads(self.program.scene.read_text(encoding="utf-8")))[FRICTION]
        settings = {FRICTION.replace(".", "__"): 1.001 * coefficient}
        checkpoint = self.cut("1", step, **settings)
        longer = self.run("sensitive", "1", checkpoint, **settings)
        difference = history_distance(whole, longer)
        print(f"a thousandth more friction changes the results by {difference:.1e}")
        if difference < 1e3 * TOLERANCE:
            raise Differs("friction does not matter in this scene: it proves nothing")


def main() -> int:
    """Print a row for every combination; 1 if one is beyond its tolerance."""
    arguments = parse()
    settings = {"solver.tolerance": 1e-15, "output.every": 4}
    settings |= flat(tomllib.loads("\n".join(arguments.settings)))
    try:
        with tempfile.TemporaryDirectory() as folder:
            study = Study(Program(arguments.driver.resolve(), arguments.scene, settings), Path(folder))
            wholes = {way: study.run(f"whole-{way}", way) for way in WAYS}
            print(f"slip share up to {history(wholes['1'])['slip_fraction'].max():.2f}")
            print(f"{'':<58} {'difference':>9} {'allowed':>8}")
            for way in list(WAYS)[1:]:
                study.report(
                    f"not cut: on {way} against 1", study.distance(wholes["1"], wholes[way]), TOLERANCE
                )
            for step in arguments.cuts:
                study.check(step, wholes)
                study.check_same_folder(step, wholes["1"])
            study.check_sensitivity(arguments.cuts[0], wholes["1"])
    except (RunFailed, Differs) as failure:
        print(f"FAILED: {failure}")
        return 1
    return 1 if study.failures else 0


if __name__ == "__main__":
    sys.exit(main())
