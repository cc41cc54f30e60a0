"""Heat given to the air, and made by strain that changes."""

import math

import numpy as np

from known_answers_parts.driver import Driver, Run, height, width
from known_answers_parts.exact import ROUND_OFF, spaces
from known_answers_parts.table import Row, largest, orders, relative


def convection_slab(driver: Driver) -> list[Row]:
    rows = []
    for name, settings in spaces():
        run = driver.run("convection-slab", **settings)
        air = run.scene["boundary"]["bottom"]["convection"]
        conductivity = run.scene["heat"]["conductivity"]
        resistance = height(run.scene) / conductivity + 1 / air["coefficient"]
        q = (run.scene["boundary"]["top"]["temperature"] - air["ambient_temperature"]) / resistance
        found = float(run.history["convection_heat_outflow"][-1]) / width(run.scene)
        body = run.body()
        exact = air["ambient_temperature"] + q / air["coefficient"] + q * body.points[:, 1] / conductivity
        difference = body.point_data["temperature"] - exact
        rows += [
            relative(f"heat flow, W/m2, {name}", q, found, ROUND_OFF),
            largest(f"temperature, K, {name}", difference, ROUND_OFF * float(np.max(exact))),
        ]
    return rows


def cooling_slab(driver: Driver) -> list[Row]:
    rows, errors = [], []
    for steps in (20, 40, 80):
        run = driver.run("cooling-slab", time__steps=steps)
        air = run.scene["boundary"]["bottom"]["convection"]
        rate = air["coefficient"] / (run.scene["heat"]["capacity"] * height(run.scene))
        above = run.body().point_data["temperature"] - air["ambient_temperature"]
        end, start = (
            run.scene["time"]["end"],
            run.scene["initial"]["temperature"] - air["ambient_temperature"],
        )
        in_steps = start * (1 + rate * end / steps) ** -steps
        bound = air["coefficient"] * height(run.scene) / run.scene["heat"]["conductivity"] * start
        rows.append(largest(f"temperature - that in steps, K, {steps} steps", above - in_steps, bound))
        errors.append(float(above.mean()) - start * math.exp(-rate * end))
    return rows + orders("temperature of the cooling slab", 1.0, errors, 0.05)


def stretched_bar(driver: Driver) -> list[Row]:
    rows = []
    for name, settings in spaces():
        rows += bar_rows(driver.run("stretched-bar", **settings), name, 0)
    for scheme in ("bdf2", "midpoint", "generalized-alpha"):
        rows += temperature_rows(driver.run("stretched-bar", time__scheme=scheme), scheme, 0)
    return rows + temperature_rows(driver.run("stretched-bar", time__coupling="lagged"), "lagged", 1)


def strain_at_end(run: Run) -> float:
    return 0.004 / width(run.scene) * float(run.scene["time"]["end"])


def temperature_rows(run: Run, name: str, late: int) -> list[Row]:
    """`late`: by how many steps of strain the temperature lags behind."""
    heat, steps = run.scene["heat"], run.scene["time"]["steps"]
    nu = run.scene["material"]["elasticity"]["poisson"]
    exact = heat["strain_rate_heating"] * (1 - nu) * strain_at_end(run) / heat["capacity"]
    exact *= (steps - late) / steps
    theta = run.body().point_data["temperature"]
    return [largest(f"temperature - {exact:.4g}, K, {name}", theta - exact, 1e-10 * abs(exact))]


def bar_rows(run: Run, name: str, late: int) -> list[Row]:
    young = run.scene["material"]["elasticity"]["young"]
    steps, area = run.scene["time"]["steps"], width(run.scene) * height(run.scene)
    strains = strain_at_end(run) * np.arange(1, steps + 1) / steps
    work = young * strains * strains[0] * area
    velocity = run.body().point_data["velocity"][:, 0]
    speed = strain_at_end(run) / run.scene["time"]["end"] * run.body().points[:, 0]
    return [
        *temperature_rows(run, name, late),
        largest(f"velocity x - that of the stretch, m/s, {name}", velocity - speed, 1e-10 * speed.max()),
        largest(
            f"work of the clamp a step, J/m, {name}", run.history["reaction_work"] - work, 1e-10 * work.max()
        ),
        relative(
            f"strain energy at the end, J/m, {name}",
            0.5 * young * strains[-1] ** 2 * area,
            float(run.history["strain_energy"][-1]),
            1e-10,
        ),
    ]
