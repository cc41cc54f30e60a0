"""Run configurations of one scene; how far apart their results are."""

import statistics
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from oracle_parts import vtu
from restart_parts.runs import Program

OUTPUTS = 8  # times at which results are compared; every number of steps is a multiple
SHARED = 8  # cells a side of the lattice whose vertices every mesh has
FIELDS = ("displacement", "velocity", "temperature")
Array = npt.NDArray[np.float64]
States = list[dict[str, Array]]  # at each output time, the fields at the shared vertices


@dataclass(frozen=True)
class Outcome:
    states: States
    seconds: float  # assembly, factorisations and steps
    summary: Mapping[str, Any]


@dataclass(frozen=True)
class Box:
    lower: tuple[float, ...]
    upper: tuple[float, ...]

    def shared(self, points: Array) -> Array:
        """Indices of the shared vertices among the points, in an order of their own."""
        lower, upper = np.array(self.lower), np.array(self.upper)
        scaled = SHARED * (points[:, : len(lower)] - lower) / (upper - lower)
        whole = np.rint(scaled)
        at = np.flatnonzero(np.all(np.abs(scaled - whole) < 1e-9, axis=1))
        order = np.lexsort(whole[at].T)
        found: Array = at[order]
        if len(found) != (SHARED + 1) ** len(lower):
            raise ValueError(f"the mesh has {len(found)} of {(SHARED + 1) ** len(lower)} shared vertices")
        return found


def run(program: Program, box: Box, folder: Path, settings: Mapping[str, Any], repeat: int) -> Outcome:
    """Median time of `repeat` runs. Raises RunFailed."""
    seconds = []
    every = max(1, settings["time.steps"] // OUTPUTS)
    keys = {key.replace(".", "__"): value for key, value in {**settings, "output.every": every}.items()}
    for _ in range(repeat):
        summary = program.run(folder, **keys)
        seconds.append(sum(summary["seconds"][part] for part in ("setup", "factor", "steps")))
    states = []
    for entry in vtu.read_collection(folder / "fields.pvd"):
        if entry.part == 0:
            grid = vtu.read_grid(folder / entry.file)
            at = box.shared(grid.points)
            states.append({name: grid.point_data[name][at] for name in FIELDS if name in grid.point_data})
    return Outcome(states, statistics.median(seconds), summary)


def distance(a: States, b: States) -> float:
    """The largest over fields and times, relative to the largest norm of the field in `b`."""
    worst = 0.0
    for name in b[0]:
        scale = max(float(np.linalg.norm(state[name])) for state in b)
        apart = max(float(np.linalg.norm(x[name] - y[name])) for x, y in zip(a, b, strict=True))
        worst = max(worst, apart / scale if scale > 0 else 0.0)
    return worst
