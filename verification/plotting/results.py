"""A results folder as the pictures need it: fields at a step, the contact boundary as a curve, the history."""

import csv
import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from oracle_parts import vtu

Array = npt.NDArray[Any]
CURVES = (3, 21)  # VTK's types of lines


class Unusable(Exception):
    """The folder lacks something that a picture needs."""


@dataclass(frozen=True)
class ContactCurve:
    """The nodes of one contact boundary's facets in the order of `along`, the coordinate in which it extends most."""

    axis: str
    along: Array
    tangent: Array  # unit vector at each node, towards growing `along`
    values: Mapping[str, Array]

    def field(self, name: str) -> Array:
        return self.values[name]

    def tangential(self, name: str) -> Array:
        """The signed component of a tangential vector."""
        return np.asarray(np.einsum("ij,ij->i", self.values[name], self.tangent))

    @property
    def is_open(self) -> Array:
        return np.asarray(self.values["gap"] > 0.0)


class Results:
    def __init__(self, directory: Path) -> None:
        self.directory = directory
        try:
            self.summary = json.loads((directory / "summary.json").read_text(encoding="utf-8"))
            self.scene: Mapping[str, Any] = self.summary["scene"]
            self.physics = set(self.summary["physics"])
        except (OSError, ValueError, KeyError, TypeError) as problem:
            raise Unusable(f"{directory}: summary.json cannot be used: {problem!r}") from problem

    @cached_property
    def steps(self) -> list[tuple[float, dict[int, Path]]]:
        """Each output time with its files by part: 0 the body, 1 the contact boundary."""
        try:
            datasets = vtu.read_collection(self.directory / "fields.pvd")
        except (OSError, ValueError) as problem:
            raise Unusable(
                f"{self.directory}: fields.pvd cannot be read ({problem}); was output.fields empty?"
            ) from problem
        steps: dict[float, dict[int, Path]] = {}
        for dataset in datasets:
            steps.setdefault(dataset.time, {})[dataset.part] = self.directory / dataset.file
        if not steps:
            raise Unusable(f"{self.directory}: fields.pvd lists no step")
        return sorted(steps.items())

    @property
    def final_time(self) -> float:
        return self.steps[-1][0]

    @cached_property
    def body(self) -> vtu.Grid:
        """At the last step."""
        path = self.steps[-1][1].get(0)
        try:
            return vtu.without_seams(self._grid(path, "the body"))
        except ValueError as problem:
            raise Unusable(f"{path}: {problem}") from problem

    @cached_property
    def contact_grids(self) -> list[vtu.Grid]:
        return [self._grid(parts.get(1), "the contact boundary") for _, parts in self.steps]

    @property
    def contact_is_curve(self) -> bool:
        """Or a surface, that of a body in space."""
        return self.contact_grids[-1].cell_type in CURVES

    @property
    def contact_names(self) -> list[str]:
        boundaries = self.scene.get("boundary", {})
        return sorted(name for name, table in boundaries.items() if "contact" in table)

    def contact_law(self, boundary: str, law: str) -> Mapping[str, Any] | None:
        table = self.scene["boundary"][boundary]["contact"].get(law)
        return table if isinstance(table, dict) else None

    @property
    def foundation_temperature(self) -> str | None:
        """As the scene states it, where all its contact boundaries with conductance have the same one."""
        laws = [self.contact_law(name, "conductance") for name in self.contact_names]
        stated = {
            f"{law['foundation_temperature']}" for law in laws if law and "foundation_temperature" in law
        }
        if len(stated) != 1:
            return None
        try:
            return f"{float(stated.copy().pop()):g}"
        except ValueError:
            return stated.pop()

    def point_field(self, name: str) -> Array:
        return self._body_field(self.body.point_data, name)

    def cell_field(self, name: str) -> Array:
        return self._body_field(self.body.cell_data, name)

    def _body_field(self, data: Mapping[str, Array], name: str) -> Array:
        if name not in data:
            raise Unusable(
                f"{self.directory}: no field '{name}'; does output.fields of the scene leave it out?"
            )
        return data[name]

    def curves(self, boundary: str, needed: Sequence[str]) -> list[ContactCurve]:
        """The boundary at each output step."""
        index = self.contact_names.index(boundary)
        for name in needed:
            if name not in self.contact_grids[0].point_data:
                raise Unusable(f"{self.directory}: no field '{name}' on the contact boundary")
        return [contact_curve(grid, index) for grid in self.contact_grids]

    def contact_surface(self, boundary: str, needed: Sequence[str]) -> vtu.Grid:
        """The facets of one boundary at the last step."""
        grid, index = self.contact_grids[-1], self.contact_names.index(boundary)
        for name in needed:
            if name not in grid.point_data:
                raise Unusable(f"{self.directory}: no field '{name}' on the contact boundary")
        cells = grid.cells[grid.cell_data["boundary"] == index]
        nodes, local = np.unique(cells, return_inverse=True)
        data = {name: values[nodes] for name, values in grid.point_data.items()}
        return vtu.Grid(grid.points[nodes], local.reshape(cells.shape), grid.cell_type, data, {})

    def history(self, columns: Iterable[str]) -> dict[str, Array]:
        path = self.directory / "history.csv"
        try:
            with path.open(encoding="utf-8", newline="") as file:
                rows = list(csv.DictReader(file))
            return {name: np.array([float(row[name]) for row in rows]) for name in columns}
        except (OSError, ValueError, TypeError) as problem:
            raise Unusable(f"{path} cannot be read: {problem}") from problem
        except KeyError as missing:
            raise Unusable(f"{path} has no column {missing}") from missing

    def _grid(self, path: Path | None, what: str) -> vtu.Grid:
        if path is None:
            raise Unusable(
                f"{self.directory}: fields.pvd has no files of {what}; does output.fields leave them out?"
            )
        try:
            return vtu.read_grid(path)
        except (OSError, ValueError, KeyError, StopIteration) as problem:
            raise Unusable(f"{path} cannot be read: {problem}") from problem


def contact_curve(grid: vtu.Grid, boundary: int) -> ContactCurve:
    facets = grid.cells[grid.cell_data["boundary"] == boundary]
    points = grid.points[facets]
    axis = int(np.argmax(np.ptp(points.reshape(-1, 3), axis=0)))
    # Facets from one end to the other, and each facet's nodes likewise: a quadratic edge has its midpoint last.
    order = np.argsort(points[:, :2, axis].mean(axis=1))
    facets, points = facets[order], points[order]
    within = np.argsort(points[:, :, axis], axis=1)
    nodes = np.take_along_axis(facets, within, axis=1)
    ends = grid.points[nodes[:, -1]] - grid.points[nodes[:, 0]]
    tangent = ends / np.linalg.norm(ends, axis=1, keepdims=True)
    flat = nodes.ravel()
    return ContactCurve(
        axis="xyz"[axis],
        along=grid.points[flat, axis],
        tangent=np.repeat(tangent, nodes.shape[1], axis=0),
        values={name: values[flat] for name, values in grid.point_data.items()},
    )
