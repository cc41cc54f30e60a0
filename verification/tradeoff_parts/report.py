"""What the measured configurations say: the Pareto front, prices, the picture."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from plotting.style import FULL_DPI, panels, styled
from tradeoff_parts.plan import ORDERS, Configuration

MARKS = "os^vD<>pPX*hd"


@dataclass(frozen=True)
class Point:
    configuration: Configuration
    error: float  # to the reference
    own: float  # to the finest value of the knob
    seconds: float


def front(points: Sequence[Point]) -> list[Point]:
    """Those than which none is both faster and more accurate, by their time."""
    best: list[Point] = []
    for point in sorted(points, key=lambda point: (point.seconds, point.error)):
        if not best or point.error < best[-1].error:
            best.append(point)
    return best


def by_knob(points: Sequence[Point]) -> dict[str, list[Point]]:
    """Each knob's points, the crudest first."""
    knobs: dict[str, list[Point]] = {}
    for point in points:
        knobs.setdefault(point.configuration.knob, []).append(point)
    return {knob: sorted(of, key=lambda point: -point.configuration.value) for knob, of in knobs.items()}


def prices(points: Sequence[Point]) -> list[str]:
    """Of each knob: the order of its own error, the theory's, and the factor in time that a digit of it costs."""
    lines = []
    for knob, of in by_knob(points).items():
        # the finest value stands for the exact one: those near it seem better than they are
        usable = [
            point
            for point in of
            if point.own > 0 and point.configuration.value >= 4 * of[-1].configuration.value
        ][-3:]
        if len(usable) < 2:
            continue
        first, last = usable[0], usable[-1]
        digits = math.log10(first.own / last.own)
        if digits < 0.1:
            lines.append(f"{knob}: turning it from {first.own:.1e} on buys no more accuracy")
            continue
        order = digits / math.log10(first.configuration.value / last.configuration.value)
        price = (last.seconds / first.seconds) ** (1 / digits)
        theory = f" (theory {ORDERS[knob]:.2g})" if knob in ORDERS else ""
        lines.append(f"{knob}: a digit more costs a factor {price:.2g} in time; order {order:.2f}{theory}")
    return lines


def draw(points: Sequence[Point], bound: float, title: str, file: Path) -> None:
    with styled():
        figure, axes = panels(1, 1, 7.5, 5.0)
        axis = axes[0, 0]
        for number, (knob, of) in enumerate(by_knob(points).items()):
            at = [point.seconds for point in of], [point.error for point in of]
            wide = {"linewidth": 2.4, "color": "black"} if knob == "paper's choice" else {"linewidth": 0.8}
            axis.loglog(*at, marker=MARKS[number % len(MARKS)], markersize=5, label=knob, **wide)
        best = front(points)
        axis.step(
            [point.seconds for point in best],
            [point.error for point in best],
            where="post",
            color="#D55E00",
            linewidth=2.0,
            label="Pareto front",
        )
        axis.axhline(bound, color="#bdbdbd", linestyle=":", label="error of the reference")
        axis.set_xlabel("assembly, factorisations and steps (s)")
        axis.set_ylabel("largest relative error")
        axis.set_title(title)
        axis.legend(fontsize=7, ncol=2)
        figure.savefig(file, dpi=FULL_DPI)
