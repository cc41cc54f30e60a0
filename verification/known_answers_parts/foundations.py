"""Foundations that move: a belt, a turning disc, and the heat of friction."""

import math
from typing import Any

import numpy as np

from known_answers_parts.blocks import EXACT, GRAVITY, friction, mass
from known_answers_parts.driver import Array, Driver, Run, height, width
from known_answers_parts.table import Row, largest, orders, relative

SAME_FORCE = 1e-10  # in two frames, of the friction
LAWS: tuple[tuple[str, dict[str, Any]], ...] = (("", {}), (", eps = 0", EXACT))
FORCES = ("contact_force_x", "contact_force_y", "inertia_force_x")  # N/m
ENERGIES = ("friction_dissipation", "strain_energy", "compliance_work", "kinetic_numerical_dissipation")


def belt_block(driver: Driver) -> list[Row]:
    rows = []
    variants: list[tuple[str, dict[str, Any]]] = [("", {}), (", eps = 0", {**EXACT, "time__steps": 60})]
    for name, settings in variants:
        # 1e-12 of rho w/k at 85 nodes would be up to 1e-9 N in their sum
        thrown = driver.run("sliding-block", solver__tolerance=1e-14, **settings)
        rows += taken_along(driver.run("belt-block", solver__tolerance=1e-14, **settings), thrown, name)
    return rows


def taken_along(run: Run, thrown: Run, name: str) -> list[Row]:
    """The block on the belt against the one that is thrown: the same in the belt's frame."""
    belt = -float(run.scene["boundary"]["bottom"]["contact"]["foundation_velocity"][0])
    drag = friction(run)[0] * mass(run.scene) * GRAVITY
    energy = 0.5 * mass(run.scene) * belt**2
    rows = []
    t, k = run.history["time"], run.scene["time"]["end"] / run.scene["time"]["steps"]
    slides = t < belt / (friction(run)[0] * GRAVITY) - k
    for force in FORCES:
        difference = run.history[force] - thrown.history[force]
        rows += [
            largest(f"{force} - that of the thrown block, N/m{name}", difference[slides], SAME_FORCE * drag),
            largest(f"the same, also at rest, N/m{name}", difference, round_off(thrown)),
        ]
    for term in ENERGIES:
        difference = run.history[term] - thrown.history[term]
        rows.append(largest(f"{term} - that of the thrown block, J/m{name}", difference, SAME_FORCE * energy))
    settled = (np.arange(len(t)) >= 19) & slides
    speed = run.history["velocity_l2"] / math.sqrt(width(run.scene) * height(run.scene))
    drift = (speed - friction(run)[0] * GRAVITY * t)[settled]
    total = float(np.sum(run.history["foundation_work"]))
    left = np.sum(run.history["load_work"]) + total - stored_and_lost(run)
    return [
        *rows,
        largest(f"velocity - mu g t, m/s{name}", drift, 1e-9 * belt),
        largest(f"sum of all energies / m V^2/2{name}", left / energy, 1e-9),
        # m dv/dt = friction, so that the belt does V (m V) of work, whatever the steps
        relative(f"work of the belt, J/m{name}", mass(run.scene) * belt**2, total, 1e-6),
    ]


def round_off(run: Run) -> float:
    """Of internal forces in a body displaced by d: products E d, each rounded to 2^-53, which a node has with itself and
    six neighbours, components apart, of trace, shear and its transpose (src/fem/plane_rows.h); their sum over N nodes
    grows with the root of their number, thrice that at most.
    """
    moved = float(np.abs(run.history["time"][-1] * run.scene["initial"]["velocity"][0])) / 2
    cells = run.scene["mesh"]["cells"]
    products = 3 * 2 * 2 * 7 * (cells[0] + 1) * (cells[1] + 1)
    return 3 * math.sqrt(products) * float(run.scene["material"]["elasticity"]["young"]) * moved * 2.0**-53


def stored_and_lost(run: Run) -> float:
    lost = (
        "friction_dissipation",
        "compliance_work",
        "kinetic_numerical_dissipation",
        "strain_numerical_dissipation",
    )
    stored = run.history["kinetic_energy"][-1] + run.history["strain_energy"][-1]
    return float(stored + sum(np.sum(run.history[name]) for name in lost))


