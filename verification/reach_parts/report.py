"""The study as CSV, as tables of Markdown and as a picture."""

import csv
import json
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from lattice_errors import NORMS
from plotting.style import Album, panels, styled
from reach_parts.measure import Point, Study, best

GOAL = 20.0  # times faster than the paper's scheme
INTERACTIVE = 0.01, 0.020  # of each norm at T, in seconds of stepping
SYMBOLS = (
    r"$\Vert w - w^{hk}\Vert_{L^2}$ (m$^2$/s)",
    r"$\Vert \varepsilon(u - u^{hk})\Vert_{L^2}$ (m)",
    r"$\Vert \theta - \theta^{hk}\Vert_{L^2}$ (K m)",
)
TITLES = ("velocity", "deformation", "temperature")
PAPER, OTHER, BEST = "#D55E00", "#7f7f7f", "#0072B2"


def write(study: Study, folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / "reach.csv").open("w", encoding="ascii", newline="") as file:
        table = csv.writer(file)
        table.writerow(
            ("configuration", *NORMS, "e_hk", "seconds", "seconds_of_steps", "seconds_of_process", "settings")
        )
        for point in [*study.paper.values(), *study.others]:
            time = point.seconds
            settings = json.dumps(point.of.all_settings(study.plan.outputs))
            table.writerow(
                (point.of.name, *point.norms, point.e_hk, time.counted, time.steps, time.process, settings)
            )
    (folder / "reach.md").write_text(markdown(study), encoding="utf-8")


def markdown(study: Study) -> str:
    return "\n".join(
        [*_reference(study), "", *_reached(study), "", *_all(study), "", *_interactive(study), ""]
    )


def _numbers(values: Iterable[float]) -> list[str]:
    return [f"{value:.2e}" for value in values]


def _row(cells: Sequence[str]) -> str:
    return "| " + " | ".join(cells) + " |"


def _head(cells: Sequence[str]) -> list[str]:
    return [_row(cells), _row(["---"] * len(cells))]


def _reference(study: Study) -> list[str]:
    lines = [
        f"Reference: {study.plan.reference.name}, {study.plan.reference.steps} outputs. Bounds of its error:",
        "",
    ]
    lines += _head(["norm", "the solution's largest", "in space", "in time", "sum"])
    for name, size, total in zip(NORMS, study.found.sizes, study.found.resolved):
        parts = [f"{of.value:.1e}" + ("" if of.sure else " (estimate)") for of in study.found.bounds[name]]
        lines.append(_row([name, f"{size:.2e}", *parts, f"{total:.1e}"]))
    return lines


def _reached(study: Study) -> list[str]:
    lines = _head(["error of", "configuration", "w", "ε(u)", "θ", "seconds", "times faster", "whole process"])
    for n, paper in study.paper.items():
        at = paper.seconds
        lines.append(
            _row(
                [
                    f"1/{n}",
                    "the paper's",
                    *_numbers(paper.norms),
                    f"{at.counted:.3g}",
                    "1",
                    f"{at.process:.3g}",
                ]
            )
        )
        found = {sure: best(study, n, sure) for sure in (False, True)}
        for sure, point in found.items():
            if point is None:
                lines.append(_row(["", "none of those tried" + (" surely" if sure else ""), *[""] * 6]))
            elif not sure or point is not found[False]:
                time = point.seconds
                cells = [f"{time.counted:.3g}", f"{at.counted / time.counted:.1f}", f"{time.process:.3g}"]
                name = point.of.name + (", surely" if point is found[True] else "")
                lines.append(_row(["", name, *_numbers(point.norms), *cells]))
    for n, value in study.found.own_times.items():
        lines += [
            "",
            f"E_hk of the paper's scheme at 1/{n}: {study.paper[n].e_hk:.3e} over the common times,",
        ]
        lines.append(f"{value:.3e} over all times that it shares with the reference.")
    return lines


def _all(study: Study) -> list[str]:
    lines = _head(["configuration", "w", "ε(u)", "θ", "E_hk", "seconds"])
    for point in [*study.paper.values(), *study.others]:
        numbers = _numbers([*point.norms, point.e_hk])
        lines.append(_row([point.of.name, *numbers, f"{point.seconds.counted:.3g}"]))
    return lines


