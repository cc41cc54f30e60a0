"""Runs of a benchmark scene by the driver, and what they left in their folders."""

import csv
import json
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from oracle_parts import vtu

Array = npt.NDArray[np.float64]
SCENES = Path(__file__).resolve().parents[2] / "scenes" / "benchmarks"


@dataclass(frozen=True)
class Run:
    """One results folder; scene is the resolved one, so that expected values follow the scene file."""

    directory: Path
    scene: dict[str, Any]
    final: dict[str, Any]
    history: dict[str, Array]

    def contact(self) -> vtu.Grid:
        return self._last(1)

    def body(self) -> vtu.Grid:
        return self._last(0)

    def _last(self, part: int) -> vtu.Grid:
        files = [
            entry.file for entry in vtu.read_collection(self.directory / "fields.pvd") if entry.part == part
        ]
        return vtu.read_grid(self.directory / files[-1])


class Driver:
    """The program under test, writing below one folder."""

    def __init__(self, program: Path, folder: Path) -> None:
        self.program, self.folder, self.runs = program, folder, 0

    def run(self, scene: str, **settings: Any) -> Run:
        """Settings are scene keys with `__` for the dot. Raises RuntimeError where the driver fails."""
        self.runs += 1
        directory = self.folder / f"{scene}-{self.runs}"
        command = [
            str(self.program),
            "run",
            str(SCENES / f"{scene}.toml"),
            "--quiet",
            "--output",
            str(directory),
        ]
        for key, value in settings.items():
            command += ["--set", f"{key.replace('__', '.')}={json.dumps(value)}"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(command)}: exit {done.returncode}: {done.stderr.strip()}")
        summary = json.loads((directory / "summary.json").read_text(encoding="utf-8"))
        return Run(directory, summary["scene"], summary["final"], _columns(directory / "history.csv"))


def _columns(path: Path) -> dict[str, Array]:
    with path.open(encoding="ascii", newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def width(scene: dict[str, Any]) -> float:
    """Length of the bottom side, m."""
    return float(scene["mesh"]["upper"][0] - scene["mesh"]["lower"][0])


def height(scene: dict[str, Any]) -> float:
    """Length of the left side, m."""
    return float(scene["mesh"]["upper"][1] - scene["mesh"]["lower"][1])
