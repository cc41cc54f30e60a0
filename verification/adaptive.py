"""Adaptive steps against equal ones: the error that a tolerance leads to, and what both pay for the same error.

    python3 verification/adaptive.py [--case NAME]... [--scheme NAME]... [--tolerance T]... [--mesh N] [--repeat R]
                                     [--driver PROGRAM] [--output TABLE.csv]

Each case is a scene on one mesh, so that all errors are those of time alone. The error of a run is the largest, over
displacement, velocity and temperature and over all output times, of the norm of the difference of the nodal values to
the reference, relative to the field's largest norm. The reference are equal steps of bdf2; its own error, estimated by
the difference to half as many steps, stands in the table, and errors below ten times that are not reported.

Equal steps are run at 16, 32, ... of them. How many the error of an adaptive run would take is read off between two of
these on a logarithmic scale ("equal"); the ratio of work compares the time (factorisations and steps, medians of
--repeat runs, both programs in turn) with that of so many equal steps.

Exit codes: 0 done; 1 a run failed, the error does not fall with the tolerance, or sudden loads (case "paper") take no
fewer steps than equal ones of the same error.
"""

import argparse
import csv
import math
import statistics
import sys
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from oracle_parts import vtu
from restart_parts.runs import Program, RunFailed

ROOT = Path(__file__).resolve().parent.parent
OUTPUTS = 8  # times at which errors are measured: the steps that are adapted
FINEST = 16384
Array = npt.NDArray[np.float64]
Fields = list[dict[str, Array]]  # at each output time


@dataclass(frozen=True)
class Case:
    scene: str
    settings: Mapping[str, Any]
    what: str


SMOOTH = "sin(1.5708*t)^2"
CASES = {
    "smooth": Case(
        "no-contact",
        {
            "load.body_force": [0.0, f"-{SMOOTH}"],
            "heat.source": SMOOTH,
            "boundary.left.traction": [f"1.4*{SMOOTH}", f"0.4*{SMOOTH}"],
            "boundary.right.traction": [f"-0.8*{SMOOTH}", f"0.4*{SMOOTH}"],
        },
        "loads that grow smoothly, no contact",
    ),
    "impact": Case(
        "isothermal",
        {
            "boundary.top.displacement": ["free", "free"],
            "boundary.left.traction": [0.0, 0.0],
            "boundary.right.traction": [0.0, 0.0],
            "material.elasticity.young": 100.0,
            "material.viscosity.trace": 1.0,
            "material.viscosity.shear": 1.0,
            "initial.velocity": [0.1, -0.5],
            "boundary.bottom.contact.gap": 0.3,
            "boundary.bottom.contact.compliance.stiffness": 1e3,
        },
        "a soft block that is thrown onto the foundation and bounces",
    ),
    "paper": Case("paper-isotropic", {}, "the paper's scene, its loads applied at once"),
}


@dataclass(frozen=True)
class Run:
    error: float
    steps: int
    seconds: float  # factorisations and steps
    summary: Mapping[str, Any]


