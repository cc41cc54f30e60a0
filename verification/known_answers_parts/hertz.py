"""Hertz's line contact: pressure of a parabola on a half-plane."""

import math
from typing import Any

import numpy as np

from known_answers_parts.driver import Array, Driver, Run, width
from known_answers_parts.table import Row, orders, relative

RADIUS = 100.0  # m, of the gap x^2/(2 R) in the scene
LINE_LOAD = 5.0 * math.pi / 2  # N/m, of the tractions in the scene


def exact_values(scene: dict[str, Any]) -> tuple[float, float]:
    """(half-width, peak pressure)."""
    elasticity = scene["material"]["elasticity"]
    modulus = elasticity["young"] / (1 - elasticity["poisson"] ** 2)
    half_width = math.sqrt(4 * LINE_LOAD * RADIUS / (math.pi * modulus))
    return half_width, 2 * LINE_LOAD / (math.pi * half_width)


def exact_profile(scene: dict[str, Any], x: Array) -> Array:
    half_width, peak = exact_values(scene)
    ellipse: Array = np.sqrt(np.maximum(1 - (x / half_width) ** 2, 0.0))
    return peak * ellipse


def profile(run: Run) -> tuple[Array, Array]:
    """Node positions and pressures, from the axis outwards."""
    contact = run.contact()
    x, first = np.unique(contact.points[:, 0], return_index=True)
    return x, contact.point_data["pressure"][first]


def half_width_of(x: Array, p: Array) -> float:
    """By the mean distance of the pressure from the axis, which is 4 a/(3 pi)."""
    return float(np.trapz(p * x, x) / np.trapz(p, x) * 3 * math.pi / 4)


def profile_error(run: Run) -> float:
    """Root mean square over the exact half-width, relative to the peak."""
    x, p = profile(run)
    half_width, peak = exact_values(run.scene)
    near = x < 1.5 * half_width
    squares = np.trapz((p[near] - exact_profile(run.scene, x[near])) ** 2, x[near])
    return math.sqrt(squares / half_width) / peak


def hertz_run(driver: Driver, cells: int, stiffness: float) -> Run:
    return driver.run(
        "hertz", mesh__cells=[cells, cells], boundary__bottom__contact__compliance__stiffness=stiffness
    )


def hertz(driver: Driver) -> list[Row]:
    rows: list[Row] = []
    by_mesh = [hertz_run(driver, cells, 1e7) for cells in (24, 48, 96)]
    for run in by_mesh:
        rows += size_rows(run, f"{run.scene['mesh']['cells'][0]} cells")
    rows += orders("profile in the mean square, h", 1.0, [profile_error(run) for run in by_mesh], 0.25)
    widths = []
    for stiffness in (5e3, 1e4, 2e4):
        run = hertz_run(driver, 96, stiffness)
        rows += size_rows(run, f"c_n = {stiffness:.0e}")
        widths.append(half_width_of(*profile(run)) - exact_values(run.scene)[0])
    return rows + orders("half-width, 1/c_n", 1.0, widths, 0.15)


def size_rows(run: Run, name: str) -> list[Row]:
    half_width, peak = exact_values(run.scene)
    elasticity = run.scene["material"]["elasticity"]
    modulus = elasticity["young"] / (1 - elasticity["poisson"] ** 2)
    stiffness = run.scene["boundary"]["bottom"]["contact"]["compliance"]["stiffness"]
    h = width(run.scene) / run.scene["mesh"]["cells"][0] / half_width
    common = modulus / (2 * stiffness * half_width) + (half_width / width(run.scene)) ** 4
    x, p = profile(run)
    force = 2 * run.final["contact"]["bottom"]["normal_force"]
    return [
        relative(f"load, N/m, {name}", LINE_LOAD, force, (h * half_width / width(run.scene)) ** 4),
        relative(f"half-width, m, {name}", half_width, half_width_of(x, p), 0.1 * h + common),
        relative(f"peak pressure, Pa, {name}", peak, float(p[0]), h**2 / 2 + common),
    ]
