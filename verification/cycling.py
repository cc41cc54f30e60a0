"""Contact states that recur: every strategy stops going round, recovers by continuation, and says so in the same words.

    cycling.py [--driver PROGRAM] [--processes P]...

A block with mu = 10 pressed and thrown to the side, one of some 1200 random scenes of which strategy "newton-krylov" goes
round in circles in nine. For "condensed", and for "newton-krylov" on one and on each number of processes: the run
completes, `cycles` and `retries` of history.csv add up to what summary.json states, every step that cycled was solved
by continuation or in parts, and the audits are small. Which iterations cycle differs from strategy to strategy and from
machine to machine, as last bits decide it: how many is not compared, and where none did, the block is thrown at another
speed.

Exit codes: 0 all so, 1 not.
"""

import argparse
import csv
import json
import subprocess
import sys
import tempfile
from pathlib import Path

from under_test import ROOT, patience

SCENE = """
mesh.cells = [2, 2]
time = {end = 1, steps = 2}
load.body_force = [1, -3]
solver.max_iterations = 5000
material = {density = 1, elasticity = {young = 10, poisson = 0.45}}
[boundary.bottom.contact]
compliance = {stiffness = 1e5}
friction = {coefficient = 10, regularisation = 1e-6}
"""
AUDIT = 1e-8
SPEEDS = (-2.0, -2.01, -1.99, -2.02, -1.98)  # m/s; the first one at which iterations cycle counts
FEW = 2000  # iterations, of which iterations that cycle for ever would take 5000 each


def run(command: list[str], folder: Path) -> tuple[int, list[str]]:
    """How many iterations cycled, and what is wrong."""
    done = subprocess.run(command, capture_output=True, text=True, timeout=patience(300.0), check=False)
    if done.returncode != 0:
        return 0, [f"exit {done.returncode}: {done.stderr.strip()}"]
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    recovery, newton = summary["recovery"], summary["newton"]
    with (folder / "history.csv").open(encoding="ascii", newline="") as lines:
        rows = [{name: float(text) for name, text in row.items()} for row in csv.DictReader(lines)]
    faults = []
    for total, name in ((recovery["cycles"], "cycles"), (newton["retries"], "retries")):
        if sum(row[name] for row in rows) != total:
            faults.append(f"{name}: the steps' do not add up to {total}")
    for row in rows:
        if row["cycles"] > 0 and not (row["retries"] > 0 or row["substeps"] > 1):
            faults.append(f"step {row['step']:.0f} cycled, and how it was solved is not told")
    if newton["iterations"] > FEW:
        faults.append(f"{newton['iterations']} iterations")
    faults += [f"audit of {name}: {value}" for name, value in summary["audit"].items() if not value <= AUDIT]
    print(f"    {recovery['cycles']} cycles, {newton['retries']} retries, {newton['iterations']} iterations")
    return int(recovery["cycles"]), faults


def faults_of(command: list[str], folder: Path) -> list[str]:
    faults: list[str] = []
    for speed in SPEEDS:
        of_speed = folder / str(speed)
        cycles, found = run(
            [*command, "--output", str(of_speed), "--set", f"initial.velocity=[{speed},0.0]"], of_speed
        )
        faults += found
        if cycles > 0 or found:
            return faults
    return ["nothing cycled at any speed: the case tests nothing"]


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--driver", type=Path, default=ROOT / "build" / "thermocontact")
    parser.add_argument("--processes", type=int, action="append", metavar="P")
    options = parser.parse_args()
    runs: list[tuple[str, list[str]]] = [("condensed", []), ("newton-krylov", [])]
    runs += [("newton-krylov", ["mpirun", "-n", str(count)]) for count in options.processes or [2]]
    failed = False
    with tempfile.TemporaryDirectory(prefix="cycling-") as name:
        scene = Path(name, "scene.toml")
        scene.write_text(SCENE, encoding="ascii")
        for number, (strategy, launcher) in enumerate(runs):
            folder = Path(name, str(number))
            folder.mkdir()
            print(" ".join([strategy, *launcher]), flush=True)
            words = [str(options.driver.resolve()), "run", str(scene), "--quiet"]
            for fault in faults_of([*launcher, *words, "--set", f'solver.strategy="{strategy}"'], folder):
                failed = True
                print(f"    {fault}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
