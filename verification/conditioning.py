"""How many digits the systems leave at the limits of the parameters, as predicted and as measured.

    python3 verification/conditioning.py [--program last_systems] [--small] [--output FILE.csv]

For each extreme parameter the last step of a small scene is solved by the driver. Its systems T x = b, and the x that the
driver finds for them, are printed by the program last_systems. In 50 digits are measured: the residual, the error of x
against the exact solution, and what rounding each entry of T and b otherwise changes that solution by (the largest of
five random ways). The larger of the two errors is what is lost. Predicted is the loss by Skeel's condition number as
the summary states it (src/solve/condition.h).

The prediction is a bound: each entry rounded by epsilon where rounding makes half of that, all with the worst of signs
where those measured are random. Of the sum of some N errors of random sign (N entries of a matrix that matter, a few
hundred here) about N^(1/2) remain, a digit or more. Asked is that what is predicted is not above what is measured by
more than Hager's method may fall short of the norm, a factor of 3, and not below it by more than two digits.

With --driver the summaries of both strategies are compared: each estimates a lower bound that is true mostly to a factor
of 3, so that they may differ by that.

Exit codes: 0 all so, 1 not.
"""

import argparse
import csv
import json
import math
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from conditioning_parts.exact import EPSILON, Loss, measure
from extremes_parts.parameters import BASE, CONTACT, IN_SPACE
from matrix_parts.scenes import Flat, write
from under_test import ROOT

HAGER = 3.0  # times what his estimate finds is the norm, at most
ESTIMATE = math.log10(HAGER)  # digits that it may promise too much
PESSIMISM = 2.0  # digits
SMALL = {**BASE, "mesh.cells": [4, 4], "time.steps": 4}
STIFFNESS, CONDUCTANCE = f"{CONTACT}.compliance.stiffness", f"{CONTACT}.conductance.coefficient"
HELD = "boundary.top.displacement"


def without(scene: Flat, *starts: str) -> Flat:
    return {key: value for key, value in scene.items() if not key.startswith(starts)}


