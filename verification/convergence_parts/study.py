"""Which runs an error curve consists of, and how they are compared."""

import tempfile
import tomllib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from convergence_parts.errors import History, compare
from convergence_parts.runs import Problem, Resolution, Run, solve

MODES = ("both", "space", "time")
RAMP_END = 0.5  # s
RAMP = f"(t < {RAMP_END} ? sin(pi*t/{2 * RAMP_END})^2 : 1)"
CONDUCTANCE = "boundary.bottom.contact.conductance"
FOUNDATION = f"{CONDUCTANCE}.foundation_temperature"
ONSET = f"{CONDUCTANCE}.onset"
GRADUAL = 1e-3  # m, above the penetrations, so that k_c nowhere jumps
AS_STATED = "sudden loads"


@dataclass(frozen=True)
class Series:
    """The errors of one scene refined in one way, by size: against the reference, and against the doubled size."""

    scene: str
    variant: str
    mode: str
    reference: int
    against_reference: Mapping[int, History]
    against_doubled: Mapping[int, History]

    @property
    def sizes(self) -> list[int]:
        return sorted(self.against_reference)


def resolution(mode: str, n: int, reference: int, every: int = 1) -> Resolution:
    cells = reference if mode == "time" else n
    steps = reference if mode == "space" else n
    return Resolution(cells, steps, every)


def solve_all(
    problem: Problem,
    variant: str,
    modes: Sequence[str],
    sizes: Sequence[int],
    reference: int,
    progress: Callable[[str], None],
) -> list[Series]:
    """The reference is solved once; of the other runs no more than two are kept at a time."""
    every = 1 if "space" in modes else reference // max(sizes)
    with tempfile.TemporaryDirectory(prefix="convergence-") as name:
        folder = Path(name)
        progress(f"{problem.scene.stem}, {variant}: reference {reference}")
        exact = solve(problem, resolution("both", reference, reference, every), folder)
        result = []
        for mode in modes:
            progress(f"{problem.scene.stem}, {variant}: {mode} {' '.join(map(str, sizes))}")
            result.append(series(problem, variant, mode, sizes, exact, folder))
        return result


def series(
    problem: Problem, variant: str, mode: str, sizes: Sequence[int], exact: Run, folder: Path
) -> Series:
    reference = exact.resolution.cells
    against_reference, against_doubled = {}, {}
    runs = {reference: exact}
    for n in sorted(sizes, reverse=True):
        runs[n] = solve(problem, resolution(mode, n, reference), folder)
        against_reference[n] = compare(runs[n], exact)
        if 2 * n in runs:
            against_doubled[n] = against_reference[n] if 2 * n == reference else compare(runs[n], runs[2 * n])
        for size in [size for size in runs if size not in (n, reference)]:
            runs.pop(size).delete()
    runs[min(sizes)].delete()
    return Series(problem.scene.stem, variant, mode, reference, against_reference, against_doubled)


def variants(scene: Path, foundation: float) -> dict[str, dict[str, str]]:
    """The scene as it stands, and with one or both of two causes of a low order removed."""
    sudden, smooth, gradual = {FOUNDATION: str(foundation)}, ramped(scene, foundation), {ONSET: str(GRADUAL)}
    return {
        AS_STATED: sudden,
        "ramped loads": smooth,
        "sudden loads, gradual k_c": sudden | gradual,
        "ramped loads, gradual k_c": smooth | gradual,
    }


def ramped(scene: Path, foundation: float) -> dict[str, str]:
    """Settings that let every load of the scene grow smoothly from 0 in place of its sudden start."""
    data = tomllib.loads(scene.read_text(encoding="utf-8"))
    settings = {
        FOUNDATION: scaled(foundation),
        "heat.source": scaled(data["heat"]["source"]),
        "load.body_force": scaled(data["load"]["body_force"]),
    }
    for name, boundary in data["boundary"].items():
        if "traction" in boundary:
            settings[f"boundary.{name}.traction"] = scaled(boundary["traction"])
    return settings


def scaled(value: Any) -> str:
    if isinstance(value, list):
        return f"[{','.join(scaled(entry) for entry in value)}]"
    return f'"({value})*{RAMP}"'
