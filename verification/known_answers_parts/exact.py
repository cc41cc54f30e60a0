"""Patch tests: the answer lies in the discrete space, so that only round-off is left."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from known_answers_parts.driver import Driver, height, width
from known_answers_parts.table import Row, largest, relative

ROUND_OFF = 1e-11  # relative, derived in the scenes


def spaces() -> Iterator[tuple[str, dict[str, Any]]]:
    for diagonal in ("right", "left", "crossed"):
        for degree in (1, 2):
            yield f"{diagonal}, degree {degree}", {"mesh__diagonal": diagonal, "space__degree": degree}


def conductance_slab(driver: Driver) -> list[Row]:
    rows = []
    for name, settings in spaces():
        run = driver.run("conductance-slab", **settings)
        rows += slab_rows(run.scene, run.final, 1.0, name)
        contact = run.scene["boundary"]["bottom"]["contact"]["conductance"]
        q = run.final["contact"]["bottom"]["heat_flow"] / width(run.scene)
        exact = contact["foundation_temperature"] + q / contact["coefficient"]
        exact = exact + q * run.body().points[:, 1] / run.scene["heat"]["conductivity"]
        theta = run.body().point_data["temperature"]
        rows.append(largest(f"temperature, K, {name}", theta - exact, ROUND_OFF * float(np.max(exact))))
    partial = driver.run("conductance-slab", boundary__bottom__contact__gap=-0.25e-5)
    return rows + slab_rows(partial.scene, partial.final, 0.25, "quarter of the onset")


def slab_rows(scene: dict[str, Any], final: dict[str, Any], closure: float, name: str) -> list[Row]:
    """Resistances in series; closure is the share of the onset that the penetration has reached, 1 at most."""
    law = scene["boundary"]["bottom"]["contact"]["conductance"]
    resistance = height(scene) / scene["heat"]["conductivity"] + 1 / (closure * law["coefficient"])
    exact = (scene["boundary"]["top"]["temperature"] - law["foundation_temperature"]) / resistance
    flow = final["contact"]["bottom"]["heat_flow"] / width(scene)
    return [relative(f"heat flow, W/m2, {name}", exact, flow, ROUND_OFF)]


def column(driver: Driver) -> list[Row]:
    rows = []
    for name, settings in spaces():
        run = driver.run("column", **settings)
        law = run.scene["boundary"]["bottom"]["contact"]
        load = -run.scene["boundary"]["top"]["traction"][1]
        young = run.scene["material"]["elasticity"]["young"]
        poisson = run.scene["material"]["elasticity"]["poisson"]
        depth = load / law["compliance"]["stiffness"]
        x, y = run.body().points[:, 0], run.body().points[:, 1]
        exact_x = poisson * (1 + poisson) * load / young * x
        exact_y = -(depth + law["gap"]) - (1 - poisson**2) * load / young * y
        found = run.body().point_data["displacement"]
        scale = ROUND_OFF * float(np.max(np.abs(exact_y)))
        stress = run.body().cell_data["stress"][:, [0, 1, 3]] + load * np.array([0.0, 1.0, 0.0])
        penetration = run.final["contact"]["bottom"]["max_penetration"]
        rows += [
            largest(
                f"pressure - p, Pa, {name}", run.contact().point_data["pressure"] - load, ROUND_OFF * load
            ),
            relative(f"penetration, m, {name}", depth, penetration, ROUND_OFF),
            largest(f"displacement x, m, {name}", found[:, 0] - exact_x, scale),
            largest(f"displacement y, m, {name}", found[:, 1] - exact_y, scale),
            largest(f"stress xx, yy, xy, Pa, {name}", stress, ROUND_OFF * load),
        ]
    return rows
