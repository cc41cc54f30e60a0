"""Runs of manufactured solutions at growing resolution, and the orders of their errors."""

import json
import math
import subprocess
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from manufactured_parts.cases import CASES
from manufactured_parts.scenes import CELLS, Cell, Resolution, scene

SCHEMES = {
    "backward-euler": 1,
    "bdf2": 2,
    "midpoint": 2,
    "generalized-alpha": 2,
}  # all choices of time.scheme, and the order that theory gives each, in every norm
IN_SPACE_SCHEME = "backward-euler"  # exact for the solutions of that study
IN_TIME_STEPS = (1, 2, 4, 8)  # times the coarsest of the case
TOLERANCE = 0.1  # of an order

L2_NORMS = ("displacement", "velocity", "temperature")
SYMBOLS = {
    "displacement": "u, L2",
    "strain": "u, energy",
    "velocity": "w, L2",
    "temperature": "theta, L2",
    "gradient": "theta, energy",
}


NUMERICS_FAILED = 3  # exit code of the program


class RunFailed(Exception):
    """The driver did not finish a manufactured solution."""


class NoSolution(RunFailed):
    """Because a system was singular or Newton did not converge."""


@dataclass(frozen=True)
class Curve:
    """One norm of the error, at growing resolution."""

    study: str
    case: str
    cell: str
    degree: int
    scheme: str
    norm: str
    sizes: Sequence[int]  # cells a side, or steps
    errors: Sequence[float]
    theory: int

    @property
    def orders(self) -> list[float]:
        """Between each resolution and the next; NaN, which fails, where an error vanishes."""
        pairs = zip(zip(self.sizes, self.errors), zip(self.sizes[1:], self.errors[1:]))
        return [
            math.log(coarse / fine) / math.log(m / n) if coarse > 0 and fine > 0 else math.nan
            for (n, coarse), (m, fine) in pairs
        ]

    @property
    def passes(self) -> bool:
        return all(abs(order - self.theory) <= TOLERANCE for order in self.orders)


def check_schemes(driver: Path) -> None:
    """Raises RunFailed if the table of orders does not name just the schemes that the schema offers."""
    done = subprocess.run(
        [str(driver), "schema", "--format", "json"], capture_output=True, text=True, check=False
    )
    if done.returncode != 0:
        raise RunFailed(f"{driver} schema: {done.stderr.strip()}")
    offered = next(entry["choices"] for entry in json.loads(done.stdout) if entry["key"] == "time.scheme")
    if different := set(offered) ^ set(SCHEMES):
        raise RunFailed(
            f"time.scheme: {', '.join(sorted(different))}: in the schema or in the table of orders, not in both"
        )


class Driver:
    """`ratio`: of meshes graded toward these sides, one of an axis alone and both of another; 1: uniform."""

    def __init__(self, program: Path, ratio: float = 1.0) -> None:
        self.program = program
        self.grading = {f"grading.{side}": ratio for side in ("left", "bottom", "top")}

    def errors(self, study: str, case: str, at: Resolution) -> Mapping[str, float]:
        """Norms of the errors at the end. Raises RunFailed."""
        at = replace(at, cell=replace(at.cell, mesh={**at.cell.mesh, **self.grading}))
        with tempfile.TemporaryDirectory(prefix="manufactured-") as folder:
            path = Path(folder) / "scene.toml"
            path.write_text(scene(study, case, at), encoding="utf-8")
            command = [str(self.program), str(path), f"in_{study}", CASES[case].body, case]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            kind = NoSolution if done.returncode == NUMERICS_FAILED else RunFailed
            where = (
                f"{study}, {case}, {at.cell.name} of degree {at.degree}, {at.cells} cells, {at.steps} steps"
            )
            raise kind(f"{where}: {done.stderr.strip().removeprefix('manufactured: ')}")
        found: Mapping[str, float] = json.loads(done.stdout)
        return found


def in_space(driver: Driver, case: str, cell: Cell, degree: int, schemes: Sequence[str]) -> list[Curve]:
    """`schemes` matter only in time."""
    sizes = cell.sizes[degree]
    errors = [
        driver.errors("space", case, Resolution(cell, degree, n, cell.steps_in_space, IN_SPACE_SCHEME))
        for n in sizes
    ]
    return [
        Curve(
            "space",
            case,
            cell.name,
            degree,
            IN_SPACE_SCHEME,
            norm,
            sizes,
            [error[norm] for error in errors],
            degree + (1 if norm in L2_NORMS else 0),
        )
        for norm in errors[0]
    ]


def in_time(driver: Driver, case: str, cell: Cell, degree: int, schemes: Sequence[str]) -> list[Curve]:
    curves = []
    sizes = [CASES[case].coarsest_steps * times for times in IN_TIME_STEPS]
    for scheme in schemes:
        errors = [
            driver.errors("time", case, Resolution(cell, degree, cell.cells_in_time, steps, scheme))
            for steps in sizes
        ]
        curves += [
            Curve(
                "time",
                case,
                cell.name,
                degree,
                scheme,
                norm,
                sizes,
                [error[norm] for error in errors],
                SCHEMES[scheme],
            )
            for norm in errors[0]
        ]
    return curves


STUDIES = {"space": in_space, "time": in_time}


def all_curves(
    driver: Driver,
    studies: Sequence[str],
    cases: Sequence[str],
    cells: Sequence[str],
    degrees: Sequence[int],
    schemes: Sequence[str],
) -> Iterator[list[Curve]]:
    """The curves of one series of runs after another."""
    for study in studies:
        for case in cases:
            for cell in cells:
                for degree in degrees:
                    if degree in CELLS[cell].sizes:
                        yield STUDIES[study](driver, case, CELLS[cell], degree, schemes)
