"""Curves over time: forces, shares in contact and slipping, peak slip velocity, largest penetration."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from plotting.contact import HEIGHT, SLIP, curves
from plotting.results import Array
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
    for component, width in (("x", 1.0), ("y", 2.2)):
        label = f"{component}, {case.label}"
        axes.plot(history["time"], history[f"contact_force_{component}"], label=label, **look, lw=width)


def shares(axes: Any, case: Case, history: dict[str, Array], look: dict[str, str]) -> None:
    for name, column, width in (("closed", "contact_fraction", 2.4), ("slipping", "slip_fraction", 1.0)):
        label = f"{name}, {case.label}"
        axes.plot(history["time"], 100.0 * history[column], label=label, **look, lw=width)


def penetration(axes: Any, case: Case, history: dict[str, Array], look: dict[str, str]) -> None:
    axes.plot(history["time"], history["max_penetration"], **look)


def peak_slip(axes: Any, case: Case, history: dict[str, Array], look: dict[str, str]) -> None:
    peaks = np.zeros(len(case.results.steps))
    for boundary in case.results.contact_names:
        for at, curve in enumerate(curves(case, boundary, [SLIP])):
            closed = np.abs(SLIP.of(curve))[~curve.is_open]
            peaks[at] = max(peaks[at], float(closed.max(initial=0.0)))
    axes.plot([time for time, _ in case.results.steps][1:], peaks[1:], **look)


PANELS: tuple[tuple[str, str, Plot], ...] = (
    ("Force of the body on the foundation", "force (N/m)", forces),
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
    histories = [case.results.history(COLUMNS) for case in cases]
    for axes, (title, label, plot) in zip(grid.flat, PANELS):
        for case, history, look in zip(cases, histories, CURVES):
            plot(axes, case, history, look)
        axes.set_title(title)
        axes.set_ylabel(label)
        if axes.get_legend_handles_labels()[0]:
            legend_above_curves(axes)
    for axes in grid[-1]:
        axes.set_xlabel("t (s)")
    figure.suptitle("Contact over time")
    album.save(figure, "contact-history")
