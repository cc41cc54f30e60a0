"""One picture of the answers that are curves: rods that strike a foundation, and Hertz's pressure."""

from pathlib import Path
from typing import Any

import numpy as np

from known_answers_parts import hertz, rods
from known_answers_parts.driver import Array, Driver
from plotting import style

EXACT = {"color": "black", "linewidth": 1.0, "zorder": 3}


def draw(driver: Driver, path: Path) -> None:
    """Write the picture; its name must end in .png."""
    with style.styled():
        figure, axes = style.panels(1, 3, 3.5, 3.0)
        impact(driver, axes[0, 0])
        signorini(driver, axes[0, 1])
        line_contact(driver, axes[0, 2])
        style.Album(path.parent, small=True).save(figure, path.stem)


def impact(driver: Driver, axes: Any) -> None:
    for curve, k in zip(style.CURVES, (0.1, 0.01)):
        run = driver.run("rod-impact", time__step=k)
        axes.plot(run.history["time"], rods.pressure(run), label=f"k = {k} s", **curve)
    axes.plot(run.history["time"], rods.impact_pressure(run, run.history["time"]), label="exact", **EXACT)
    decorate(axes, "Free rod, compliant foundation", "time (s)")


def signorini(driver: Driver, axes: Any) -> None:
    for curve, n in zip(style.CURVES, (100, 400)):
        run = rods.signorini_run(driver, n)
        axes.plot(run.history["time"], rods.pressure(run), label=f"h = k = 1/{n}", **curve)
    t: Array = np.array([0.0, 1.0, 1.0, 2.0, 2.0, 3.0])
    axes.plot(t, [0.0, 0.0, 0.5, 0.5, 0.0, 0.0], label="exact", **EXACT)
    axes.set_ylim(top=0.72)  # room for the legend
    decorate(axes, "Signorini's rod, stiff foundation", "time (s)")


def line_contact(driver: Driver, axes: Any) -> None:
    for curve, stiffness in zip(style.CURVES, (5e3, 1e7)):
        run = hertz.hertz_run(driver, 96, stiffness)
        x, p = hertz.profile(run)
        near = x < 1.4
        axes.plot(x[near], p[near], label=rf"$c_n$ = {stiffness:.0e} Pa/m", **curve)
    fine: Array = np.linspace(0, 1.4, 400)
    axes.plot(fine, hertz.exact_profile(run.scene, fine), label="exact", **EXACT)
    decorate(axes, "Line contact of Hertz", "distance from the axis (m)")


def decorate(axes: Any, title: str, abscissa: str) -> None:
    axes.set_title(title)
    axes.set_xlabel(abscissa)
    axes.set_ylabel("pressure (Pa)")
    axes.legend(fontsize=8)
