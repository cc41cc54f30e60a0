"""A second opinion on completed cases: the oracle, or where it fails the driver at other settings.

How near the two must be is measured and not assumed: the driver solves the scene once more with all loads (or, without
any, the stiffness) larger by NUDGE, and what that changes says how far round-off may carry: a relative error of one
operation is amplified like the nudge. The allowance is the agreement asked of all scenes, 1e-9, plus ALLOWANCE times
the change for a nudge of the size that 1e-16 and some thousand operations make of a datum.

A run whose summary says that some solve ended at round-off, beyond the tolerance, is known no better than the residual that
it states: friction of stiffness mu p/epsilon makes that much of the last bit of a slip velocity. It counts as the change
does.

A flow of heat in the fields is k_c times the difference of two temperatures, each of which is rounded, in both programs:
2 epsilon k_c times the larger of them is what it may differ by, whatever the nudge does.
"""

import json
import random
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from extremes_parts.cases import CONTESTED, SEED
from extremes_parts.judge import COMPLETED, grids
from extremes_parts.parameters import CONTACT
from extremes_parts.runs import Driver
from matrix_parts.change import change, changes
from matrix_parts.runs import oracle, oracle_failure
from matrix_parts.scenes import Flat

if TYPE_CHECKING:
    from extremes_parts.report import Row

NUDGE = 1e-12
ALLOWANCE = 10.0
AGREEMENT = 1e-9
LONGEST = 1000  # steps: longer cases are left out, for the oracle takes minutes for them
WORKERS = 2


@dataclass(frozen=True)
class Opinion:
    by: str  # "oracle" or "other settings"
    agrees: bool
    text: str


def second_opinions(rows: "Sequence[Row]", driver: Driver, share: float) -> dict[int, Opinion]:
    """By the number of the row: a share at random, and those that were contested once."""
    completed = [
        number
        for number, row in enumerate(rows)
        if row.verdict.outcome == COMPLETED and int(row.case.scene["time.steps"]) <= LONGEST
    ]
    count = min(len(completed), round(share * len(completed) + 0.5)) if share > 0 else 0
    contested = {number for number in completed if rows[number].case.name in CONTESTED}
    chosen = sorted(contested.union(random.Random(SEED).sample(completed, count)))
    jobs = [
        (rows[number].ended.directory.with_suffix(".toml"), _oracle_folder(rows[number])) for number in chosen
    ]
    oracle(jobs, driver.folder, WORKERS)
    return {number: _opinion(rows[number], driver) for number in chosen}


def _oracle_folder(row: "Row") -> Path:
    directory = row.ended.directory
    return directory.with_name(directory.name + "-oracle")


def _opinion(row: "Row", driver: Driver) -> Opinion:
    directory = row.ended.directory
    if _divided(directory):
        return Opinion("nobody", True, "steps were taken in parts: another discretisation in time")
    nudged = driver.run(directory.name + "-nudged", _nudged(row.case.scene))
    sensitivity = change(directory, nudged.directory)[0] if nudged.code == 0 else 1.0
    allowed = AGREEMENT + ALLOWANCE * (sensitivity + _left_at_round_off(directory))
    failure = oracle_failure(_oracle_folder(row))
    by, other = "oracle", _oracle_folder(row)
    if failure:
        ended = driver.run(directory.name + "-other", _other_settings(row.case.scene))
        by, other = "other settings", ended.directory
        if ended.code != 0:
            return Opinion("nobody", True, f"{failure}; driver at other settings: {ended.text()}")
    if by == "other settings":
        allowed += ALLOWANCE * _left_at_round_off(other)
    if by == "other settings" and _divided(other):
        return Opinion("nobody", True, f"{failure}; other settings took the steps in other parts")
    rounded = _rounded_flow(row.case.scene, directory)
    excess, difference, where, bound = max(
        (difference / bound, difference, where, bound)
        for difference, where in changes(
            directory, other, sticking=row.case.scene.get(f"{CONTACT}.friction.regularisation") != 0
        )
        for bound in [allowed + (rounded if where.endswith("heat_flow") else 0.0)]
    )
    return Opinion(by, excess <= 1, f"{by}: {difference:.1e} in {where}, allowed {bound:.1e}")


def _rounded_flow(scene: Flat, directory: Path) -> float:
    """What rounding temperatures leaves undetermined of the contact's flow, relative to it; per side of 1 m."""
    flow, hottest = 0.0, 0.0
    for body, contact in grids(directory):
        if contact is not None and "heat_flow" in contact.point_data:
            flow = max(flow, float(np.abs(contact.point_data["heat_flow"]).max()))
            hottest = max(hottest, float(np.abs(body.point_data["temperature"]).max()))
    if flow == 0:
        return 0.0
    law = f"{CONTACT}.conductance"
    hottest = max(hottest, abs(float(scene[f"{law}.foundation_temperature"])))
    final = json.loads((directory / "summary.json").read_text(encoding="utf-8"))["final"]["contact"]["bottom"]
    smallest = min(flow, abs(final["heat_flow"]) or flow)
    return float(2 * np.finfo(float).eps * float(scene[f"{law}.coefficient"]) * hottest / smallest)


def _left_at_round_off(directory: Path) -> float:
    """The largest residual of a solve that ended beyond the tolerance, as its summary states; relative."""
    summary = json.loads((directory / "summary.json").read_text(encoding="utf-8"))
    return float(summary["recovery"]["largest_residual_of_these"])


def _divided(directory: Path) -> int:
    """Steps that were taken in parts: another discretisation in time, which no second opinion can judge."""
    summary = json.loads((directory / "summary.json").read_text(encoding="utf-8"))
    return int(summary["recovery"]["divided_steps"])


def _nudged(scene: Flat) -> Flat:
    name = next((key for key in _NUDGEABLE if isinstance(scene.get(key), float)), None)
    return {**scene, name: scene[name] * (1 + NUDGE)} if name else dict(scene)


_NUDGEABLE = ("time.end", f"{CONTACT}.compliance.stiffness", "heat.capacity")


def _other_settings(scene: Flat) -> Flat:
    """Another elimination order of the unknowns would be best; another Newton path is what the settings offer."""
    return {**scene, "solver.strategy": "newton-krylov"}
