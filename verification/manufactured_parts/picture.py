"""Errors against resolution on logarithmic axes, each beside a line of the slope that theory gives it."""

from collections.abc import Sequence
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


def draw(curves: Sequence[Curve], album: Album, name: str) -> None:
    """A picture a cell and scheme: a row a study, a column a case."""
    for cell, scheme in dict.fromkeys((curve.cell, curve.scheme) for curve in curves):
        chosen = [curve for curve in curves if (curve.cell, curve.scheme) == (cell, scheme)]
        cases = list(dict.fromkeys(curve.case for curve in chosen))
        studies = list(dict.fromkeys(curve.study for curve in chosen))
        figure, grid = panels(len(studies), len(cases), WIDTH, HEIGHT, sharey="row")
        for curve in chosen:
            line(grid[studies.index(curve.study)][cases.index(curve.case)], curve)
        for row, study in zip(grid, studies):
            row[0].set_ylabel(f"error, {'h alone' if study == 'space' else f'k alone, {scheme}'}")
            for axes, case in zip(row, cases):
                axes.set_title(case)
                axes.set_xlabel(WHAT[study])
                ticks(axes, [curve for curve in chosen if curve.study == study])
        legend(figure, grid, chosen)
        album.save(figure, f"{name}-{cell}-{scheme}")


def line(axes: Any, curve: Curve) -> None:
    x, y = 1 / np.array(curve.sizes), np.array(curve.errors)
    axes.loglog(x, y, markersize=3.5, linewidth=1.2, linestyle=DASHES[curve.degree], **LOOKS[curve.norm])
    axes.loglog(x, 1.25 * y[0] * (x / x[0]) ** curve.theory, **THEORY)


def ticks(axes: Any, curves: Sequence[Curve]) -> None:
    sizes = sorted({size for curve in curves for size in curve.sizes})[::-1]
    axes.set_xticks([1 / size for size in sizes], [f"1/{size}" for size in sizes], fontsize=7)
    axes.minorticks_off()


def legend(figure: Any, grid: Any, curves: Sequence[Curve]) -> None:
    """One for all panels, below them."""
    axes = grid[0][0]
    handles = [
        axes.plot([], [], label=SYMBOLS[norm].replace("theta", "θ"), **look)[0]
        for norm, look in LOOKS.items()
    ]
    for degree in sorted({curve.degree for curve in curves}):
        handles += axes.plot([], [], color="black", linestyle=DASHES[degree], label=f"degree {degree}")
    handles += axes.plot([], [], label="slope of theory", **THEORY)
    figure.get_layout_engine().set(rect=(0, 0.05, 1, 0.95))
    figure.legend(handles=handles, loc="lower center", ncol=len(handles), fontsize=8)
