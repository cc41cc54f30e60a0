"""Pictures of the error curves: against h and k, and against time."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from convergence_parts.errors import NORMS
from convergence_parts.report import curves, in_order
from convergence_parts.study import Series
from plotting.style import Album, panels

HEIGHT = 3.4  # inches
WIDTH = 3.6
LABELS = (r"$E_{hk}$", r"$\|w-w^{hk}\|_{L^2}$", r"$\|u-u^{hk}\|_V$", r"$\|\theta-\theta^{hk}\|_{L^2}$")
LOOKS: tuple[dict[str, Any], ...] = (
    {"color": "black", "marker": "o", "linewidth": 2.0},
    {"color": "#0072B2", "marker": "s", "linestyle": "--"},
    {"color": "#D55E00", "marker": "^", "linestyle": "-."},
    {"color": "#009E73", "marker": "D", "linestyle": ":"},
)
AXES = {
    "both": ("h + k", "h = k"),
    "space": ("h", "h alone, k = 1/{0}"),
    "time": ("k", "k alone, h = 1/{0}"),
}


def abscissa(series: Series) -> list[float]:
    return [(2.0 if series.mode == "both" else 1.0) / n for n in series.sizes]


def draw_error_curve(found: Sequence[Series], album: Album, name: str) -> None:
    """A row a scene, a column a way of refining."""
    scenes = list(dict.fromkeys(series.scene for series in found))
    modes = list(dict.fromkeys(series.mode for series in found))
    figure, grid = panels(len(scenes), len(modes), WIDTH, HEIGHT, sharey="row")
    for series in found:
        axes = grid[scenes.index(series.scene)][modes.index(series.mode)]
        draw_panel(axes, series)
    for row in grid:
        row[0].set_ylabel("error")
    handles, labels = grid[0][0].get_legend_handles_labels()
    grid[0][0].legend(handles, labels, fontsize=8)
    album.save(figure, name)


def draw_panel(axes: Any, series: Series) -> None:
    x = np.array(abscissa(series))
    values = list(curves(in_order(series.against_reference)).values())
    for label, look, line in zip(LABELS, LOOKS, values):
        axes.loglog(x, line, label=label, markersize=4, **look)
    axes.loglog(x, values[0][0] * 1.5 * x / x[0], color="#9e9e9e", linewidth=1.0, label="slope 1")
    name, refined = AXES[series.mode]
    axes.set_xlabel(name)
    axes.set_title(f"{series.scene}: {refined.format(series.reference)}")
    axes.set_xticks(x, [f"{'2' if series.mode == 'both' else '1'}/{n}" for n in series.sizes])
    axes.minorticks_off()


def draw_over_time(found: Sequence[Series], album: Album, name: str) -> None:
    """The three norms at the largest size against time: a row a scene, a column a variant."""
    scenes = list(dict.fromkeys(series.scene for series in found))
    variants = list(dict.fromkeys(series.variant for series in found))
    figure, grid = panels(len(scenes), len(variants), WIDTH, HEIGHT, sharey="row")
    for series in found:
        axes = grid[scenes.index(series.scene)][variants.index(series.variant)]
        n = max(series.sizes)
        history = series.against_reference[n]
        for label, look, line in zip(LABELS[1:], LOOKS[1:], history.norms().T):
            axes.semilogy(history.times[1:], line[1:], label=label, **{**look, "marker": ""})
        axes.set_title(f"{series.scene}, h = k = 1/{n}\n{series.variant}")
        axes.set_xlabel("t (s)")
    for row in grid:
        row[0].set_ylabel("error")
    grid[0][0].legend(fontsize=8)
    album.save(figure, name)
