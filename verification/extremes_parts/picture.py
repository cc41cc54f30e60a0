"""Maps of the pairs: parameter against parameter, coloured by outcome, with retries and Newton's iterations written in."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from matplotlib.patches import Patch, Rectangle

from extremes_parts.judge import BAD, COMPLETED, STOPPED
from extremes_parts.parameters import PAIRS
from extremes_parts.report import Row
from plotting.style import Album, panels, styled

COLUMNS = 4
WIDTH, HEIGHT = 2.9, 2.7  # inches a map
RETRIED = "completed after retries"
COLOURS = {COMPLETED: "#a6dba0", RETRIED: "#56b4e9", STOPPED: "#f6c26b", BAD: "#d55e00"}


def draw(rows: Sequence[Row], folder: Path, small: bool) -> None:
    maps = [pair for pair in PAIRS if any(names(row) == pair for row in rows)]
    if not maps:
        return
    with styled():
        save(maps, rows, Album(folder, small))


def save(maps: Sequence[tuple[str, str]], rows: Sequence[Row], album: Album) -> None:
    lines = -(-len(maps) // COLUMNS)
    figure, grid = panels(lines, min(COLUMNS, len(maps)), WIDTH, HEIGHT)
    places = [axes for line in grid for axes in line]
    for axes, pair in zip(places, maps):
        one_map(axes, pair, [row for row in rows if names(row) == pair])
    for axes in places[len(maps) :]:
        axes.axis("off")
    figure.get_layout_engine().set(rect=(0, 0.05, 1, 0.91))
    figure.suptitle(
        "Parameter against parameter: outcome, Newton's iterations of all steps, retries (SI units)"
    )
    handles = [Patch(color=colour, label=outcome) for outcome, colour in COLOURS.items()]
    figure.legend(handles=handles, loc="lower center", ncol=len(handles), fontsize=9)
    album.save(figure, "extremes")


def names(row: Row) -> tuple[str, ...]:
    return tuple(name for name, _ in row.case.values) if row.case.group == "pair" else ()


def outcome(row: Row) -> str:
    retried = row.verdict.outcome == COMPLETED and row.verdict.retries > 0
    return RETRIED if retried else row.verdict.outcome


def one_map(axes: Any, pair: tuple[str, str], rows: Sequence[Row]) -> None:
    across = sorted({row.case.values[0][1] for row in rows})
    upward = sorted({row.case.values[1][1] for row in rows})
    for row in rows:
        (_, x), (_, y) = row.case.values
        i, j = across.index(x), upward.index(y)
        axes.add_patch(Rectangle((i, j), 1, 1, facecolor=COLOURS[outcome(row)], edgecolor="white"))
        axes.text(i + 0.5, j + 0.5, text(row), ha="center", va="center", fontsize=7)
    axes.set_xlim(0, len(across))
    axes.set_ylim(0, len(upward))
    axes.set_xticks([i + 0.5 for i in range(len(across))], [f"{value:.5g}" for value in across], fontsize=7)
    axes.set_yticks([j + 0.5 for j in range(len(upward))], [f"{value:.3g}" for value in upward], fontsize=7)
    axes.tick_params(length=0)
    axes.set_xlabel(pair[0])
    axes.set_ylabel(pair[1])


def text(row: Row) -> str:
    """Newton's iterations in all, and below them the retries."""
    retries = f"\n{row.verdict.retries} retries" if row.verdict.retries else ""
    return f"{row.verdict.iterations}{retries}"
