"""The designed set of configurations: each knob turned alone from one base, and some bargains of several."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

EPSILON = "boundary.{side}.contact.friction.regularisation"


@dataclass(frozen=True)
class Configuration:
    """`value` places it on its knob: the error is expected to fall with value^order."""

    knob: str
    value: float
    settings: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Scene:
    """What the plan must know of a scene."""

    sides: tuple[str, ...]  # with friction
    epsilon: float
    coupled: bool  # momentum and heat


def cells(count: int) -> dict[str, Any]:
    return {"mesh.cells": [count, count]}


def epsilons(scene: Scene, factor: float) -> dict[str, Any]:
    return {EPSILON.format(side=side): factor * scene.epsilon for side in scene.sides}


def base(scene: Scene) -> dict[str, Any]:
    """Where all knobs stand that are not turned."""
    return {**cells(32), "time.steps": 128, "time.scheme": "bdf2", "solver.strategy": "condensed"}


def reference(scene: Scene, count: int) -> dict[str, Any]:
    """Beyond every configuration in all that errs; its own error is bounded by halves()."""
    finest = {
        **base(scene),
        **cells(count),
        "space.degree": 2,
        "time.steps": 32 * count,
        **epsilons(scene, 0.01),
    }
    return finest | ({"time.coupling": "iterated"} if scene.coupled else {})


def halves(scene: Scene, count: int) -> dict[str, dict[str, Any]]:
    """The reference with one source of error made larger at a time, by name."""
    coarser = {"space": cells(count // 2), "time": {"time.steps": 16 * count}}
    if scene.sides:
        coarser["regularisation"] = epsilons(scene, 0.1)
    return {name: {**reference(scene, count), **settings} for name, settings in coarser.items()}


ORDERS = {
    "step": 1,
    "step, bdf2": 2,
    "mesh": 2,
    "mesh, degree 2": 3,
    "epsilon": 1,
    "tolerance": 2 / 3,
    "newton": 1,
}


def plan(scene: Scene) -> Iterator[Configuration]:
    for steps in (16, 32, 64, 128, 256, 512):
        yield Configuration("step", 1 / steps, {"time.scheme": "backward-euler", "time.steps": steps})
        yield Configuration("step, bdf2", 1 / steps, {"time.steps": steps})
    for tolerance in (1e-2, 1e-3, 1e-4, 1e-5):
        yield Configuration("tolerance", tolerance, {"time.steps": 8, "time.tolerance": tolerance})
    for count in (8, 16, 32, 64):
        yield Configuration("mesh", 1 / count, cells(count))
    for count in (8, 16):
        yield Configuration("mesh, degree 2", 1 / count, {**cells(count), "space.degree": 2})
    for factor in (100.0, 10.0, 1.0, 0.1) if scene.sides else ():
        yield Configuration("epsilon", factor * scene.epsilon, epsilons(scene, factor))
    for tolerance in (1e-3, 1e-5, 1e-7, 1e-9):
        yield Configuration("newton", tolerance, {"solver.tolerance": tolerance})
    for coupling in ("lagged", "iterated") if scene.coupled else ():
        yield Configuration(f"coupling {coupling}", 1.0, {"time.coupling": coupling})
    yield Configuration("newton-krylov", 1.0, {"solver.strategy": "newton-krylov"})
    for count in (8, 16, 32, 64):
        paper = {**cells(count), "time.steps": count, "time.scheme": "backward-euler"}
        yield Configuration("paper's choice", 1 / count, paper)
    for count, tolerance in ((8, 1e-2), (8, 1e-3), (16, 1e-3), (16, 1e-4)):
        bargain = {**cells(count), "space.degree": 2, "time.steps": 8, "time.tolerance": tolerance}
        yield Configuration("degree 2, adaptive", tolerance, {**bargain, **epsilons(scene, 0.1)})