class Study:
    """The runs of one case."""

    def __init__(self, case: Case, arguments: argparse.Namespace, folder: Path) -> None:
        scene = ROOT / "scenes" / f"{case.scene}.toml"
        fixed: dict[str, Any] = {"mesh.cells": [arguments.mesh, arguments.mesh]}
        self.program = Program(arguments.driver.resolve(), scene, {**case.settings, **fixed})
        self.folder, self.repeat = folder, arguments.repeat
        self.equal: dict[tuple[str, int], Run] = {}
        finest, half = (self.solve("bdf2", steps)[0] for steps in (FINEST, FINEST // 2))
        self.reference = finest
        # of second order it would be a third of this; after sudden loads, of lower order, it may be all
        self.bound = self.error_of(half)

    def solve(
        self, scheme: str, steps: int, tolerance: float | None = None
    ) -> tuple[Fields, Mapping[str, Any]]:
        settings: dict[str, Any] = {"time__scheme": scheme, "time__steps": OUTPUTS if tolerance else steps}
        if tolerance:
            settings["time__tolerance"] = tolerance
        settings["output__every"] = 1 if tolerance else steps // OUTPUTS
        summary = self.program.run(self.folder, **settings)
        fields = ("displacement", "velocity", "temperature")
        files = [entry.file for entry in vtu.read_collection(self.folder / "fields.pvd") if entry.part == 0]
        grids = [vtu.read_grid(self.folder / file).point_data for file in files]
        return [{name: grid[name] for name in fields if name in grid} for grid in grids], summary

    def error_of(self, fields: Fields) -> float:
        worst = 0.0
        for name in self.reference[0]:
            scale = max(float(np.linalg.norm(state[name])) for state in self.reference)
            distances = [
                np.linalg.norm(a[name] - b[name]) for a, b in zip(fields, self.reference, strict=True)
            ]
            worst = max(worst, float(max(distances)) / scale if scale > 0 else 0.0)
        return worst

    def run(self, scheme: str, steps: int, tolerance: float | None = None) -> Run:
        seconds = []
        for _ in range(self.repeat):
            fields, summary = self.solve(scheme, steps, tolerance)
            seconds.append(summary["seconds"]["factor"] + summary["seconds"]["steps"])
        taken = summary["adaptive"]["accepted"] if tolerance else steps
        return Run(self.error_of(fields), taken, statistics.median(seconds), summary)

    def equal_steps(self, scheme: str, error: float) -> tuple[float, float]:
        """How many equal steps have that error, and their seconds: between two sizes that have more and less."""
        steps, coarser = 2 * OUTPUTS, None
        while steps <= FINEST // 4:
            key = (scheme, steps)
            run = self.equal[key] = self.equal.get(key) or self.run(scheme, steps)
            if run.error <= error and coarser:
                share = math.log(coarser.error / error) / math.log(coarser.error / run.error)
                return coarser.steps * 2**share, coarser.seconds * (run.seconds / coarser.seconds) ** share
            if run.error <= error:
                return steps, run.seconds
            steps, coarser = 2 * steps, run
        return math.nan, math.nan


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Measure adaptive steps against equal ones.")
    parser.add_argument("--case", choices=CASES, action="append", help="all if none is given")
    parser.add_argument("--scheme", choices=("backward-euler", "bdf2", "generalized-alpha"), action="append")
    parser.add_argument("--tolerance", type=float, action="append", metavar="T")
    parser.add_argument("--mesh", type=int, default=32, metavar="N")
    parser.add_argument("--repeat", type=int, default=3, metavar="R")
    parser.add_argument("--driver", type=Path, default=ROOT / "build" / "thermocontact")
    parser.add_argument("--output", type=Path, metavar="TABLE.csv")
    return parser.parse_args()


COLUMNS = (
    "case",
    "scheme",
    "tolerance",
    "error",
    "accepted",
    "rejected",
    "beyond",
    "factorisations",
    "equal",
    "work",
)


def rows_of(name: str, study: Study, schemes: Sequence[str], tolerances: Sequence[float]) -> list[list[Any]]:
    rows = []
    for scheme in schemes:
        for tolerance in tolerances:
            run = study.run(scheme, OUTPUTS, tolerance)
            if run.error < 10 * study.bound:
                continue
            steps, seconds = study.equal_steps(scheme, run.error)
            counts = run.summary["adaptive"]
            rest = [counts[key] for key in ("rejected", "beyond_tolerance", "factorisations")]
            row = [name, scheme, tolerance, run.error, run.steps, *rest, steps, run.seconds / seconds]
            print(
                f"{name:<8} {scheme:<18} {tolerance:7.0e} {run.error:9.2e} {run.steps:7d} {rest[0]:5d} {rest[1]:5d} "
                f"{rest[2]:5d} {steps:8.0f} {row[-1]:6.2f}",
                flush=True,
            )
            rows.append(row)
    return rows


def gains(rows: Sequence[Sequence[Any]]) -> bool:
    return all(row[4] < row[8] for row in rows if row[0] == "paper")


def falls(rows: Sequence[Sequence[Any]]) -> bool:
    """Whether the error falls by a half at least from the largest tolerance to the smallest, in each scheme."""
    pairs = {(row[0], row[1]) for row in rows}
    errors = [[row[3] for row in rows if (row[0], row[1]) == pair] for pair in pairs]
    return bool(rows) and all(len(of) < 2 or of[-1] < of[0] / 2 for of in errors)


def main() -> int:
    arguments = parse()
    schemes = arguments.scheme or ["backward-euler", "bdf2"]
    tolerances = sorted(arguments.tolerance or [1e-2, 1e-3, 1e-4], reverse=True)
    print(
        f"{'case':<8} {'scheme':<18} {'tol.':>7} {'error':>9} {'steps':>7} {'rej.':>5} {'bey.':>5} ", end=""
    )
    print(f"{'fact.':>5} {'equal':>8} {'work':>6}", flush=True)
    rows = []
    try:
        for name in arguments.case or CASES:
            with tempfile.TemporaryDirectory() as folder:
                study = Study(CASES[name], arguments, Path(folder) / "results")
                print(f"{name}: {CASES[name].what}; the reference errs by {study.bound:.1e}", flush=True)
                rows += rows_of(name, study, schemes, tolerances)
    except RunFailed as failure:
        print(f"FAILED: {failure}")
        return 1
    if arguments.output:
        with arguments.output.open("w", encoding="ascii", newline="") as file:
            csv.writer(file).writerows([COLUMNS, *rows])
    return 0 if falls(rows) and gains(rows) else 1


if __name__ == "__main__":
    sys.exit(main())
