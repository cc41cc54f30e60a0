"""What is compared: the paper's scheme at two resolutions, others that aim at its error, and the reference."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

SIDES = ("left", "right", "bottom", "top")
Settings = Mapping[str, Any]


@dataclass(frozen=True)
class Configuration:
    name: str
    settings: Settings
    steps: int  # of the scene, each a multiple of which is an output

    def all_settings(self, outputs: int) -> Settings:
        return {**self.settings, "time.steps": self.steps, "output.every": max(1, self.steps // outputs)}


@dataclass(frozen=True)
class Plan:
    outputs: int  # common times
    paper: Mapping[int, Configuration]  # by n = 1/h = 1/k
    others: tuple[Configuration, ...]
    interactive: tuple[Configuration, ...]  # judged at the end alone
    reference: Configuration
    coarser_in_space: tuple[Configuration, Configuration]  # by 2 and by 4, nested in the reference
    coarser_in_time: tuple[
        Configuration, Configuration
    ]  # of the first of these, 10 and 100 times its tolerance


def paper(n: int) -> Configuration:
    return Configuration(f"paper, 1/{n}", {"mesh.cells": [n, n]}, n)


def uniform(name: str, n: int, steps: int, **settings: Any) -> Configuration:
    return Configuration(name, {"mesh.cells": [n, n], **keys(settings)}, steps)


def graded(
    cells: tuple[int, int], ratios: tuple[float, ...], steps: int, cell: str = "tensor", **settings: Any
) -> Configuration:
    """Degree 2 on a mesh with these ratios at SIDES. Its name says all."""
    kind = "Q2" if cell == "tensor" else "P2"
    scheme = {"bdf2": "bdf2", "generalized-alpha": "gen.-alpha"}.get(settings.get("scheme", ""), "b. Euler")
    time = f"{steps} steps" if "tolerance" not in settings else f"adaptive, {settings['tolerance']:g}"
    mesh = {f"mesh.grading.{side}": ratio for side, ratio in zip(SIDES, ratios)}
    if tolerance := settings.get("solver__tolerance"):
        time += f", Newton {tolerance:g}"
    at = ", ".join(f"{ratio:g}" for ratio in ratios)
    return Configuration(
        f"{kind} {cells[0]} x {cells[1]} graded ({at}), {scheme} {time}",
        {"mesh.cells": list(cells), "mesh.cell": cell, **mesh, "space.degree": 2, **keys(settings)},
        steps,
    )


def keys(settings: Mapping[str, Any]) -> Settings:
    """Those of [time] by their last part alone, others with __ for the dots."""
    return {name.replace("__", ".") if "__" in name else f"time.{name}": of for name, of in settings.items()}


def halved(of: Configuration, by: int) -> Configuration:
    cells = [count // by for count in of.settings["mesh.cells"]]
    return replace(of, name=f"{of.name}, mesh coarser by {by}", settings={**of.settings, "mesh.cells": cells})


def looser(of: Configuration, by: float) -> Configuration:
    tolerance = by * of.settings["time.tolerance"]
    name = f"{of.name}, tolerance {by:g} times"
    return replace(of, name=name, settings={**of.settings, "time.tolerance": tolerance})


CORNERS = (10.0, 10.0, 8.0, 40.0)


def others(outputs: int) -> tuple[Configuration, ...]:
    euler: dict[str, Any] = {"tolerance": 0.1}
    bdf2: dict[str, Any] = {"scheme": "bdf2"}
    loose: dict[str, Any] = {"solver__tolerance": 1e-6}
    low, high = (6, 6, 8, 20), (6, 6, 10, 20)
    return (
        uniform("paper's mesh 64, bdf2", 64, outputs, **bdf2),
        uniform("paper's mesh 64, b. Euler adaptive, 0.1", 64, outputs, **euler),
        uniform("P2 16 x 16 uniform, b. Euler adaptive, 0.1", 16, outputs, **euler, space__degree=2),
        graded((16, 12), (10, 10, 8, 20), outputs, "simplex", **euler),
        graded((8, 6), low, outputs, **bdf2),
        graded((8, 6), low, outputs, **bdf2, **loose),
        graded((8, 6), low, outputs, **bdf2, solver__tolerance=1e-3),
        graded((7, 6), (6, 8, 8, 20), outputs, **bdf2, solver__tolerance=1e-3),
        graded((8, 6), low, outputs, "simplex", **bdf2, **loose),
        graded((10, 6), (4, 4, 8, 20), outputs, "simplex", **bdf2, **loose),
        graded((10, 6), high, outputs, **bdf2, **loose),
        graded((8, 6), low, 2 * outputs, **bdf2, **loose),
        graded((10, 6), high, 2 * outputs, **bdf2, **loose),
        graded((8, 6), low, outputs, **euler, **loose),
        graded((10, 6), high, outputs, **euler, **loose),
        graded((12, 8), low, outputs, **euler),
        graded((12, 8), low, outputs, **euler, **loose),
        graded((12, 8), low, outputs, **euler, solver__tolerance=1e-3),
        graded((12, 8), low, 2 * outputs, **bdf2, solver__tolerance=1e-3),
        graded((12, 10), low, outputs, **euler, **loose),
        graded((14, 10), CORNERS, outputs, **euler, **loose),
        graded((16, 12), CORNERS, outputs, **euler, **loose),
        graded((24, 18), (6, 6, 8, 40), outputs, **bdf2, tolerance=1e-2),
    )


def interactive() -> tuple[Configuration, ...]:
    loose: dict[str, Any] = {"scheme": "bdf2", "solver__tolerance": 1e-6}
    return (
        graded((10, 6), (6, 6, 10, 20), 16, **loose),
        graded((10, 6), (6, 6, 10, 20), 32, **loose),
        graded((10, 6), (6, 6, 10, 20), 64, **loose),
        graded((12, 8), (6, 6, 8, 20), 32, **loose),
        graded((12, 8), (6, 6, 8, 20), 64, **loose),
        graded((24, 18), (10, 10, 16, 80), 64, **loose),
        graded((16, 12), (10, 10, 8, 40), 32, **loose),
        graded((32, 24), (10, 10, 16, 80), 128, **loose),
    )


def plan() -> Plan:
    outputs = 64
    best = graded((192, 64), (4, 4, 8, 40), 2 * outputs, scheme="bdf2", tolerance=1e-4)
    return Plan(
        outputs,
        {n: paper(n) for n in (64, 128)},
        others(outputs),
        interactive(),
        best,
        (halved(best, 2), halved(best, 4)),
        (looser(halved(best, 2), 10), looser(halved(best, 2), 100)),
    )


def small_plan() -> Plan:
    """The same kinds of runs, for the machinery alone."""
    outputs = 16
    best = graded((16, 12), CORNERS, 2 * outputs, scheme="bdf2", tolerance=1e-3)
    return Plan(
        outputs,
        {n: paper(n) for n in (16, 32)},
        (graded((8, 6), (6, 6, 8, 20), outputs, tolerance=0.1), uniform("P1 8", 8, outputs)),
        (graded((8, 6), (6, 6, 8, 20), 8, scheme="bdf2"),),
        best,
        (halved(best, 2), halved(best, 4)),
        (looser(halved(best, 2), 10), looser(halved(best, 2), 100)),
    )
