"""Results that must agree once they are carried over: points and vectors moved, numbers in the same unit."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree

from oracle_parts import vtu

Array = npt.NDArray[np.float64]
VECTORS = ("displacement", "velocity", "traction", "slip_velocity")
IGNORED = ("state", "boundary", "stress")  # integers; stress: its invariant von_mises is compared

Move = Callable[[Array], Array]


def unchanged(values: Array) -> Array:
    return values


@dataclass(frozen=True)
class Carry:
    """How the base's results look in the other scene."""

    points: Move = unchanged
    vectors: Move = unchanged
    factor: Callable[[str], float] = lambda name: 1.0
    drift: Mapping[str, Array] = field(default_factory=dict)  # [3], added to a field


def difference(base: Path, other: Path, carry: Carry) -> tuple[float, str]:
    """The largest difference of a field at the last time, over the field's largest value at any output time."""
    found = [(0.0, "nothing")]
    for part in (0, 1):
        grids = [_grids(folder, part) for folder in (base, other)]
        if not grids[0]:
            continue
        for name in sorted(set(grids[0][-1].point_data) | set(grids[0][-1].cell_data)):
            if name not in IGNORED:
                found.append((_field(grids[0], grids[1], name, carry), f"{('body', 'contact')[part]} {name}"))
    return max(found)


def _grids(folder: Path, part: int) -> list[vtu.Grid]:
    entries = vtu.read_collection(folder / "fields.pvd")
    return [vtu.read_grid(folder / entry.file) for entry in entries if entry.part == part]


def _places(grid: vtu.Grid, name: str) -> tuple[Array, Array]:
    """Where the values are: points, or the midpoints of cells. Contact points also know their facet."""
    if name in grid.cell_data:
        return grid.points[grid.cells].mean(axis=1), grid.cell_data[name]
    if len(np.unique(grid.points, axis=0)) == len(grid.points):
        return grid.points, grid.point_data[name]
    middle = np.empty_like(grid.points)
    for cell in grid.cells:
        middle[cell] = grid.points[cell].mean(axis=0)
    return np.hstack([grid.points, middle]), grid.point_data[name]


def _field(base: list[vtu.Grid], other: list[vtu.Grid], name: str, carry: Carry) -> float:
    places, values = _places(base[-1], name)
    places = np.hstack([carry.points(places[:, i : i + 3]) for i in range(0, places.shape[1], 3)])
    expected = (carry.vectors(values) if name in VECTORS else values) * carry.factor(name)
    expected = expected + carry.drift.get(name, 0.0)
    other_places, found = _places(other[-1], name)
    size = float(np.ptp(places, axis=0).max())
    distance, index = cKDTree(other_places).query(places)
    if distance.max() > 1e-7 * size or len(places) != len(other_places):
        raise ValueError(f"the points of {name} are not the same: off by {distance.max():.1e} of {size:.1e}")
    scale = max(float(np.abs(_places(grid, name)[1]).max()) for grid in base) * carry.factor(name)
    if scale == 0:
        return float(np.abs(found).max() > 0)
    return float(np.abs(expected - found[index]).max()) / scale