MECHANICS = without(
    SMALL,
    "heat",
    f"{CONTACT}.conductance",
    *(f"boundary.{side}.temperature" for side in ("top", "left", "right")),
)
STATIC = without(MECHANICS, "material.density", "material.viscosity", f"{CONTACT}.friction")
ON_A_FOUNDATION = without(STATIC, "boundary") | {
    "boundary.left.displacement": [0.0, "free"],
    STIFFNESS: 1.0,
}
CASES: dict[str, Flat] = {
    "as it is": SMALL,
    "c_n = 1e-3": SMALL | {STIFFNESS: 1e-3},
    "c_n = 1e8": SMALL | {STIFFNESS: 1e8},
    "c_n = 1e12": SMALL | {STIFFNESS: 1e12},
    "E = 1e-9": SMALL | {"material.elasticity.young": 1e-9},
    "E = 1e9": SMALL | {"material.elasticity.young": 1e9},
    "nu = 0.4999, static": STATIC
    | {"material.elasticity.poisson": 0.4999, "material.elasticity.plane": "strain"},
    "nu = 0.4999999, static": STATIC
    | {"material.elasticity.poisson": 0.4999999, "material.elasticity.plane": "strain"},
    "nu = 0.499999999, static": STATIC
    | {"material.elasticity.poisson": 0.499999999, "material.elasticity.plane": "strain"}
    | {"solver.tolerance": 1e-10},  # and audits to 1e-6, as its energy is kept to 2e-8 only
    "nu = -0.99": SMALL | {"material.elasticity.poisson": -0.99},
    "viscosity 1e8": SMALL | {"material.viscosity.trace": 1e8, "material.viscosity.shear": 1e8},
    "trace viscosity 1e8": SMALL | {"material.viscosity.trace": 1e8},
    "rho = 1e-9": SMALL | {"material.density": 1e-9},
    "rho = 1e6": SMALL | {"material.density": 1e6},
    "step 1e-9": SMALL | {"time.end": 4e-9},
    "one step of 1e9 s": SMALL | {"time.end": 1e9, "time.steps": 1},
    "cells 1e4 : 1": SMALL | {"mesh.upper": [1e4, 1.0]},
    "K = 1e-12": SMALL | {"heat.conductivity": 1e-12},
    "K = 1e12": SMALL | {"heat.conductivity": 1e12},
    "K = (1, 1e12)": SMALL | {"heat.conductivity": [[1.0, 0.0], [0.0, 1e12]]},
    "K singular": SMALL | {"heat.conductivity": [[1.0, 1.0], [1.0, 1.0]]},
    "k_c = 1e8": SMALL | {CONDUCTANCE: 1e8},
    "mu = 10": SMALL | {f"{CONTACT}.friction.coefficient": 10.0},
    "c_n = 1e14": SMALL | {STIFFNESS: 1e14},
    "E = 1e14": SMALL | {"material.elasticity.young": 1e14},
    "nu = 0.49999, static": STATIC
    | {"material.elasticity.poisson": 0.49999, "material.elasticity.plane": "strain"},
    "nu = -0.99, static": STATIC | {"material.elasticity.poisson": -0.99},
    "no viscosity": without(SMALL, "material.viscosity"),
    "no inertia": without(SMALL, "material.density"),
    "no inertia, no viscosity": without(SMALL, "material.density", "material.viscosity"),
    "K = 0": without(SMALL, "heat.conductivity"),
    "M = 1e6, R = -1e6": SMALL
    | {"heat.thermal_stress": [[1e6, 1e6]] * 2, "heat.strain_heating": [[-1e6, -1e6]] * 2},
    "k_c = 0": SMALL | {CONDUCTANCE: 0.0},
    "k_c = 1e12, no cold corner": without(SMALL, "boundary.left.temperature", "boundary.right.temperature")
    | {CONDUCTANCE: 1e12},
    "onset 1e-16": SMALL | {f"{CONTACT}.conductance.onset": 1e-16},
    "onset 1": SMALL | {f"{CONTACT}.conductance.onset": 1.0},
    "theta_F = 1e8": SMALL | {f"{CONTACT}.conductance.foundation_temperature": 1e8},
    "theta_F = -1e8": SMALL | {f"{CONTACT}.conductance.foundation_temperature": -1e8},
    "L = 1e-6": SMALL | {f"{CONTACT}.conductance.limit": 1e-6},
    "mu = 0": SMALL | {f"{CONTACT}.friction.coefficient": 0.0},
    "epsilon = 1e-14": SMALL | {f"{CONTACT}.friction.regularisation": 1e-14, "time.steps": 8},
    "epsilon = 1e-12": SMALL | {f"{CONTACT}.friction.regularisation": 1e-12},
    "epsilon = 1e2": SMALL | {f"{CONTACT}.friction.regularisation": 1e2},
    "epsilon = 0": SMALL | {f"{CONTACT}.friction.regularisation": 0.0},
    "slivers, crossed": SMALL | {"mesh.upper": [1e3, 1.0], "mesh.diagonal": "crossed"},
    "in space": IN_SPACE | {"time.steps": 4},
    "in space, c_n = 1e12": IN_SPACE | {"time.steps": 4, STIFFNESS: 1e12},
    "in space, epsilon = 0": IN_SPACE | {"time.steps": 4, f"{CONTACT}.friction.regularisation": 0.0},
    "in space, K = 1e12": IN_SPACE | {"time.steps": 4, "heat.conductivity": 1e12},
    "in space, K = 1e-12": IN_SPACE | {"time.steps": 4, "heat.conductivity": 1e-12},
    "c_n = 1e12, E = 1e-9": SMALL | {STIFFNESS: 1e12, "material.elasticity.young": 1e-9},
    "c_n = 1e12, epsilon = 1e-12": SMALL | {STIFFNESS: 1e12, f"{CONTACT}.friction.regularisation": 1e-12},
    "c_n = 1e12, mu = 10": SMALL | {STIFFNESS: 1e12, f"{CONTACT}.friction.coefficient": 10.0},
    "epsilon = 1e-12, mu = 10": SMALL
    | {f"{CONTACT}.friction.regularisation": 1e-12, f"{CONTACT}.friction.coefficient": 10.0},
    "E = 1e14, c_n = 1e-3": SMALL | {"material.elasticity.young": 1e14, STIFFNESS: 1e-3},
    "E = 1e14, viscosity 1e-8": SMALL
    | {"material.elasticity.young": 1e14, "material.viscosity.trace": 1e-8, "material.viscosity.shear": 1e-8},
    "rho = 1e6, step 1e-9": SMALL | {"material.density": 1e6, "time.end": 4e-9},
    "K = 1e-12, k_c = 1e8": SMALL | {"heat.conductivity": 1e-12, CONDUCTANCE: 1e8},
    "nu = 0.49999, E = 1e14, static": STATIC
    | {
        "material.elasticity.poisson": 0.49999,
        "material.elasticity.plane": "strain",
        "material.elasticity.young": 1e14,
    },
    "nu = 0.49999, held by c_n = 1": ON_A_FOUNDATION
    | {"material.elasticity.poisson": 0.49999, "material.elasticity.plane": "strain"},
    "E = 1e4, held by c_n = 1": ON_A_FOUNDATION | {"material.elasticity.young": 1e4},
    "E = 1e6, held by c_n = 1": ON_A_FOUNDATION | {"material.elasticity.young": 1e6},
}
FEW = (
    "as it is",
    "c_n = 1e12",
    "nu = 0.4999999, static",
    "nu = 0.499999999, static",
    "E = 1e4, held by c_n = 1",
)
# Friction that outweighs the body, which makes T as far from symmetric as it gets; many digits lost; in space
BY_BOTH = ("as it is", "mu = 10", "c_n = 1e8", "c_n = 1e12", "nu = 0.4999, static", "in space")


