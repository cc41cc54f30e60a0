"""How a case ended, and whether that is a good end.

Good: completed with every number finite, all audits <= 1e-8 and the bounds of physics kept; or stopped with exit code 3
and the right reason: a step, a balance, what was tried and what to change, and for a scene without unique solution that
its system is singular. Everything else is bad: another exit code, a signal, a hang, a number that is not finite.
"""

import csv
import json
import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from extremes_parts.cases import Case
from extremes_parts.parameters import CONTACT
from extremes_parts.runs import Ended
from oracle_parts import vtu

AUDIT = 1e-8
BOUND = 1e-12  # round-off of a pointwise law, relative
QUADRATIC = (
    1e-10  # round-off of a quadratic form, relative to the largest term of the energy balance of its step
)

COMPLETED, STOPPED, BAD = "completed", "stopped", "bad"
REASON = re.compile(r"(momentum|heat) balance: .*; .*(try|prescribe|scale|use) ", re.DOTALL)
DISSIPATIONS = (
    "kinetic_numerical_dissipation",
    "strain_numerical_dissipation",
    "viscous_dissipation",
    "friction_dissipation",
)
ENERGIES = DISSIPATIONS + (
    "kinetic_energy",
    "strain_energy",
    "compliance_work",
    "load_work",
    "thermal_work",
    "reaction_work",
)

Array = npt.NDArray[Any]


@dataclass(frozen=True)
class Verdict:
    outcome: str  # completed, stopped, bad
    why: str
    retries: int = 0
    iterations: int = 0


def judge(case: Case, ended: Ended) -> Verdict:
    if ended.code not in (0, 3):
        return Verdict(BAD, ended.text())
    try:
        summary = json.loads((ended.directory / "summary.json").read_text(encoding="utf-8"))
        faults = [*_not_finite(ended.directory, summary)]
        newton = summary.get("newton", {"retries": 0, "iterations": 0})  # none where no step was begun
        counts = int(newton["retries"]), int(newton["iterations"])
        if ended.code == 3:
            faults += _wrong_reason(case, ended.message)
            return Verdict(BAD if faults else STOPPED, "; ".join(faults) or ended.message, *counts)
        if case.singular:
            faults.append("completed, though the scene has no unique solution")
        faults += [*_audits(summary), *_bounds(case, ended.directory, summary)]
    except (OSError, ValueError, KeyError) as problem:
        return Verdict(BAD, f"results cannot be read: {problem!r}")
    return Verdict(BAD if faults else COMPLETED, "; ".join(faults), *counts)


def _wrong_reason(case: Case, message: str) -> Iterator[str]:
    if not REASON.search(message):
        yield f"a reason without balance, attempts or advice: {message}"
    if case.singular and not re.search(r"the system is singular: .* is free to (move|change)", message):
        yield f"the system is singular, and the reason is another, or what is free is not told: {message}"


def _numbers(value: Any, name: str = "") -> Iterator[tuple[str, float]]:
    if isinstance(value, Mapping):
        for key, below in value.items():
            yield from _numbers(below, f"{name}.{key}" if name else key)
    elif isinstance(value, list):
        for number, below in enumerate(value):
            yield from _numbers(below, f"{name}[{number}]")
    elif isinstance(value, (int, float)):
        yield name, float(value)


def history(directory: Path) -> list[dict[str, float]]:
    file = directory / "history.csv"
    if not file.exists():
        return []
    with file.open(encoding="ascii", newline="") as lines:
        return [{name: float(text) for name, text in row.items()} for row in csv.DictReader(lines)]


def grids(directory: Path) -> Iterator[tuple[vtu.Grid, vtu.Grid | None]]:
    """Body and contact at each output time."""
    file = directory / "fields.pvd"
    entries = vtu.read_collection(file) if file.exists() else []
    by_time: dict[float, dict[int, str]] = {}
    for entry in entries:
        by_time.setdefault(entry.time, {})[entry.part] = entry.file
    for files in by_time.values():
        read = {part: vtu.read_grid(directory / name) for part, name in files.items()}
        yield read[0], read.get(1)


def _not_finite(directory: Path, summary: Mapping[str, Any]) -> Iterator[str]:
    for name, number in _numbers({key: summary[key] for key in ("final", "audit") if key in summary}):
        if not math.isfinite(number):
            yield f"summary: {name} = {number}"
    for row in history(directory):
        for name, number in row.items():
            if not math.isfinite(number):
                yield f"history: {name} = {number} in step {row.get('step')}"
    for grid in (grid for pair in grids(directory) for grid in pair if grid is not None):
        for name, values in {**grid.point_data, **grid.cell_data}.items():
            if not np.isfinite(values).all():
                yield f"fields: {name} is not finite"


def _audits(summary: Mapping[str, Any]) -> Iterator[str]:
    for name, residual in summary["audit"].items():
        if not residual <= AUDIT:
            yield f"audit of {name}: {residual:.2e}"


def _bounds(case: Case, directory: Path, summary: Mapping[str, Any]) -> Iterator[str]:
    for row in history(directory):
        scale = max((abs(row[name]) for name in ENERGIES if name in row), default=0.0)
        for name in DISSIPATIONS:
            if row.get(name, 0.0) < -QUADRATIC * scale:
                yield f"{name} = {row[name]:.3e} in step {row['step']:.0f} (largest energy {scale:.1e})"
    mu = float(case.scene.get(f"{CONTACT}.friction.coefficient", 0.0))
    for body, contact in grids(directory):
        if contact is not None:
            yield from _contact_bounds(case, body, contact, mu)


def _contact_bounds(case: Case, body: vtu.Grid, contact: vtu.Grid, mu: float) -> Iterator[str]:
    data = contact.point_data
    pressure = data.get("pressure")
    if pressure is not None and pressure.min() < 0:
        yield f"pressure = {pressure.min():.3e}"
    if pressure is not None and "traction" in data:
        excess = np.linalg.norm(data["traction"], axis=1) - mu * pressure * (1 + BOUND)
        if excess.max() > 0:
            yield f"traction beyond mu p by {excess.max():.3e}"
    if "heat_flow" in data:
        places = {tuple(point): theta for point, theta in zip(body.points, body.point_data["temperature"])}
        theta = np.array([places[tuple(point)] for point in contact.points])
        theta_F = float(case.scene[f"{CONTACT}.conductance.foundation_temperature"])
        wrong = data["heat_flow"] * (theta - theta_F)
        if wrong.min() < 0:
            yield f"heat flows the wrong way: {wrong.min():.3e} W K/m^2"
