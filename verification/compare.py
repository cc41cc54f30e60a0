"""Compare two result directories of the same scene, field by field and step by step.

    python3 verification/compare.py DIR_A DIR_B [--tolerance 1e-9]

Body points are matched by their coordinates, body cells by their midpoints, contact points by the pair (midpoint of
the facet, point), all to 1e-9 of the bounding box, so that numbering and the number of processes do not matter. The
pieces of a PVTU are one grid; a node that several of them have must have the same values in all.

The relative difference of a field at a step is the largest absolute difference of any component at any point or
cell, over the largest absolute value that the field has in either directory at any step. Numbers of the summary:
the norms and the final contact measures, |a - b| over the larger of the two; the two contact forces share the larger
of them as their scale, and fractions have the scale 1. A measure that one side lacks counts as 0. Of a difference of
the velocity's norm only what exceeds the round-off of the displacements counts (velocity_round_off).

`state` (open, stick, slip) and `boundary` are compared as integers. Differing states are excused where the quantity
that decides lies within tolerance * its largest value of the threshold: gap = 0 for open against closed, |slip
velocity| = epsilon for stick against slip. Values that are not finite are a failure, whatever the other side holds.

Exit codes: 0 agreement, 1 a difference beyond the tolerance, 2 the directories cannot be compared (files missing,
times or meshes that differ, a field in one of them only).
"""

import argparse
import json
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree

from final_numbers import compare_finals, velocity_round_off
from findings import Unusable, Worst
from oracle_parts import vtu
from same_steps import first_difference

SAME_PLACE = 1e-9  # relative to the bounding box; also for times, relative to the last one
PARTS = {0: "body", 1: "contact"}
OPEN, STICK = 0, 1

Array = npt.NDArray[Any]


@dataclass
class Record:
    """What the pass over the steps collects for one field: (time, place, absolute difference) and the scale."""

    differences: list[tuple[float, str, float]] = field(default_factory=list)
    scale: float = 0.0

    def add(self, time: float, places: Array, a: Array, b: Array) -> None:
        rows = (len(a), -1)
        difference = np.abs(a.astype(float) - b.astype(float)).reshape(rows).max(axis=1, initial=0.0)
        sizes = np.maximum(np.abs(a), np.abs(b)).reshape(rows).max(axis=1, initial=0.0)
        broken = ~np.isfinite(difference)
        difference[broken] = np.inf
        if len(difference):
            at = int(np.argmax(difference))
            self.differences.append((time, place(places[at]), float(difference[at])))
            self.scale = max(self.scale, float(sizes[np.isfinite(sizes)].max(initial=0.0)))

    def worst(self, name: str) -> Worst:
        result = Worst(name)
        for time, where, difference in self.differences:
            relative = difference / self.scale if self.scale > 0.0 else difference
            if relative > result.relative:
                result = Worst(name, relative, time, where)
        return result


@dataclass(frozen=True)
class StateMismatch:
    """Two differing states, and how far the deciding quantity is from its threshold."""

    time: float
    where: str
    decided_by: str
    distance: float


def place(point: Array) -> str:
    return "(" + ", ".join(f"{coordinate:.6g}" for coordinate in point) + ")"


def load_summary(directory: Path) -> dict[str, Any]:
    try:
        summary = json.loads((directory / "summary.json").read_text(encoding="utf-8"))
    except (OSError, ValueError) as problem:
        raise Unusable(f"{directory}: summary.json cannot be read: {problem}") from problem
    if not isinstance(summary, dict) or not isinstance(summary.get("final"), dict):
        raise Unusable(f"{directory}: summary.json has no table 'final'")
    return summary


def load_steps(directory: Path) -> dict[float, dict[int, Path]]:
    """The files of each output time by part, in the order of time."""
    try:
        datasets = vtu.read_collection(directory / "fields.pvd")
    except (OSError, ValueError) as problem:
        raise Unusable(f"{directory}: fields.pvd cannot be read: {problem}") from problem
    steps: dict[float, dict[int, Path]] = {}
    for dataset in datasets:
        parts = steps.setdefault(dataset.time, {})
        if dataset.part in parts or dataset.part not in PARTS:
            raise Unusable(
                f"{directory}: part {dataset.part} at t = {dataset.time:g} is unknown or there twice"
            )
        parts[dataset.part] = directory / dataset.file
    if not steps:
        raise Unusable(f"{directory}: fields.pvd lists no step")
    return dict(sorted(steps.items()))


def load_grid(path: Path, part: int) -> vtu.Grid:
    """Of the contact boundary each facet keeps its own points."""
    try:
        grid = vtu.read_grid(path)
        return vtu.without_seams(grid) if part == 0 else grid
    except (OSError, ValueError, KeyError, StopIteration) as problem:
        raise Unusable(f"{path}: {problem}") from problem


