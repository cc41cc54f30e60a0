"""Coulomb's law itself against its regularisation: what epsilon costs in accuracy, and what doing without it costs in time.

    python3 verification/coulomb_limit.py [--scene NAME]... [--repeat R] [--driver PROGRAM] [--output TABLE.csv]

Each scene is run with friction.regularisation = 0 and with a row of epsilons. The difference of a run to that of 0 is the
largest over all output times and over displacement and velocity, of the nodal values' norm relative to the field's largest.
Where a body sticks it creeps by about epsilon, and the difference is of order 1 in epsilon; where all of it slips the
friction is short by epsilon^2 / (2 |w_t|^2), order 2; until it reaches what the solver's tolerance leaves (the plateau).
Times are medians of R runs, all epsilons in turn, of the steps alone.

Exit codes: 0 done; 1 a run failed, or the difference does not fall as it should: by an order within 0.2 of theory's from
one epsilon to the next, the last two before the plateau, and to 1e-8 in the end.
"""

import argparse
import csv
import math
import statistics
import sys
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from oracle_parts import vtu
from restart_parts.runs import Program, RunFailed

ROOT = Path(__file__).resolve().parent.parent
EPSILON = "boundary.bottom.contact.friction.regularisation"
EPSILONS = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13)
ONLY_MOTION = {"output.fields": ["displacement", "velocity"]}
SCENES: Mapping[str, Mapping[str, Any]] = {
    "paper": ONLY_MOTION,
    "benchmarks/slope-creep": ONLY_MOTION,
    "benchmarks/sliding-block": {**ONLY_MOTION, "time.steps": 60},
    "box": ONLY_MOTION,
}
ORDERS = {"box": 2.0}  # nothing sticks; elsewhere 1
PLATEAU, LIMIT = 1e-9, 1e-8
Array = npt.NDArray[np.float64]
Fields = dict[str, list[Array]]


@dataclass
class Measured:
    """What one epsilon gives."""

    epsilon: float
    seconds: list[float] = field(default_factory=list)
    iterations: int = 0
    retries: int = 0
    largest: int = 0
    divided: int = 0
    fields: Fields = field(default_factory=dict)
    difference: float = math.nan


def read_fields(folder: Path) -> Fields:
    """Nodal values at the output times."""
    fields: Fields = {"displacement": [], "velocity": []}
    for entry in vtu.read_collection(folder / "fields.pvd"):
        if entry.part == 0:
            grid = vtu.read_grid(folder / entry.file)
            for name, states in fields.items():
                states.append(grid.point_data[name])
    return fields


def difference(a: Fields, b: Fields) -> float:
    worst = 0.0
    for name, states in b.items():
        scale = max(float(np.linalg.norm(state)) for state in states)
        apart = max(float(np.linalg.norm(x - y)) for x, y in zip(a[name], states, strict=True))
        worst = max(worst, apart / scale)
    return worst


def measure(driver: Path, scene: str, repeat: int, folder: Path) -> list[Measured]:
    program = Program(driver, ROOT / "scenes" / f"{scene}.toml")
    results = [Measured(epsilon) for epsilon in (0.0, *EPSILONS)]
    settings: dict[str, Any] = {
        **SCENES[scene],
        "solver.strategy": "condensed",
        "output.checkpoint_every": 10**6,
    }
    for _ in range(repeat):
        for result in results:
            every: dict[str, Any] = {**settings, EPSILON: result.epsilon}
            keys = {key.replace(".", "__"): value for key, value in every.items()}
            try:
                summary = program.run(folder, **keys)
            except RunFailed:
                if result.epsilon == 0.0:
                    raise
                continue
            result.seconds.append(summary["seconds"]["steps"])
            result.iterations = summary["newton"]["iterations"]
            result.retries = summary["newton"]["retries"]
            result.largest = summary["newton"]["max_iterations_in_a_step"]
            result.fields = read_fields(folder)
    for result in results[1:]:
        if result.fields:
            result.difference = difference(result.fields, results[0].fields)
    return results


def orders(results: Sequence[Measured]) -> list[float]:
    """Of each epsilon to the one before; nan from the plateau on."""
    found = [math.nan]
    for coarse, fine in zip(results, results[1:]):
        falls = coarse.epsilon > 0 and fine.difference > PLATEAU
        found.append(
            math.log(coarse.difference / fine.difference) / math.log(coarse.epsilon / fine.epsilon)
            if falls
            else math.nan
        )
    return found


def judge(scene: str, results: Sequence[Measured], rates: Sequence[float]) -> list[str]:
    known = [rate for rate in rates if not math.isnan(rate)]
    expected = ORDERS.get(scene, 1.0)
    faults = [f"{scene}: order {rate:.2f} in epsilon" for rate in known[-2:] if abs(rate - expected) > 0.2]
    reached = [result.difference for result in results[1:] if not math.isnan(result.difference)]
    if not reached or min(reached) > LIMIT:
        faults.append(f"{scene}: the difference does not fall to {LIMIT:g}")
    return faults


def table(scene: str, results: Sequence[Measured], rates: Sequence[float]) -> list[dict[str, Any]]:
    exact = statistics.median(results[0].seconds)
    rows = []
    print(
        f"\n{scene}\n| epsilon, m/s | difference | order | Newton iterations (most a step) | retries | time / exact |"
    )
    print("| --- | --- | --- | --- | --- | --- |")
    for result, rate in zip(results, rates):
        if not result.seconds:
            print(f"| {result.epsilon:g} | no solution | | | | |")
            continue
        seconds = statistics.median(result.seconds)
        order = "" if math.isnan(rate) else f"{rate:.2f}"
        apart = "" if math.isnan(result.difference) else f"{result.difference:.1e}"
        print(
            f"| {result.epsilon:g} | {apart} | {order} | {result.iterations} ({result.largest}) "
            f"| {result.retries} | {seconds / exact:.2f} |"
        )
        rows.append(
            {
                "scene": scene,
                "epsilon": result.epsilon,
                "difference": result.difference,
                "order": rate,
                "iterations": result.iterations,
                "retries": result.retries,
                "seconds": seconds,
            }
        )
    sys.stdout.flush()
    return rows


def main(arguments: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--scene", action="append", choices=list(SCENES), help="all unless given")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--driver", type=Path, default=ROOT / "build" / "thermocontact")
    parser.add_argument("--output", type=Path, metavar="TABLE.csv")
    options = parser.parse_args(arguments)
    rows: list[dict[str, Any]] = []
    faults: list[str] = []
    with tempfile.TemporaryDirectory() as folder:
        for scene in options.scene or SCENES:
            try:
                results = measure(options.driver.resolve(), scene, options.repeat, Path(folder) / "run")
            except RunFailed as failure:
                faults.append(f"{scene}: {failure}")
                continue
            rates = orders(results)
            rows += table(scene, results, rates)
            faults += judge(scene, results, rates)
    if options.output:
        with options.output.open("w", newline="", encoding="ascii") as file:
            writer = csv.DictWriter(file, list(rows[0]))
            writer.writeheader()
            writer.writerows(rows)
    for fault in faults:
        print(fault, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