def disc_torque(driver: Driver) -> list[Row]:
    rows = []
    for name, settings in LAWS:
        run = driver.run("disc-torque", **settings)
        contact = run.scene["boundary"]["bottom"]["contact"]
        bound = friction(run)[0] * contact["compliance"]["stiffness"] * -contact["gap"]
        x, z, weight = square(run.scene)
        radius = np.hypot(x, z)
        omega, k = 3.0, run.scene["time"]["end"] / run.scene["time"]["steps"]
        torque = bound * float(np.sum(weight * radius))
        resultant = bound * math.hypot(np.sum(weight * z / radius), np.sum(weight * x / radius))
        history = run.history
        share = contact["friction"]["heat_share"]
        rows += [
            relative(f"torque, N m{name}", torque, float(history["foundation_work"][-1]) / (k * omega), 1e-8),
            relative(
                f"resultant of friction, N{name}",
                resultant,
                run.final["contact"]["bottom"]["tangential_force"],
                1e-8,
            ),
            relative(
                f"heat of friction, W{name}",
                share * omega * torque,
                history["friction_heat_inflow"][-1],
                1e-8,
            ),
            *heat_of_dissipation(run, k, share, name),
        ]
    return rows


def heat_of_dissipation(run: Run, k: float, share: float, name: str) -> list[Row]:
    """What the heat balance receives is the share of what the momentum balance loses; without conduction it stays."""
    history = run.history
    lost = share * history["friction_dissipation"] / k
    return [
        largest(
            f"heat received - share of the dissipation, W{name}",
            history["friction_heat_inflow"] - lost,
            1e-12 * float(lost.max()),
        ),
        largest(
            f"heat received - heat stored, W{name}",
            history["friction_heat_inflow"] - history["heat_storage_rate"],
            1e-12 * float(lost.max()),
        ),
    ]


def square(scene: dict[str, Any]) -> tuple[Array, Array, Array]:
    """Points and weights on the lower side of a box, exact far beyond round-off for what is smooth there."""
    points, weights = np.polynomial.legendre.leggauss(40)
    lower, upper = scene["mesh"]["lower"], scene["mesh"]["upper"]
    sizes = [(upper[axis] - lower[axis]) / 2 for axis in (0, 2)]
    x, z = (lower[axis] + size * (1 + points) for axis, size in zip((0, 2), sizes))
    weight = sizes[0] * sizes[1] * np.outer(weights, weights)
    return np.repeat(x, len(z)), np.tile(z, len(x)), weight.ravel()


def friction_heat(driver: Driver) -> list[Row]:
    rows = []
    for name, settings in LAWS:
        run = driver.run("friction-heat", heat__capacity=1e-12, time__steps=1, **settings)
        q, conductivity = flux(run), float(run.scene["heat"]["conductivity"])
        body = run.body()
        exact = q * (height(run.scene) - body.points[:, 1]) / conductivity
        difference = body.point_data["temperature"] - exact
        rows.append(largest(f"steady temperature, K{name}", difference, 1e-9 * float(exact.max())))
    errors = []
    for cells in (50, 100, 200):
        run = driver.run("friction-heat", mesh__cells=[1, cells])
        errors.append(surface_temperature(run) - half_space_in_steps(run))
    n = run.scene["time"]["steps"]
    exact = half_space_in_steps(run) * (1 + 1 / (8 * n))
    return [
        *rows,
        *orders("surface temperature", 2.0, errors, 0.1),
        relative("half-space in steps, 1 + 1/(8n) times, K", half_space(run), float(exact), 1 / n**2),
        relative(
            "surface temperature at the end, K", half_space_in_steps(run), surface_temperature(run), 1e-3
        ),
    ]


def flux(run: Run) -> float:
    """Heat of friction that enters the body, W/m2."""
    contact = run.scene["boundary"]["bottom"]["contact"]
    pressure = contact["compliance"]["stiffness"] * -contact["gap"]
    power = contact["friction"]["coefficient"] * pressure * contact["foundation_velocity"][0]
    return float(contact["friction"]["heat_share"] * power)


def surface_temperature(run: Run) -> float:
    body = run.body()
    return float(body.point_data["temperature"][body.points[:, 1] == 0].mean())


def half_space(run: Run) -> float:
    heat, t = run.scene["heat"], run.scene["time"]["end"]
    return 2 * flux(run) * math.sqrt(t / (math.pi * heat["conductivity"] * heat["capacity"]))


def half_space_in_steps(run: Run) -> float:
    heat, n = run.scene["heat"], run.scene["time"]["steps"]
    k = run.scene["time"]["end"] / n
    growth = math.exp(math.lgamma(n + 0.5) - math.lgamma(1.5) - math.lgamma(n))
    return flux(run) * math.sqrt(k / (heat["conductivity"] * heat["capacity"])) * growth
