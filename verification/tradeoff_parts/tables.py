"""The study as tables: tradeoff.csv, prices.csv and the text that is printed."""

import csv
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from tradeoff_parts.bounds import Bound
from tradeoff_parts.choice import SOURCES
from tradeoff_parts.facts import Facts
from tradeoff_parts.measure import Lost, Point
from tradeoff_parts.plan import Knob
from tradeoff_parts.prices import NAMES, Price, below_theory, front

COLUMNS = (
    (
        "knob",
        "value",
        "status",
        "error",
        "error_w",
        "error_strain",
        "error_theta",
        "told_from_reference",
        "on_front",
    )
    + tuple(f"own_{source}" for source in SOURCES)
    + ("seconds", "seconds_setup", "seconds_factor", "seconds_steps", "rounds", "settings")
)
PRICES = (
    "knob",
    "points",
    "from_error",
    "to_error",
    "from_seconds",
    "to_seconds",
    "factor_per_digit",
) + tuple(f"{what}_{norm}" for norm in ("w", "strain", "theta") for what in ("order", "theory"))


@dataclass(frozen=True)
class Study:
    facts: Facts
    reference: str  # its settings in words
    bounds: Sequence[Bound]
    unbounded: Sequence[str]
    points: Sequence[Point]
    lost: Sequence[Lost]
    prices: Sequence[Price]
    knobs: Mapping[str, Knob]
    absent: Sequence[str]
    hindrances: Sequence[str]

    @property
    def bound(self) -> float:
        return sum(part.value for part in self.bounds)


def write_points(study: Study, path: Path) -> None:
    best = {id(point) for point in front(study.points)}
    with path.open("w", encoding="utf-8", newline="") as file:
        table = csv.DictWriter(file, COLUMNS, restval="")
        table.writeheader()
        for point in study.points:
            table.writerow(row_of(point, id(point) in best, study.facts))
        for lost in study.lost:
            of = lost.configuration
            settings = json.dumps(of.choice.settings(study.facts))
            table.writerow({"knob": of.knob, "value": of.value, "status": lost.reason, "settings": settings})
        own = {f"own_{part.source}": part.value for part in study.bounds}
        sure = not study.unbounded and all(part.sure for part in study.bounds)
        status = "bound" if sure else "estimate"
        table.writerow({"knob": "bound of the reference", "status": status, "error": study.bound, **own})


def row_of(point: Point, on_front: bool, facts: Facts) -> dict[str, object]:
    of, error, seconds = point.configuration, point.error, point.seconds
    return {
        "knob": of.knob,
        "value": of.value,
        "status": "completed",
        "error": error.largest,
        **dict(zip(("error_w", "error_strain", "error_theta"), error.norms)),
        "told_from_reference": point.told,
        "on_front": on_front,
        **{f"own_{source}": part.largest for source, part in point.parts.items()},
        "seconds": seconds.total,
        "seconds_setup": seconds.setup,
        "seconds_factor": seconds.factor,
        "seconds_steps": seconds.steps,
        "rounds": seconds.rounds,
        "settings": json.dumps(of.choice.settings(facts)),
    }


def write_prices(study: Study, path: Path) -> None:
    with path.open("w", encoding="utf-8", newline="") as file:
        table = csv.writer(file)
        table.writerow(PRICES)
        for found in study.prices:
            theory = study.knobs[found.knob].theory or (None,) * 3
            orders = [value for pair in zip(found.orders, theory) for value in pair]
            ends = (found.from_error, found.to_error, *found.seconds, found.factor)
            row = (found.knob, found.points, *ends, *orders)
            table.writerow(["" if value is None else value for value in row])


def exchanged(found: Price, ways: Sequence[str]) -> str:
    """What the second way takes, of the first one's time."""
    return f"{ways[1]} takes {found.seconds[1] / found.seconds[0]:.2g} times the time of {ways[0]}"


def price_line(found: Price, knob: Knob) -> str:
    if knob.ways:
        cost = exchanged(found, knob.ways)
    elif found.factor is None:
        cost = "buys no more accuracy"
    else:
        cost = f"a digit more costs a factor {found.factor:.2g}"
    seen = " ".join("   –" if order is None else f"{order:4.1f}" for order in found.orders)
    line = f"{found.knob:<26} {found.from_error:.1e} -> {found.to_error:.1e}  {cost:<36} order {seen}"
    if knob.theory is None:
        return f"{line}  {knob.why}" if knob.why else line
    due = " ".join(f"{order:.2g}" for order in knob.theory)
    below = below_theory(found, knob)
    return f"{line}  theory {due}{'  below in ' + ', '.join(below) if below else ''}"


def listed(values: Sequence[float | None]) -> str:
    return ", ".join("–" if value is None else f"{value:.2g}" for value in values)


def markdown(study: Study) -> str:
    """The prices as a table for a README."""
    lines = [
        "| knob | its own error | a digit more costs | order of w, ε(u), θ | theory |",
        "| --- " * 5 + "|",
    ]
    for found in study.prices:
        knob = study.knobs[found.knob]
        cost = "–" if found.factor is None else f"{found.factor:.2g}"
        cost = exchanged(found, knob.ways) if knob.ways else cost
        due = "–" if knob.theory is None else listed(knob.theory)
        errors = f"{found.from_error:.1e} to {found.to_error:.1e}"
        lines.append(f"| {found.knob} | {errors} | {cost} | {listed(found.orders)} | {due} |")
    return "\n".join(lines) + "\n"


def text(study: Study) -> str:
    lines = [
        f"{study.facts.name}: errors relative to the reference's largest norm, the largest of w, eps(u), theta"
    ]
    lines += [f"absent  {reason}" for reason in study.absent]
    lines += ["", f"reference: {study.reference}", f"its own error is at most {study.bound:.1e}, the sum of"]
    lines += [f"  {part.text()}" for part in study.bounds]
    lines += [f"  {reason}" for reason in study.unbounded]
    lines += ["", f"{'knob':<26} {'value':>8} {'error':>8} {'own, by source':<76} {'time':>9}"]
    best = {id(point) for point in front(study.points)}
    for point in study.points:
        own = ", ".join(f"{source} {part.largest:.0e}" for source, part in point.parts.items())
        mark = " front" if id(point) in best else "" if point.told else " near the reference"
        of = point.configuration
        lines.append(
            f"{of.knob:<26} {of.value:8.2g} {point.error.largest:8.1e} {own:<76} {point.seconds.total:7.3f} s{mark}"
        )
    for lost in study.lost:
        lines.append(f"{lost.configuration.knob:<26} {lost.configuration.value:8.2g} none: {lost.reason}")
    lines += ["", f"own errors, the finest three of each knob; orders of {', '.join(NAMES)}"]
    lines += [price_line(found, study.knobs[found.knob]) for found in study.prices]
    if study.hindrances:
        lines += ["", "theory asks for smooth solutions; here there are"]
        lines += [f"  {reason}" for reason in study.hindrances]
    return "\n".join(lines)
