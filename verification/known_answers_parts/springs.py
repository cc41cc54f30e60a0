"""Blocks on springs: one that swings, and one that is drawn over a foundation."""

import math
from collections.abc import Sequence

import numpy as np

from known_answers_parts.blocks import mass
from known_answers_parts.driver import Array, Driver, Run, height, width
from known_answers_parts.table import Row, largest, orders, relative

GAINED = ("kinetic_energy", "spring_energy", "strain_energy")
LOST = (
    "kinetic_numerical_dissipation",
    "spring_numerical_dissipation",
    "strain_numerical_dissipation",
    "friction_dissipation",
    "compliance_work",
)


def stiffness(run: Run, side: str) -> float:
    """K, N/m a metre of depth."""
    return float(run.scene["boundary"][side]["spring"]["stiffness"][0][0]) * height(run.scene)


def give(run: Run, side: str) -> float:
    """K L/(E H): how much the body gives way beside the spring."""
    young = float(run.scene["material"]["elasticity"]["young"])
    return stiffness(run, side) * width(run.scene) / (young * height(run.scene))


def total(run: Run, names: Sequence[str]) -> Array:
    """The sum of these columns, row by row."""
    return np.sum([run.history[name] for name in names], axis=0)


def oscillator(driver: Driver) -> list[Row]:
    rows = []
    for scheme in ("midpoint", "backward-euler"):
        run = driver.run("oscillator", time__scheme=scheme)
        K, m = stiffness(run, "left"), mass(run.scene)
        k = run.scene["time"]["end"] / run.scene["time"]["steps"]
        w, start = math.sqrt(K / m), float(run.scene["initial"]["velocity"][0])
        turn = 1j * w * k
        euler = 1 / (1 - turn)  # the first step of every scheme, which has no rate to begin with
        factor = (1 + turn / 2) / (1 - turn / 2) if scheme == "midpoint" else euler
        z = start * euler * factor ** np.arange(len(run.history["time"]))
        near = (w * run.scene["time"]["end"] / 6 + 0.5) * give(run, "left")
        energy = 0.5 * m * start**2
        lost, kept = np.cumsum(total(run, LOST)), total(run, GAINED)
        # of an energy, the square of an amplitude, twice as much
        rows += [
            largest(
                f"spring's energy - exact, J/m, {scheme}",
                run.history["spring_energy"] - 0.5 * m * z.imag**2,
                2 * near * energy,
            ),
            largest(
                f"kinetic energy - exact, J/m, {scheme}",
                run.history["kinetic_energy"] - 0.5 * m * z.real**2,
                2 * near * energy,
            ),
            largest(f"energy kept and lost - that at first, {scheme}", (kept + lost) / energy - 1, 1e-9),
            force_row(run, z, scheme, near),
        ]
        if scheme == "midpoint":
            after_first = (lost[1:] - lost[0]) / energy
            rows.append(largest("energy that midpoint loses after its first step, of all", after_first, 1e-9))
    return rows


def force_row(run: Run, z: Array, scheme: str, near: float) -> Row:
    """The force K u at the stage: the end of a step of backward Euler, of midpoint the middle of its displacements."""
    K, m = stiffness(run, "left"), mass(run.scene)
    u = np.concatenate([[0.0], z.imag]) / math.sqrt(K / m)
    stage = u[1:].copy()
    if scheme == "midpoint":
        stage[1:] = (u[2:] + u[1:-1]) / 2
    difference = run.history["spring_force_x"] - K * stage
    return largest(f"spring's force - exact, N/m, {scheme}", difference, near * K * float(np.abs(u).max()))