def midpoints(grid: vtu.Grid) -> Array:
    """Of the vertices, which come first among the nodes of a cell."""
    return grid.points[grid.cells[:, : vtu.VERTICES[grid.cell_type]]].mean(axis=1)


def matched(a: Array, b: Array, radius: float, what: str) -> npt.NDArray[np.int64]:
    """For each row of a the row of b at the same place; a one-to-one map."""
    if len(a) != len(b):
        raise Unusable(f"the meshes differ: {len(a)} against {len(b)} {what}")
    if not len(a):
        return np.empty(0, dtype=np.int64)
    if not (np.all(np.isfinite(a)) and np.all(np.isfinite(b))):
        raise Unusable(f"the meshes differ: {what} at non-finite places")
    distances, rows = cKDTree(b).query(a)
    furthest = int(np.argmax(distances))
    if distances[furthest] > radius or len(np.unique(rows)) != len(a):
        raise Unusable(f"the meshes differ: {what} at {place(a[furthest])} and elsewhere have no partner")
    return np.asarray(rows, dtype=np.int64)


class Matching:
    """The maps between the points and cells of two grids; the last one is kept, for most meshes never change."""

    def __init__(self) -> None:
        self.key: tuple[bytes, ...] = ()
        self.points = self.cells = np.empty(0, dtype=np.int64)

    def update(self, a: vtu.Grid, b: vtu.Grid, part: int) -> None:
        if a.cell_type != b.cell_type and len(a.cells) and len(b.cells):
            raise Unusable(f"the meshes differ: cell types {a.cell_type} and {b.cell_type}")
        key = tuple(array.tobytes() for array in (a.points, a.cells, b.points, b.cells))
        if key == self.key:
            return
        extent = np.ptp(a.points, axis=0) if len(a.points) else np.zeros(3)
        radius = SAME_PLACE * float(np.linalg.norm(extent))
        self.cells = matched(midpoints(a), midpoints(b), radius, f"cells of the {PARTS[part]}")
        what = f"points of the {PARTS[part]}"
        if part == 0:
            self.points = matched(a.points, b.points, radius, what)
        else:
            self.points = matched(with_facet(a), with_facet(b), 2 * radius, what)
        self.key = key


def with_facet(grid: vtu.Grid) -> Array:
    """Each contact point beside its facet's midpoint: two facets may share a place, their values differ."""
    beside = np.full_like(grid.points, np.nan)
    beside[grid.cells] = midpoints(grid)[:, None, :]
    return np.hstack((grid.points, beside))


class Comparison:
    def __init__(self, epsilons: Sequence[float]) -> None:
        """`epsilons`: the friction regularisation of each contact boundary by its index, 0 without friction."""
        self.epsilons = np.array(epsilons)
        self.records: dict[str, Record] = {}
        self.mismatches: list[StateMismatch] = []
        self.matchings = {part: Matching() for part in PARTS}

    def add(self, time: float, part: int, a: vtu.Grid, b: vtu.Grid) -> None:
        matching = self.matchings[part]
        matching.update(a, b, part)
        for kind in ("point_data", "cell_data"):
            of_a, of_b = getattr(a, kind), getattr(b, kind)
            alone = set(of_a) ^ set(of_b)
            if alone:
                raise Unusable(f"field {min(alone)} of the {PARTS[part]} is in one directory only")
            rows = matching.points if kind == "point_data" else matching.cells
            places = a.points if kind == "point_data" else midpoints(a)
            for name, values in of_a.items():
                partner = of_b[name]
                if values.shape != partner.shape:
                    raise Unusable(f"field {name}: shapes {values.shape} and {partner.shape}")
                if name == "state":
                    self._add_states(time, a, b, rows)
                    self.records.setdefault(f"{PARTS[part]} {name}", Record())
                else:
                    record = self.records.setdefault(f"{PARTS[part]} {name}", Record())
                    shown = self._unique_tractions(a, b, rows) if name == "traction" else slice(None)
                    if len(values[shown]):
                        record.add(time, places[shown], values[shown], partner[rows][shown])

    def _add_states(self, time: float, a: vtu.Grid, b: vtu.Grid, rows: Array) -> None:
        state_a, state_b = a.point_data["state"], b.point_data["state"][rows]
        for at in np.flatnonzero(state_a != state_b):
            if OPEN in (state_a[at], state_b[at]):
                decided_by = "gap"
                values = [a.point_data["gap"][at], b.point_data["gap"][rows[at]]]
            else:
                decided_by = "slip_velocity"
                epsilon = self._epsilon_at(a, int(at))
                both = (a.point_data[decided_by][at], b.point_data[decided_by][rows[at]])
                values = [np.linalg.norm(slip) - epsilon for slip in both]
            distance = float(np.min(np.abs(values)))
            self.mismatches.append(StateMismatch(time, place(a.points[at]), decided_by, distance))

    def _unique_tractions(self, a: vtu.Grid, b: vtu.Grid, rows: Array) -> Any:
        """Where Coulomb's law itself (epsilon = 0) makes a point stick, only resultants are unique."""
        if "state" not in a.point_data or 0.0 not in self.epsilons:
            return np.ones(len(rows), dtype=bool)
        exact = np.zeros(len(a.points), dtype=bool)
        exact[a.cells[self.epsilons[a.cell_data["boundary"].astype(int)] == 0.0]] = True
        sticks = (a.point_data["state"] == STICK) | (b.point_data["state"][rows] == STICK)
        return ~(exact & sticks)

    def _epsilon_at(self, grid: vtu.Grid, point: int) -> float:
        cell = int(np.flatnonzero((grid.cells == point).any(axis=1))[0])
        return float(self.epsilons[int(grid.cell_data["boundary"][cell])])

    def worst(self, tolerance: float) -> list[Worst]:
        results = []
        for name, record in self.records.items():
            results.append(
                self._worst_state(name, tolerance) if name.endswith(" state") else record.worst(name)
            )
        return results

    def _worst_state(self, name: str, tolerance: float) -> Worst:
        for mismatch in self.mismatches:
            scale = self.records[f"contact {mismatch.decided_by}"].scale
            if not mismatch.distance <= tolerance * scale:
                return Worst(name, 1.0, mismatch.time, mismatch.where)
        return Worst(name)


