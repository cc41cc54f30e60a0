"""Compare the numbers that two summaries end with: norms and contact measures, as compare.py says."""

import csv
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from findings import Unusable, Worst

VELOCITY = "velocity_l2"
NORMS = (VELOCITY, "displacement_strain_l2", "temperature_l2")
FORCES = ("normal_force", "tangential_force")
FRACTIONS = ("contact_fraction", "slip_fraction")
OTHERS = ("max_penetration", "heat_flow")
HALF_A_BIT = 2.0**-53  # the relative error of rounding to double precision


def velocity_round_off(directory: Path) -> float:
    """How well N steps with u_n = u_(n-1) + k w_n know ||w||: N 2^-53 max ||w|| times the condition; 0 without a history.

    A step begins with a displacement that is rounded to 2^-53 |u|, hence with a strain and elastic forces that are
    wrong by as much. Where elasticity outweighs inertia (k^2 E > rho h^2), the step answers with the velocity that
    takes this back, 2^-53 |u|/k, and |u| <= N k max |w|. That the rounding of the system's entries and of its right-hand
    side makes it larger by up to Skeel's condition number is what the summary of the driver states (`conditioning`);
    without one it counts as 1. It matters to a body that has slid far and is at rest: in
    scenes/benchmarks/sliding-block.toml it is 4e-14 m/s, where friction's creep is 1.4e-7 m/s. Seen there: 7e-16 m/s,
    as errors of the nodes cancel in the norm; 1e-17 with the origin where the block comes to rest, 1e-13 with it
    100 m away.
    """
    try:
        with (directory / "history.csv").open(encoding="utf-8", newline="") as file:
            norms = [float(row.get("velocity_l2") or 0.0) for row in csv.DictReader(file)]
    except FileNotFoundError:
        return 0.0
    except (OSError, ValueError) as problem:
        raise Unusable(f"{directory}: history.csv cannot be read: {problem}") from problem
    finite = [norm for norm in norms if np.isfinite(norm)]
    return len(norms) * HALF_A_BIT * max(finite, default=0.0) * _condition(directory)


def _condition(directory: Path) -> float:
    """Of the momentum balance's last system, at least 1."""
    try:
        summary = json.loads((directory / "summary.json").read_text(encoding="utf-8"))
    except (OSError, ValueError) as problem:
        raise Unusable(f"{directory}: summary.json cannot be read: {problem}") from problem
    stated = (summary.get("conditioning") or {}).get("momentum") or {}
    return max(1.0, float(stated.get("condition") or 1.0))


def compare_finals(a: Mapping[str, Any], b: Mapping[str, Any], round_off: float) -> list[Worst]:
    """`round_off` of the velocity's norm, of both together."""
    ignored = {VELOCITY: round_off}
    results = [_number(name, a.get(name), b.get(name), ignored=ignored.get(name, 0.0)) for name in NORMS]
    contact_a, contact_b = a.get("contact") or {}, b.get("contact") or {}
    if set(contact_a) != set(contact_b):
        raise Unusable("the summaries name different contact boundaries")
    for side in sorted(contact_a):
        of_a, of_b = contact_a[side], contact_b[side]
        force = max(abs(of.get(name) or 0.0) for of in (of_a, of_b) for name in FORCES)
        scales = {name: force for name in FORCES} | {name: 1.0 for name in FRACTIONS}
        for name in (*FORCES, *FRACTIONS, *OTHERS):
            results.append(_number(f"{side} {name}", of_a.get(name), of_b.get(name), scales.get(name)))
    return results


def _number(
    name: str, a: float | None, b: float | None, scale: float | None = None, ignored: float = 0.0
) -> Worst:
    a, b = a or 0.0, b or 0.0
    if not (np.isfinite(a) and np.isfinite(b)):
        return Worst(f"final {name}", np.inf)
    scale = max(abs(a), abs(b)) if scale is None else scale
    return Worst(f"final {name}", max(0.0, abs(a - b) - ignored) / scale if scale > 0.0 else 0.0)
