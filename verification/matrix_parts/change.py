"""How much two results of the driver differ: the largest relative difference of anything that both have.

Fields are compared as compare.py does, relative to the field's largest value at any common step, but only where the
two meshes are the same; norms and contact measures always. What one result lacks counts as 0 in the norms.
"""

from pathlib import Path
from typing import Any

import numpy as np

import compare
from oracle_parts import vtu


NOTHING = (
    1e-9  # in the scenes' own units, where everything there is exceeds 1e-5: a number below it is round-off
)


def change(a: Path, b: Path) -> tuple[float, str]:
    """The difference and where it was found."""
    return max(changes(a, b))


def changes(a: Path, b: Path, sticking: bool = True) -> list[tuple[float, str]]:
    """All of them; without `sticking` not the tractions of points that stick, of which Coulomb's law itself makes only
    the resultants unique."""
    found = [(0.0, "nothing")]
    found += _in_numbers(a, b)
    if (a / "fields.pvd").exists() and (b / "fields.pvd").exists():
        found += _in_fields(a, b, sticking)
    return found


def _in_numbers(a: Path, b: Path) -> list[tuple[float, str]]:
    final_a, final_b = (_numbers(compare.load_summary(directory)["final"]) for directory in (a, b))
    return [
        (_relative(final_a.get(name, 0.0), final_b.get(name, 0.0)), name)
        for name in sorted(final_a | final_b)
    ]


def _numbers(table: dict[str, Any], prefix: str = "") -> dict[str, float]:
    numbers: dict[str, float] = {}
    for name, value in table.items():
        if isinstance(value, dict):
            numbers |= _numbers(value, f"{prefix}{name}.")
        elif name != "time":
            numbers[prefix + name] = float(value or 0.0)
    return numbers


def _relative(a: float, b: float) -> float:
    scale = max(abs(a), abs(b))
    return abs(a - b) / scale if scale > NOTHING else 0.0


def _in_fields(a: Path, b: Path, sticking: bool) -> list[tuple[float, str]]:
    steps_a, steps_b = compare.load_steps(a), compare.load_steps(b)
    last = max(steps_a)
    differences: dict[str, float] = {}
    scales: dict[str, float] = {}
    for time, parts in steps_a.items():
        partner = next((other for other in steps_b if abs(other - time) <= compare.SAME_PLACE * last), None)
        for part in set(parts) & set(steps_b.get(partner, {}) if partner is not None else {}):
            grid_a, grid_b = vtu.read_grid(parts[part]), vtu.read_grid(steps_b[partner][part])  # type: ignore[index]
            for name, values, others in _common(grid_a, grid_b):
                if name == "traction" and not sticking:
                    slips = (grid_a.point_data["state"] != compare.STICK) & (
                        grid_b.point_data["state"] != compare.STICK
                    )
                    values, others = values[slips], others[slips]
                key = f"{compare.PARTS[part]} {name}"
                difference = float(np.abs(values - others).max(initial=0.0))
                scale = float(max(np.abs(values).max(initial=0.0), np.abs(others).max(initial=0.0)))
                differences[key] = max(differences.get(key, 0.0), difference)
                scales[key] = max(scales.get(key, 0.0), scale)
    return [(differences[key] / scales[key] if scales[key] > NOTHING else 0.0, key) for key in differences]


def _common(a: vtu.Grid, b: vtu.Grid) -> list[tuple[str, Any, Any]]:
    """Fields of both on the same mesh. States are left out: a touch of round-off may turn one."""
    if not (np.array_equal(a.points, b.points) and np.array_equal(a.cells, b.cells)):
        return []
    found = []
    for kind in ("point_data", "cell_data"):
        of_a, of_b = getattr(a, kind), getattr(b, kind)
        names = sorted(set(of_a) & set(of_b) - {"state", "boundary"})
        found += [(name, of_a[name], of_b[name]) for name in names]
    return found