def regularisations(summary: Mapping[str, Any]) -> list[float]:
    """Of the contact boundaries in alphabetical order, from the resolved scene; 0 without friction."""
    boundaries = summary.get("scene", {}).get("boundary", {})
    contacts = [boundaries[name]["contact"] for name in sorted(boundaries) if "contact" in boundaries[name]]
    return [float(contact.get("friction", {}).get("regularisation", 0.0)) for contact in contacts]


def compare_fields(
    directory_a: Path, directory_b: Path, epsilons: Sequence[float], tolerance: float
) -> list[Worst]:
    steps_a, steps_b = load_steps(directory_a), load_steps(directory_b)
    times_a, times_b = np.array(list(steps_a)), np.array(list(steps_b))
    if len(times_a) != len(times_b):
        raise Unusable(f"{len(times_a)} output times against {len(times_b)}")
    if not np.all(np.abs(times_a - times_b) <= SAME_PLACE * np.max(np.abs(times_a))):
        raise Unusable("the output times differ")
    comparison = Comparison(epsilons)
    for (time, parts_a), parts_b in zip(steps_a.items(), steps_b.values()):
        if set(parts_a) != set(parts_b):
            raise Unusable(f"the files of t = {time:g} differ in kind: contact is in one directory only")
        for part in sorted(parts_a):
            comparison.add(time, part, load_grid(parts_a[part], part), load_grid(parts_b[part], part))
    return comparison.worst(tolerance)


def compare(directory_a: Path, directory_b: Path, tolerance: float) -> list[Worst]:
    summary_a, summary_b = load_summary(directory_a), load_summary(directory_b)
    if summary_a.get("status") != summary_b.get("status"):
        raise Unusable(f"the runs ended differently: {summary_a.get('status')}, {summary_b.get('status')}")
    if difference := first_difference(directory_a, directory_b):
        raise Unusable(difference)
    written = [(directory / "fields.pvd").exists() for directory in (directory_a, directory_b)]
    asked = [summary.get("scene", {}).get("output", {}).get("fields") for summary in (summary_a, summary_b)]
    results = []
    if any(written) or asked != [[], []]:
        results = compare_fields(directory_a, directory_b, regularisations(summary_a), tolerance)
    round_off = velocity_round_off(directory_a) + velocity_round_off(directory_b)
    return results + compare_finals(summary_a["final"], summary_b["final"], round_off)


def print_table(results: Sequence[Worst]) -> None:
    print(f"{'field':<32} {'worst at t':>12}  {'place':<34} {'relative difference':>19}")
    for result in results:
        time = "" if result.time is None else f"{result.time:.6g}"
        print(f"{result.name:<32} {time:>12}  {result.place:<34} {result.relative:>19.3e}")


def main(arguments: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(description="Compare two result directories of the same scene.")
    parser.add_argument("directory_a", type=Path, metavar="DIR_A")
    parser.add_argument("directory_b", type=Path, metavar="DIR_B")
    parser.add_argument("--tolerance", type=float, default=1e-9)
    options = parser.parse_args(arguments)
    try:
        results = compare(options.directory_a, options.directory_b, options.tolerance)
    except Unusable as problem:
        print(f"compare: {problem}", file=sys.stderr)
        return 2
    print_table(results)
    overall = max(results, key=lambda result: result.relative)
    agree = overall.relative <= options.tolerance
    where = "" if overall.time is None else f" at t = {overall.time:.6g}, {overall.place}"
    verdict = "agreement within" if agree else "DIFFERENCE beyond"
    print(f"{verdict} {options.tolerance:g}; the worst is {overall.name}{where}: {overall.relative:.3e}")
    return 0 if agree else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
