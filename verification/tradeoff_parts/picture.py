"""The work-precision plot of one scene: the whole error of every configuration, and each knob's own beside it."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from plotting.style import Album, panels, styled
from tradeoff_parts.measure import Point
from tradeoff_parts.plan import BARGAIN, DEFAULT, FACTOR, PAPER, STRATEGY
from tradeoff_parts.prices import RESOLVED, by_knob, front, own_error
from tradeoff_parts.tables import Study

FAMILIES: tuple[tuple[str, tuple[str, ...], str], ...] = (  # of knobs: how their names begin, colours, marks
    ("step", ("#08306b", "#2171b5", "#4fa3d9", "#8fc9ee"), "osDv"),
    ("tolerance", ("#b36b00", "#f0a500", "#7a5200", "#ffd166"), "^>v<"),
    ("mesh", ("#00441b", "#238b45", "#74c476"), "sDP"),
    ("degree", ("#238b45",), "D"),
    ("epsilon", ("#e7298a",), "X"),
    ("exact Coulomb", ("#980043",), "*"),
    ("contact quadrature", ("#7b4fa3",), "p"),
    ("Newton", ("#b5b500",), "h"),
    ("coupling", ("#8c564b",), "d"),
    ("lagged", ("#525252", "#8a8a8a", "#b0b0b0", "#d0d0d0"), "<>^v"),
    ("strategy", ("#17becf",), "H"),
    ("precision", ("#0e7480",), "8"),
    ("bargains", ("#cb181d",), "P"),
)
FRONT = "#D55E00"
LEGEND = 0.2  # of the height
LEAST_SHOWN = 1e-6  # of own errors, in the picture


def draw(study: Study, folder: Path, small: bool) -> list[Path]:
    album = Album(folder, small)
    with styled():
        figure, grid = panels(1, 2, 5.4, 5.6)
        whole, own = grid[0]
        looks = looks_of(study)
        configurations(whole, study, looks)
        front_of(whole, study.points)
        below_reference(whole, study)
        own_errors(own, study, looks)
        for axes in (whole, own):
            axes.set_xlabel("setup, factorisations and steps (s)")
            axes.grid(True, which="major", color="#d9d9d9", linewidth=0.7)
            axes.set_axisbelow(True)
        whole.set_ylabel("largest relative error")
        whole.set_title(f"{study.facts.name}: error of each configuration")
        own.set_title("the part of it that the knob is there for")
        handles, labels = legend(whole, own)
        figure.get_layout_engine().set(rect=(0, LEGEND, 1, 1 - LEGEND))
        figure.legend(handles, labels, loc="lower center", ncols=4, fontsize=8.5)
        album.save(figure, "tradeoff")
    return album.written


def looks_of(study: Study) -> dict[str, dict[str, Any]]:
    """A mark and a colour for every knob, the same in the pictures of all scenes."""
    looks: dict[str, dict[str, Any]] = {}
    for begin, colours, marks in FAMILIES:
        members = [name for name in study.knobs if name.startswith(begin)]
        for at, name in enumerate(members):
            colour, mark = colours[at % len(colours)], marks[at % len(marks)]
            looks[name] = {"color": colour, "marker": mark, "markersize": 6}
    looks[PAPER] = {"color": "black", "marker": "o", "markersize": 6.5}
    looks[DEFAULT] = {"color": "black", "marker": "*", "markersize": 16, "linestyle": ""}
    return looks


def legend(*panels_of: Any) -> tuple[list[Any], list[str]]:
    found: dict[str, Any] = {}
    for axes in panels_of:
        handles, labels = axes.get_legend_handles_labels()
        found |= {label: handle for handle, label in zip(handles, labels) if label not in found}
    return list(found.values()), list(found)


def configurations(axes: Any, study: Study, looks: dict[str, dict[str, Any]]) -> None:
    found = by_knob(study.points)
    for name in (name for name in study.knobs if name in found):
        x, y = zip(*((point.seconds.total, point.error.largest) for point in found[name]))
        wide = 2.0 if name == PAPER else 0.0 if name == BARGAIN else 0.6
        above = 5 if name == DEFAULT else 4 if name == PAPER else 3
        axes.loglog(x, y, label=name, zorder=above, **{"linewidth": wide, **looks[name]})
        near = [point for point in found[name] if not point.told]
        hollow = {**looks[name], "linestyle": "", "markerfacecolor": "white", "zorder": above}
        axes.loglog([of.seconds.total for of in near], [of.error.largest for of in near], **hollow)
    if PAPER in found:
        finest = found[PAPER][-1]
        named(axes, PAPER, (finest.seconds.total, finest.error.largest), (9, 3))
    for point in found.get(DEFAULT, []):
        named(axes, DEFAULT, (point.seconds.total, point.error.largest), (12, 10))


def named(axes: Any, text: str, at: tuple[float, float], offset: tuple[int, int]) -> None:
    behind = {"boxstyle": "round,pad=0.15", "facecolor": "white", "edgecolor": "none", "alpha": 0.85}
    how = {"fontsize": 9, "fontweight": "bold", "bbox": behind, "zorder": 6}
    axes.annotate(text, at, xytext=offset, textcoords="offset points", **how)


def front_of(axes: Any, points: Sequence[Point]) -> None:
    best = front(points)
    if best:
        x, y = zip(*((point.seconds.total, point.error.largest) for point in best))
        axes.step(x, y, where="post", color=FRONT, linewidth=4, alpha=0.55, label="Pareto front", zorder=2)


def below_reference(axes: Any, study: Study) -> None:
    low, high = axes.get_ylim()
    low = min(low, study.bound / 1.3) / 1.5  # room for the words
    axes.set_ylim(low, 1.5 * high)
    axes.axhspan(low, study.bound, color="#e6e6e6", zorder=0)
    axes.axhline(study.bound, color="#6e6e6e", linestyle="--", linewidth=1.2, zorder=1)
    words = {"fontsize": 8.5, "color": "#3d3d3d", "va": "bottom", "transform": axes.get_yaxis_transform()}
    said = f"grey: the reference's own error, at most {study.bound:.1e}; hollow: less than 3 times it"
    axes.text(0.01, 1.03 * low, said, **words)


def own_errors(axes: Any, study: Study, looks: dict[str, dict[str, Any]]) -> None:
    for name, points in by_knob(study.points).items():
        knob = study.knobs[name]
        if knob.source is None or name in (STRATEGY, FACTOR):
            continue
        errors = [(point.seconds.total, own_error(point, knob).largest) for point in points]
        shown = [(time, error) for time, error in errors if error > max(LEAST_SHOWN, RESOLVED)]
        if shown:
            x, y = zip(*shown)
            axes.loglog(x, y, label=name, linewidth=1.1, **looks[name])
    axes.set_ylabel("relative error of one source")