def _interactive(study: Study) -> list[str]:
    lines = ["At T: of each norm, the error and the difference of the norms (%); stepping time.", ""]
    lines += _head(["configuration", "w", "ε(u)", "θ", "‖w‖", "‖ε(u)‖", "‖θ‖", "ms of steps"])
    for found in study.interactive:
        shares = [f"{100 * value:.2g}" for value in (*found.errors, *found.norms)]
        lines.append(_row([found.of.name, *shares, f"{1e3 * found.seconds.steps:.1f}"]))
    return lines


def verdicts(study: Study) -> list[str]:
    """What was asked for, and whether it was reached."""
    lines = []
    for n, paper in study.paper.items():
        for sure in (False, True):
            point = best(study, n, sure)
            how = "surely " if sure else ""
            if point is None:
                lines.append(f"1/{n}: none of those tried is {how}as near in all three norms")
                continue
            factor = paper.seconds.counted / point.seconds.counted
            said = "reached" if factor >= GOAL else "not reached"
            lines.append(f"1/{n}: {how}{point.of.name}: {factor:.1f} times faster; {GOAL:g} times {said}")
    share, limit = INTERACTIVE
    for what in ("errors", "norms"):
        able = [found for found in study.interactive if np.all(getattr(found, what) <= share)]
        fastest = min(able, key=lambda found: found.seconds.steps, default=None)
        name = "error" if what == "errors" else "norms"
        if fastest is None:
            lines.append(f"interactive, {name} to {share:.0%} at T: none of those tried")
        else:
            said = "reached" if fastest.seconds.steps <= limit else "not reached"
            time = f"{1e3 * fastest.seconds.steps:.1f} ms of steps"
            lines.append(
                f"interactive, {name} to {share:.0%} at T: {fastest.of.name}: {time}; {limit:g} s {said}"
            )
    return lines


def draw(study: Study, folder: Path, small: bool) -> list[Path]:
    album = Album(folder, small)
    chosen = {n: best(study, n) for n in study.paper}
    with styled():
        figure, grid = panels(1, 3, 4.3, 4.4)
        for at, axes in enumerate(grid[0]):
            _panel(axes, study, at, chosen)
        album.save(figure, "reach")
    return album.written


def _panel(axes: Any, study: Study, at: int, chosen: dict[int, Point | None]) -> None:
    names = {id(point): f"for 1/{n}" for n, point in chosen.items() if point}
    for point in study.others:
        colour = BEST if id(point) in names else OTHER
        axes.loglog(point.seconds.counted, point.norms[at], "o", color=colour, markersize=5)
    for n, found in chosen.items():
        if found:
            _label(axes, found, at, f"for 1/{n}", BEST)
    for n, point in study.paper.items():
        x, y = point.seconds.counted, point.norms[at]
        axes.loglog(x, y, "s", color=PAPER, markersize=7)
        _label(axes, point, at, f"paper, 1/{n}", PAPER)
        axes.loglog([x / GOAL, x / GOAL, x], [y / 3, y, y], color=PAPER, linewidth=0.8, linestyle=":")
        axes.annotate(
            f"1/{GOAL:g} of 1/{n}'s time", (x / GOAL, y / 3), (0, -3), fontsize=8, color=PAPER,
            textcoords="offset points", ha="center", va="top",
        )  # fmt: skip
    axes.axhline(study.found.resolved[at], color="black", linewidth=0.8, linestyle="--")
    axes.annotate("bound of the reference's error", (0.02, study.found.resolved[at]), (0, 3), fontsize=8,
                  xycoords=("axes fraction", "data"), textcoords="offset points")  # fmt: skip
    axes.set_xlabel("setup, factorisations and steps (s)")
    times = [point.seconds.counted for point in study.paper.values()]
    axes.set_xlim(min(times) / GOAL / 4, 6 * max(times))  # room for the words
    axes.set_ylim(study.found.resolved[at] / 2, 2 * max(point.norms[at] for point in study.paper.values()))
    axes.set_title(f"{TITLES[at]}, largest over {study.plan.outputs} times")
    axes.set_ylabel(SYMBOLS[at])
    axes.grid(True, which="major", color="#d9d9d9", linewidth=0.7)
    axes.set_axisbelow(True)


def _label(axes: Any, point: Point, at: int, text: str, colour: str) -> None:
    where = (point.seconds.counted, point.norms[at])
    axes.annotate(text, where, (4, 5), textcoords="offset points", color=colour, fontsize=9)
