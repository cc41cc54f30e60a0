"""Blocks that stick, creep, slide and stop on a foundation with friction."""

import math
from typing import Any

import numpy as np

from known_answers_parts.driver import Driver, Run, height, width
from known_answers_parts.table import Row, largest, orders, relative

GRAVITY = 9.81  # m/s2, in the scenes
CREEP_TANGENT, SLIDE_TANGENT = 0.2, 0.5  # of the slopes in the scenes
EXACT = {"boundary__bottom__contact__friction__regularisation": 0.0}  # Coulomb's law itself


def mass(scene: dict[str, Any]) -> float:
    """kg per metre of depth."""
    return float(scene["material"]["density"]) * width(scene) * height(scene)


def friction(run: Run) -> tuple[float, float]:
    """(mu, eps)."""
    law = run.scene["boundary"]["bottom"]["contact"]["friction"]
    return float(law["coefficient"]), float(law["regularisation"])


def slope_creep(driver: Driver) -> list[Row]:
    run = driver.run("slope-creep")
    mu, epsilon = friction(run)
    ratio = CREEP_TANGENT / mu
    creep = epsilon * ratio / math.sqrt(1 - ratio**2)
    velocity = run.body().point_data["velocity"]
    angle = math.atan(CREEP_TANGENT)
    weight = mass(run.scene) * GRAVITY
    contact = run.final["contact"]["bottom"]
    return [
        largest("velocity along - creep, m/s, every node", velocity[:, 0] - creep, 1e-10 * creep),
        largest("velocity across, m/s, every node", velocity[:, 1], 1e-10 * creep),
        relative("tangential force, N/m", weight * math.sin(angle), contact["tangential_force"], 1e-10),
        relative("normal force, N/m", weight * math.cos(angle), contact["normal_force"], 1e-10),
        Row("share of the contact that slips faster than eps", 0.0, contact["slip_fraction"], 0.0),
        *rest_on_slope(driver, weight * math.sin(angle)),
    ]


def rest_on_slope(driver: Driver, pull: float) -> list[Row]:
    """Without regularisation nothing creeps."""
    run = driver.run("slope-creep", **EXACT)
    contact = run.final["contact"]["bottom"]
    speed_of_a_step = GRAVITY * run.scene["time"]["end"] / run.scene["time"]["steps"]
    velocity = run.body().point_data["velocity"]
    return [
        largest("velocity, eps = 0, m/s, every node", velocity, 1e-12 * speed_of_a_step),
        relative("tangential force, eps = 0, N/m", pull, contact["tangential_force"], 1e-10),
        Row("share of the contact that slips, eps = 0", 0.0, contact["slip_fraction"], 0.0),
    ]


def slope_slide(driver: Driver) -> list[Row]:
    run = driver.run("slope-slide")
    angle = math.atan(SLIDE_TANGENT)
    exact = GRAVITY * (math.sin(angle) - friction(run)[0] * math.cos(angle))
    found = run.history["inertia_force_x"][-1] / mass(run.scene)
    speed = run.history["velocity_l2"][-1] / math.sqrt(width(run.scene) * height(run.scene))
    return [
        relative("acceleration at the end, m/s2", exact, float(found), 1e-9),
        relative("velocity at the end, m/s", exact * run.scene["time"]["end"], float(speed), 1e-9),
        Row("share of the contact that slips", 1.0, run.final["contact"]["bottom"]["slip_fraction"], 1e-14),
    ]


def sliding_block(driver: Driver) -> list[Row]:
    rows, missing = [], []
    for steps in (60, 120, 240):
        run = driver.run("sliding-block", time__steps=steps)
        kinetic = kinetic_energy_at_first(run)
        missing.append(1 - float(np.sum(run.history["friction_dissipation"])) / kinetic)
        rows += stopping_rows(run, steps) + energy_rows(run, kinetic, missing[-1], steps)
    rows += exact_rest(driver)
    return rows + orders("energy that friction does not take", 1.0, missing, 0.05)


def exact_rest(driver: Driver) -> list[Row]:
    """Without regularisation the surface stops altogether, while the block's shear still dies out."""
    run = driver.run("sliding-block", time__steps=60, output__fields=["contact"], **EXACT)
    kinetic = kinetic_energy_at_first(run)
    slip = run.contact().point_data["slip_velocity"]
    start = float(run.scene["initial"]["velocity"][0])
    return [
        largest("slip velocity at the end, eps = 0, m/s, every node", slip, 1e-12 * start),
        Row(
            "share that slips at the end, eps = 0", 0.0, run.final["contact"]["bottom"]["slip_fraction"], 0.0
        ),
        largest("sum of all energies / kinetic at first, eps = 0", energy_sum(run, kinetic) / kinetic, 1e-9),
    ]


def kinetic_energy_at_first(run: Run) -> float:
    return 0.5 * mass(run.scene) * float(run.scene["initial"]["velocity"][0]) ** 2


def stopping_rows(run: Run, steps: int) -> list[Row]:
    start = float(run.scene["initial"]["velocity"][0])
    mu, epsilon = friction(run)
    k = run.scene["time"]["end"] / steps
    t = run.history["time"]
    speed = run.history["velocity_l2"] / math.sqrt(width(run.scene) * height(run.scene))
    stop = start / (mu * GRAVITY)
    settled = (np.arange(len(t)) >= 19) & (t < stop - k)
    drift = speed[settled] - (start - mu * GRAVITY * t[settled])
    stopped = t[speed < mu * GRAVITY * k / 2][0]
    return [
        largest(f"velocity - (v0 - mu g t), m/s, {steps} steps", drift, 1e-9 * start),
        Row(f"time of rest, s, {steps} steps", stop, float(stopped), k / 2),
        largest(f"velocity at the end, m/s, {steps} steps", speed[-1], epsilon),
    ]


def energy_rows(run: Run, kinetic: float, missing: float, steps: int) -> list[Row]:
    start = float(run.scene["initial"]["velocity"][0])
    k = run.scene["time"]["end"] / steps
    share = k * friction(run)[0] * GRAVITY / start
    return [
        Row(f"share that friction does not take, {steps} steps", share, missing, 1e-4 + share**2 / 4),
        largest(
            f"sum of all energies / kinetic at first, {steps} steps", energy_sum(run, kinetic) / kinetic, 1e-9
        ),
    ]


def energy_sum(run: Run, kinetic: float) -> float:
    """MODEL.md 6 added up over all steps: stored, dissipated and lost, less the work of the loads."""
    gained = (
        "kinetic_numerical_dissipation",
        "strain_numerical_dissipation",
        "compliance_work",
        "friction_dissipation",
    )
    total = sum(float(np.sum(run.history[name])) for name in gained)
    stored = float(run.history["kinetic_energy"][-1] + run.history["strain_energy"][-1]) - kinetic
    return stored + total - float(np.sum(run.history["load_work"]))
