"""Which steps are taken: equal ones, or those that the driver has adapted."""

import csv
import math
from pathlib import Path

from oracle_parts.errors import SceneError
from oracle_parts.scene import Scene

Parts = dict[int, list[tuple[float, float]]]  # of each step of the scene: ends and sizes of what is taken


def equal_steps(scene: Scene) -> Parts:
    return {step: [(step * scene.step, scene.step)] for step in range(1, scene.steps + 1)}


def followed_steps(scene: Scene, results: Path | None) -> Parts:
    """The steps that steps.csv in a folder of results says were taken; they must fill the scene's."""
    if results is None:
        raise SceneError(
            "time.tolerance: the oracle does not adapt steps; --follow names results that it is to follow"
        )
    parts: Parts = {step: [] for step in range(1, scene.steps + 1)}
    with (results / "steps.csv").open(encoding="ascii", newline="") as file:
        for row in csv.DictReader(file):
            if row["outcome"] in ("accepted", "beyond-tolerance"):
                parts[int(row["step"])].append((float(row["time"]), float(row["size"])))
    time = 0.0
    for step, taken in parts.items():
        for end, size in taken:
            if not math.isclose(time + size, end, rel_tol=1e-12):
                raise SceneError(
                    f"{results}/steps.csv: a step of {size:g} from {time:g} does not end at {end:g}"
                )
            time = end
        if not math.isclose(time, step * scene.step, rel_tol=1e-12):
            raise SceneError(
                f"{results}/steps.csv: the steps do not fill step {step}, up to {step * scene.step:g}"
            )
    return parts