@dataclass(frozen=True)
class Row:
    case: str
    balance: str
    condition: float
    contact_condition: float
    loss: Loss

    def predicted(self) -> float:
        return max(0.0, -math.log10(EPSILON * self.condition))

    def good(self) -> bool:
        return self.loss.digits() - PESSIMISM <= self.predicted() <= self.loss.digits() + ESTIMATE


def systems(program: Path, scene: Flat, folder: Path) -> dict[str, Any]:
    file = folder / "scene.toml"
    write(file, scene)
    done = subprocess.run([str(program), str(file)], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip())
    found: dict[str, Any] = json.loads(done.stdout)
    return found


def rows_of(case: str, program: Path, folder: Path) -> list[Row]:
    rows = []
    for balance, system in systems(program, CASES[case], folder).items():
        matrix, rhs, solution = (np.array(system[name]) for name in ("matrix", "rhs", "solution"))
        if solution.any():
            loss = measure(matrix, rhs, solution)
            rows.append(Row(case, balance, system["condition"], system["contact_condition"], loss))
    return rows


def stated(driver: Path, scene: Flat, strategy: str, folder: Path) -> dict[str, float]:
    """What the summary has, by balance."""
    file, results = folder / "scene.toml", folder / "results"
    write(file, {**scene, "solver.strategy": strategy})
    command = [str(driver), "run", str(file), "--quiet", "--output", str(results)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip())
    conditioning = json.loads((results / "summary.json").read_text(encoding="utf-8"))["conditioning"]
    return {balance: found["condition"] if found else math.nan for balance, found in conditioning.items()}


def strategies_agree(driver: Path, folder: Path) -> bool:
    good = True
    for case in BY_BOTH:
        factors, krylov = (
            stated(driver, CASES[case], strategy, folder) for strategy in ("condensed", "newton-krylov")
        )
        for balance, condition in factors.items():
            ratio = krylov[balance] / condition
            agree = 1 / HAGER <= ratio <= HAGER
            print(
                f"{case:26} {balance:9} newton-krylov finds {ratio:.3f} times that{'' if agree else ' OFF'}"
            )
            good = good and agree
    return good


HEADER = (
    "case",
    "balance",
    "condition",
    "of contact",
    "residual",
    "error",
    "rounding",
    "predicted",
    "measured",
    "",
)


def cells(row: Row) -> tuple[str, ...]:
    numbers = (
        row.condition,
        row.contact_condition,
        row.loss.residual,
        row.loss.forward_error,
        row.loss.rounding,
    )
    digits = (f"{row.predicted():.1f}", f"{row.loss.digits():.1f}")
    return (
        row.case,
        row.balance,
        *(f"{number:.1e}" for number in numbers),
        *digits,
        "" if row.good() else "OFF",
    )


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--program", type=Path, default=ROOT / "build" / "last_systems")
    parser.add_argument("--driver", type=Path, help="compare its strategies")
    parser.add_argument("--small", action="store_true", help="a few cases")
    parser.add_argument("--output", type=Path, metavar="FILE.csv")
    options = parser.parse_args()
    rows: list[Row] = []
    failed = False
    line = "{:26} {:9} {:>9} {:>10} {:>9} {:>9} {:>9} {:>9} {:>8} {}"
    print(line.format(*HEADER))
    with tempfile.TemporaryDirectory(prefix="conditioning-") as folder:
        for case in FEW if options.small else CASES:
            try:
                found = rows_of(case, options.program.resolve(), Path(folder))
            except RuntimeError as error:
                print(f"{case}: {error}")
                failed = True
                continue
            for row in found:
                print(line.format(*cells(row)), flush=True)
            rows += found
        if options.driver and not strategies_agree(options.driver.resolve(), Path(folder)):
            failed = True
    if options.output:
        with options.output.open("w", newline="", encoding="utf-8") as file:
            csv.writer(file).writerows([HEADER, *(cells(row) for row in rows)])
    return 1 if failed or not all(row.good() for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
