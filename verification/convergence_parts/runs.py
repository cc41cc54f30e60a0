"""One run of the driver on a lattice; its fields are kept in one file on disk, its VTU files are deleted."""

import os
import shutil
import subprocess
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

import numpy as np

from benchmarking.process import ENVIRONMENT, RunFailed
from convergence_parts.lattice import Array
from oracle_parts import vtu

COMPONENTS = 5  # velocity x, y; displacement x, y; temperature


@dataclass(frozen=True)
class Problem:
    """What is solved, at whatever resolution: the driver, a scene and keys changed in it."""

    driver: Path
    scene: Path
    settings: Mapping[str, str]


@dataclass(frozen=True)
class Resolution:
    cells: int
    steps: int
    every: int = 1  # of the steps, the one that is kept

    @property
    def shape(self) -> tuple[int, int, int, int]:
        return self.frames, COMPONENTS, self.cells + 1, self.cells + 1

    @property
    def frames(self) -> int:
        return self.steps // self.every + 1

    def time(self, frame: int) -> Fraction:
        """As a share of the end time."""
        return Fraction(frame * self.every, self.steps)


@dataclass(frozen=True)
class Run:
    resolution: Resolution
    file: Path

    def open(self) -> Array:
        """[frame, component, vertex along y, vertex along x], read from disk where it is used."""
        return np.memmap(self.file, dtype=np.float64, mode="r", shape=self.resolution.shape)

    def delete(self) -> None:
        self.file.unlink()


def solve(problem: Problem, resolution: Resolution, folder: Path) -> Run:
    results = Path(tempfile.mkdtemp(dir=folder))
    try:
        execute(problem, resolution, results)
        return Run(resolution, gather(results, resolution, results.with_suffix(".fields")))
    finally:
        shutil.rmtree(results)


def execute(problem: Problem, resolution: Resolution, results: Path) -> None:
    settings = {
        **problem.settings,
        "mesh.cells": f"[{resolution.cells},{resolution.cells}]",
        "time.steps": str(resolution.steps),
        "output.every": str(resolution.every),
        "output.fields": '["displacement","velocity","temperature"]',
    }
    command = [str(problem.driver), "run", str(problem.scene), "--output", str(results), "--quiet"]
    for key, value in settings.items():
        command += ["--set", f"{key}={value}"]
    done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, **ENVIRONMENT})
    if done.returncode != 0:
        raise RunFailed(f"{' '.join(command)}\nended with {done.returncode}: {done.stderr.strip()[-2000:]}")


def gather(results: Path, resolution: Resolution, file: Path) -> Path:
    fields = np.memmap(file, dtype=np.float64, mode="w+", shape=resolution.shape)
    bodies = [data for data in vtu.read_collection(results / "fields.pvd") if data.part == 0]
    if len(bodies) != len(fields):
        raise RunFailed(f"{results}: {len(bodies)} output steps where {len(fields)} were asked for")
    for frame, body in enumerate(sorted(bodies, key=lambda data: data.time)):
        path = results / body.file
        fields[frame] = on_lattice(vtu.read_grid(path), resolution.cells)
        path.unlink()
    return file


def on_lattice(grid: vtu.Grid, cells: int) -> Array:
    """The fields by component, row and column, whatever the order of the vertices in the file."""
    place = np.rint(grid.points[:, :2] * cells).astype(int)
    index = place[:, 1] * (cells + 1) + place[:, 0]
    regular = np.allclose(grid.points[:, :2] * cells, place, atol=1e-6)
    if not regular or not np.array_equal(np.sort(index), np.arange((cells + 1) ** 2)):
        raise RunFailed(f"the mesh is not the unit square with {cells} squares a side")
    data = grid.point_data
    columns = [data["velocity"][:, :2], data["displacement"][:, :2], data["temperature"][:, None]]
    result = np.empty((COMPONENTS, (cells + 1) ** 2))
    result[:, index] = np.concatenate(columns, axis=1).T
    return result.reshape(COMPONENTS, cells + 1, cells + 1)
