"""Errors against resolution on logarithmic axes, each beside a line of the slope that theory gives it."""

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from manufactured_parts.report import WHAT
from manufactured_parts.study import SYMBOLS, Curve
from plotting.style import Album, panels

WIDTH, HEIGHT = 2.6, 3.0  # inches
LOOKS: dict[str, dict[str, Any]] = {
    "displacement": {"color": "#0072B2", "marker": "o"},
    "strain": {"color": "#0072B2", "marker": "s"},
    "velocity": {"color": "#D55E00", "marker": "o"},
    "temperature": {"color": "#009E73", "marker": "o"},
    "gradient": {"color": "#009E73", "marker": "s"},
}
DASHES = {1: "-", 2: "--"}  # by degree
THEORY = {"color": "#9e9e9e", "linewidth": 0.9, "zorder": 0}
APART = 1.3  # between sizes that are both written at the axis
SHOWN = "slipping"  # in the picture of all cells: it has all physics


def draw(curves: Sequence[Curve], album: Album, name: str) -> None:
    """A picture of all cells, a column each, and one of each cell, a column a case."""
    cases = list(dict.fromkeys(curve.case for curve in curves))
    shown = SHOWN if SHOWN in cases else cases[0]
    sheet(
        [c for c in curves if c.case == shown], lambda c: c.cell, lambda cell: f"{cell}, {shown}", album, name
    )
    for cell in dict.fromkeys(curve.cell for curve in curves):
        own = [curve for curve in curves if curve.cell == cell]
        sheet(own, lambda c: c.case, str, album, f"{name}-{cell}")


def sheet(
    curves: Sequence[Curve],
    column_of: Callable[[Curve], str],
    title: Callable[[str], str],
    album: Album,
    name: str,
) -> None:
    """A row for h and one for k with each scheme."""
    columns = list(dict.fromkeys(map(column_of, curves)))
    rows = list(dict.fromkeys((curve.study, curve.scheme) for curve in curves))
    figure, grid = panels(len(rows), len(columns), WIDTH, HEIGHT, sharey="row")
    for axes_of_row, (study, scheme) in zip(grid, rows):
        axes_of_row[0].set_ylabel(f"error, {'h alone' if study == 'space' else f'k alone, {scheme}'}")
        for axes, column in zip(axes_of_row, columns):
            chosen = [c for c in curves if (c.study, c.scheme, column_of(c)) == (study, scheme, column)]
            for curve in chosen:
                line(axes, curve)
            axes.set_title(title(column))
            axes.set_xlabel(WHAT[study])
            ticks(axes, chosen)
    legend(figure, grid, curves)
    album.save(figure, name)


def line(axes: Any, curve: Curve) -> None:
    x, y = 1 / np.array(curve.sizes), np.array(curve.errors)
    axes.loglog(x, y, markersize=3.5, linewidth=1.2, linestyle=DASHES[curve.degree], **LOOKS[curve.norm])
    axes.loglog(x, 1.25 * y[0] * (x / x[0]) ** curve.theory, **THEORY)


def ticks(axes: Any, curves: Sequence[Curve]) -> None:
    kept: list[int] = []
    for size in sorted({size for curve in curves for size in curve.sizes}):
        if not kept or size >= APART * kept[-1]:
            kept.append(size)
    axes.set_xticks([1 / size for size in kept], [f"1/{size}" for size in kept], fontsize=7)
    axes.minorticks_off()


def legend(figure: Any, grid: Any, curves: Sequence[Curve]) -> None:
    """One for all panels, below them."""
    axes, shown = grid[0][0], {curve.norm for curve in curves}
    handles = [
        axes.plot([], [], label=SYMBOLS[norm].replace("theta", "θ"), **look)[0]
        for norm, look in LOOKS.items()
        if norm in shown
    ]
    for degree in sorted({curve.degree for curve in curves}):
        handles += axes.plot([], [], color="black", linestyle=DASHES[degree], label=f"degree {degree}")
    handles += axes.plot([], [], label="slope of theory", **THEORY)
    columns = min(len(handles), 2 * len(grid[0]))
    height = 0.1 / len(grid) * math.ceil(len(handles) / columns)
    figure.get_layout_engine().set(rect=(0, height, 1, 1 - height))
    figure.legend(handles=handles, loc="lower center", ncol=columns, fontsize=8)
