"""Curves over time: forces, shares in contact and slipping, peak slip velocity, largest penetration."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from plotting.contact import HEIGHT
from plotting.results import Array, Unusable
from plotting.style import CURVES, PANEL, Album, Case, panels

COLUMNS = (
    "time",
    "contact_force_x",
    "contact_force_y",
    "contact_fraction",
    "slip_fraction",
    "max_penetration",
)
HEADROOM = 0.3  # of the range of the curves, for the legend
Plot = Callable[[Any, Case, dict[str, Array], dict[str, str]], None]


def forces(axes: Any, case: Case, history: dict[str, Array], look: dict[str, str]) -> None:
    for component, width in (("x", 1.0), ("y", 2.2), ("z", 3.4)):
        column = f"contact_force_{component}"
        if column in history:
            axes.plot(history["time"], history[column], label=f"{component}, {case.label}", **look, lw=width)


def shares(axes: Any, case: Case, history: dict[str, Array], look: dict[str, str]) -> None:
    for name, column, width in (("closed", "contact_fraction", 2.4), ("slipping", "slip_fraction", 1.0)):
        label = f"{name}, {case.label}"
        axes.plot(history["time"], 100.0 * history[column], label=label, **look, lw=width)


def penetration(axes: Any, case: Case, history: dict[str, Array], look: dict[str, str]) -> None:
    axes.plot(history["time"], history["max_penetration"], **look)


def peak_slip(axes: Any, case: Case, history: dict[str, Array], look: dict[str, str]) -> None:
    peaks = np.zeros(len(case.results.steps))
    for at, grid in enumerate(case.results.contact_grids):
        if "slip_velocity" not in grid.point_data:
            raise Unusable(f"{case.results.directory}: no field 'slip_velocity' on the contact boundary")
        speeds = np.linalg.norm(grid.point_data["slip_velocity"], axis=1)
        peaks[at] = speeds[grid.point_data["gap"] <= 0.0].max(initial=0.0)
    axes.plot([time for time, _ in case.results.steps][1:], peaks[1:], **look)


PANELS: tuple[tuple[str, str, Plot], ...] = (
    ("Force of the body on the foundation", "force (N)", forces),
    ("Share of the boundary closed, slipping", "share (%)", shares),
    ("Largest slip velocity where closed", "velocity (m/s)", peak_slip),
    ("Largest penetration", "penetration (m)", penetration),
)


def legend_above_curves(axes: Any) -> None:
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + HEADROOM * (high - low))
    axes.legend(loc="upper right", fontsize=8, ncol=2)


def draw_history(cases: Sequence[Case], album: Album) -> None:
    figure, grid = panels(2, 2, PANEL, HEIGHT, sharex=True)
    solid = not all(case.results.contact_is_curve for case in cases)
    columns = (*COLUMNS, "contact_force_z") if solid else COLUMNS
    histories = [case.results.history(columns) for case in cases]
    for axes, (title, label, plot) in zip(grid.flat, PANELS):
        for case, history, look in zip(cases, histories, CURVES):
            plot(axes, case, history, look)
        axes.set_title(title)
        axes.set_ylabel(label if solid else label.replace("(N)", "(N/m)"))
        if axes.get_legend_handles_labels()[0]:
            legend_above_curves(axes)
    for axes in grid[-1]:
        axes.set_xlabel("t (s)")
    figure.suptitle("Contact over time")
    album.save(figure, "contact-history")


def spring_force(axes: Any, case: Case, history: dict[str, Array], look: dict[str, str]) -> None:
    for component, width in (("x", 1.2), ("y", 2.4)):
        force = history[f"spring_force_{component}"]
        if np.any(force != 0.0):
            axes.plot(history["time"], force, label=f"{component}, {case.label}", **look, lw=width)


def draw_springs(cases: Sequence[Case], album: Album) -> None:
    """What springs take of a body that sticks and slips."""
    wanted: tuple[tuple[str, str, Plot], ...] = (
        ("Force of the body on its springs", "force (N/m)", spring_force),
        ("Largest slip velocity where closed", "velocity (m/s)", peak_slip),
    )
    figure, grid = panels(1, 2, PANEL, HEIGHT, sharex=True)
    histories = [case.results.history(("time", "spring_force_x", "spring_force_y")) for case in cases]
    for axes, (title, label, plot) in zip(grid.flat, wanted):
        for case, history, look in zip(cases, histories, CURVES):
            plot(axes, case, history, look)
        axes.set_title(title)
        axes.set_ylabel(label)
        axes.set_xlabel("t (s)")
    if len(cases) > 1:
        legend_above_curves(grid[0, 0])
    album.save(figure, "spring-history")