def drawn_block(driver: Driver) -> list[Row]:
    rows: list[Row] = []
    errors = []
    for steps in (240, 480, 960):
        run = driver.run("drawn-block", time__steps=steps)
        exact, speed = drawn_force(run), drawn_speed(run)
        t, drag = run.history["time"], friction_bound(run)
        stuck = t < slide_begins(run) + 1e-9
        difference = -run.history["spring_force_x"] - exact
        found = run.history["velocity_l2"] / math.sqrt(width(run.scene) * height(run.scene))
        settled = t > slide_begins(run) / 5
        errors.append(float(np.max(np.abs(difference[~stuck]))))
        late, near, V = lateness(run, steps), rocking(run) + give(run, "right"), pull_speed(run)
        w = math.sqrt(stiffness(run, "right") / mass(run.scene))
        rows += [
            largest(f"force while it sticks - K V t, N/m, {steps} steps", difference[stuck], near * drag),
            largest(f"speed while it sticks, m/s, {steps} steps", found[stuck & settled], 2 * near * V),
            largest(f"force - exact, N/m, {steps} steps", difference, late * stiffness(run, "right") * V / w),
            largest(f"speed - exact, m/s, {steps} steps", (found - speed)[settled], late * V),
            *energy_rows(run, exact, late, steps),
        ]
    return rows + orders("force", 2.0, errors, 0.1)


def lateness(run: Run, steps: int) -> float:
    """The phase that BDF2 has lost at the end, w (T - t1) (wk)^2/3."""
    w, end = math.sqrt(stiffness(run, "right") / mass(run.scene)), run.scene["time"]["end"]
    return float(w * (end - slide_begins(run)) * (w * end / steps) ** 2 / 3)


def rocking(run: Run) -> float:
    """3 K H^2/(c_n L^3): the spring at half the height turns the block upon its foundation."""
    c_n = float(run.scene["boundary"]["bottom"]["contact"]["compliance"]["stiffness"])
    return 3 * stiffness(run, "right") * height(run.scene) ** 2 / (c_n * width(run.scene) ** 3)


def pull_speed(run: Run) -> float:
    """V of the anchor "V*t"."""
    return float(run.scene["boundary"]["right"]["spring"]["anchor"][0].removesuffix("*t"))


def friction_bound(run: Run) -> float:
    weight = -float(run.scene["load"]["body_force"][1]) * width(run.scene) * height(run.scene)
    return float(run.scene["boundary"]["bottom"]["contact"]["friction"]["coefficient"]) * weight


def slide_begins(run: Run) -> float:
    return friction_bound(run) / (stiffness(run, "right") * pull_speed(run))


def drawn_force(run: Run) -> Array:
    K, V, t = stiffness(run, "right"), pull_speed(run), run.history["time"]
    w, since = math.sqrt(K / mass(run.scene)), t - slide_begins(run)
    return np.where(since < 0, K * V * t, friction_bound(run) + K * V / w * np.sin(w * since))


def drawn_speed(run: Run) -> Array:
    since = run.history["time"] - slide_begins(run)
    w = math.sqrt(stiffness(run, "right") / mass(run.scene))
    return np.where(since < 0, 0.0, pull_speed(run) * (1 - np.cos(w * since)))


def energy_rows(run: Run, force: Array, late: float, steps: int) -> list[Row]:
    """BDF2 takes the force at the end of each step, so that its work is a sum; no error of the force exceeds `late`."""
    K, V = stiffness(run, "right"), pull_speed(run)
    work = np.cumsum(run.history["anchor_work"])
    lost, kept = np.cumsum(total(run, LOST) - run.history["load_work"]), total(run, GAINED)
    k = run.scene["time"]["end"] / steps
    exact = V * k * np.cumsum(force)
    return [
        largest(f"work of the far end - V sum(k F), of all, {steps} steps", (work - exact) / exact[-1], late),
        relative(
            f"spring's energy at the end, J/m, {steps} steps",
            float(force[-1] ** 2) / (2 * K),
            float(run.history["spring_energy"][-1]),
            2 * late,
        ),
        largest(f"sum of all energies / work, {steps} steps", (kept + lost - work) / work[-1], 1e-9),
    ]
