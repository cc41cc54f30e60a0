"""Rods that strike a foundation: contact pressure over time."""

import math

import numpy as np

from known_answers_parts.driver import Array, Driver, Run, width
from known_answers_parts.table import Row, largest, orders

QUARTILE = 0.6745  # of the normal distribution, in standard deviations


def pressure(run: Run) -> Array:
    """Mean contact pressure after each step, Pa."""
    force: Array = -run.history["contact_force_y"]
    return force / width(run.scene)


def impact_rate(run: Run) -> tuple[float, float]:
    """(Z v0, a = c_n/Z) of the free rod."""
    material = run.scene["material"]
    young, nu = material["elasticity"]["young"], material["elasticity"]["poisson"]
    modulus = young * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
    impedance = math.sqrt(material["density"] * modulus)
    stiffness = run.scene["boundary"]["bottom"]["contact"]["compliance"]["stiffness"]
    return -impedance * run.scene["initial"]["velocity"][1], stiffness / impedance


def impact_pressure(run: Run, t: Array) -> Array:
    plateau, rate = impact_rate(run)
    risen: Array = -np.expm1(-rate * t)
    return plateau * risen


def rod_impact(driver: Driver) -> list[Row]:
    rows, errors = [], []
    for k in (0.02, 0.01, 0.005):
        run = driver.run("rod-impact", time__step=k)
        plateau, rate = impact_rate(run)
        t = run.history["time"]
        steps = np.arange(1, len(t) + 1)
        time_discrete = plateau * (1 - (1 + rate * k) ** -steps)
        errors.append(float(np.max(np.abs(pressure(run) - impact_pressure(run, t)))))
        bound = plateau * rate * k / (2 * math.e)
        rows += [
            Row(f"largest error of the pressure, Pa, k = {k}", bound, errors[-1], 1.5 * rate * k * bound),
            largest(
                f"pressure - half-infinite rod in steps, Pa, k = {k}", pressure(run) - time_discrete, 1e-5
            ),
        ]
    return rows + orders("pressure", 1.0, errors, 0.05)


def signorini_run(driver: Driver, n: int) -> Run:
    """h = k = 1/n, and a foundation that reacts within k/5."""
    return driver.run(
        "rod-signorini",
        mesh__cells=[1, n],
        time__steps=3 * n,
        boundary__bottom__contact__compliance__stiffness=5.0 * n,
    )


def signorini_pressure(t: Array) -> Array:
    return np.where((t > 1) & (t < 2), 0.5, 0.0)


def rod_signorini(driver: Driver) -> list[Row]:
    rows, errors, ends, lost = [], [], [], []
    for n in (100, 200, 400):
        run = signorini_run(driver, n)
        t, p, k = run.history["time"], pressure(run), 1 / n
        above = t[p > 0.25]
        errors.append(k * float(np.sum(np.abs(p - signorini_pressure(t)))))
        ends.append(2 - float(above[-1]))
        lost.append(energy_lost(run))
        early = poisson_below(2 * n, 3 * n // 2)
        rows += [
            Row(f"start of contact, s, n = {n}", 1.0, float(above[0]), 2 * k),
            Row(f"end of contact, s, n = {n}", 2.0, float(above[-1]), QUARTILE * math.sqrt(2 * k) + 2 * k),
            Row(f"pressure at t = 3/2, Pa, n = {n}", 0.5, float(np.interp(1.5, t, p)), 1.5 * early + 1e-8),
        ]
    rows += orders("pressure in L1", 0.5, errors, 0.1) + orders("end of contact", 0.5, ends, 0.1)
    return rows + orders(f"energy lost (a share of {lost[-1]:.2f} at the last)", 0.5, lost, 0.1)


def poisson_below(mean: int, count: int) -> float:
    """The probability of at most count."""
    return math.fsum(math.exp(i * math.log(mean) - mean - math.lgamma(i + 1)) for i in range(count + 1))


def energy_lost(run: Run) -> float:
    """The exact rod has 1/8 of energy per area at every time; the discrete one at t = 3."""
    energy = run.history["kinetic_energy"][-1] + run.history["strain_energy"][-1]
    return float(1 - energy / width(run.scene) / 0.125)
