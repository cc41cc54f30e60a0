"""The three norms of the difference of two runs at every common time, as a whole and by region."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from convergence_parts.lattice import (
    CORNERS,
    REGIONS,
    Array,
    integral_of_square,
    integral_of_strain_square,
    prolong,
    region_masks,
)
from convergence_parts.runs import Run

NORMS = ("velocity_l2", "displacement_strain_l2", "temperature_l2")
INSIDE_CORNERS = [REGIONS.index(name) for name in CORNERS]


def squares(fields: Array, masks: Array) -> Array:
    """The squared norms [norm, region] of one frame."""
    velocity = integral_of_square(fields[0]) + integral_of_square(fields[1])
    strain = integral_of_strain_square(fields[2:4])
    temperature = integral_of_square(fields[4])
    densities = np.stack([velocity.ravel(), strain.ravel(), temperature.ravel()])
    result: Array = densities @ masks.T
    return result


@dataclass(frozen=True)
class Peak:
    """The largest sum of the three norms over time, its parts at that time, and each norm's own largest value."""

    time: float
    parts: Mapping[str, float]
    own: Mapping[str, float]

    @property
    def error(self) -> float:
        return sum(self.parts.values())


@dataclass(frozen=True)
class History:
    """Squared norms [frame, norm, region] at the common times of two runs, and areas [frame, region]."""

    times: tuple[float, ...]
    difference: Array
    finer: Array
    areas: Array

    def norms(self, begin: float = 0.0, outside_corners: bool = False) -> Array:
        return root(self.difference[self._from(begin)], outside_corners)

    def peak(self, begin: float = 0.0, outside_corners: bool = False) -> Peak:
        return peak(np.array(self.times)[self._from(begin)], self.norms(begin, outside_corners))

    def reference_peak(self) -> Peak:
        return peak(np.array(self.times), root(self.finer, False))

    def shares(self, norm: str) -> dict[str, float]:
        """Of each region in the squared error, at the time at which this norm is largest."""
        _, values = self._worst(norm)
        return {name: float(value / values[0]) for name, value in zip(REGIONS, values)}

    def area_shares(self, norm: str) -> dict[str, float]:
        """Of each region in the area, at that time."""
        frame, _ = self._worst(norm)
        return dict(zip(REGIONS, self.areas[frame].tolist()))

    def _worst(self, norm: str) -> tuple[int, Array]:
        values = self.difference[:, NORMS.index(norm)]
        frame = int(np.argmax(values[:, 0]))
        return frame, values[frame]

    def _from(self, begin: float) -> Array:
        return np.array(self.times) >= begin


def root(values: Array, outside_corners: bool) -> Array:
    inside = values[..., INSIDE_CORNERS].sum(axis=-1) if outside_corners else 0.0
    result: Array = np.sqrt(np.maximum(values[..., 0] - inside, 0.0))
    return result


def peak(times: Array, norms: Array) -> Peak:
    frame = int(np.argmax(norms.sum(axis=1)))
    return Peak(
        time=float(times[frame]),
        parts=dict(zip(NORMS, norms[frame].tolist())),
        own=dict(zip(NORMS, norms.max(axis=0).tolist())),
    )


def compare(coarse: Run, fine: Run) -> History:
    """On the lattice of the finer run, at every time that both have kept."""
    cells = fine.resolution.cells
    values, others = coarse.open(), fine.open()
    times, difference, finer, areas = [], [], [], []
    for frame, other in common_frames(coarse, fine):
        exact = np.array(others[other])
        masks = region_masks(cells, closed_vertices(exact))
        times.append(float(coarse.resolution.time(frame)))
        difference.append(squares(prolong(np.array(values[frame]), cells) - exact, masks))
        finer.append(squares(exact, masks))
        areas.append(masks.mean(axis=1))
    return History(tuple(times), np.array(difference), np.array(finer), np.array(areas))


def closed_vertices(fields: Array) -> Array:
    """On the lower side; the initial gap of the paper's scenes is 0."""
    closed: Array = fields[3, 0] <= 0.0
    return closed


def common_frames(coarse: Run, fine: Run) -> list[tuple[int, int]]:
    frames: dict[Fraction, int] = {fine.resolution.time(at): at for at in range(fine.resolution.frames)}
    pairs = [(at, frames.get(coarse.resolution.time(at))) for at in range(coarse.resolution.frames)]
    return [(at, other) for at, other in pairs if other is not None]


def observed_orders(sizes: Sequence[int], errors: Sequence[float]) -> list[float]:
    """Between each size and the one before it; nan where an error is 0 and for the first."""
    orders = [math.nan]
    for at in range(1, len(sizes)):
        before, now = errors[at - 1], errors[at]
        usable = before > 0.0 and now > 0.0
        orders.append(math.log(before / now) / math.log(sizes[at] / sizes[at - 1]) if usable else math.nan)
    return orders


def fitted_order(sizes: Sequence[int], errors: Sequence[float]) -> float:
    """Least squares through the logarithms."""
    if len(sizes) < 2 or min(errors) <= 0.0:
        return math.nan
    return float(-np.polyfit(np.log(sizes), np.log(errors), 1)[0])
