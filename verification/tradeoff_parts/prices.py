"""What the measured points say: the Pareto front, the order of each knob beside theory's, what a digit more costs."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from tradeoff_parts.measure import Error, Point
from tradeoff_parts.plan import BARGAIN, Knob

NAMES = ("w", "ε(u)", "θ")
SLACK = 0.2  # an order this much below theory's is called so
RESOLVED = 1e-9  # own errors below are round-off
CLEAR = 2.0  # own errors above this many bounds of the reference's own are told from it
TURNED = 0.1  # digits that a knob must move its own error by, to have a price


@dataclass(frozen=True)
class Price:
    """Of one knob: over the points that its own error is resolved at, the finest three of them."""

    knob: str
    points: int
    orders: Sequence[float | None]  # by norm; None: less than two values, or an error that is round-off
    digits: float  # by which its own error falls from the first to the last of them
    factor: float | None  # in time for a digit more of its own error; None: less than TURNED digits
    from_error: float
    to_error: float
    seconds: tuple[float, float]


def front(points: Sequence[Point]) -> list[Point]:
    """Those than which none is both faster and more accurate, by their time; among errors above the reference's own."""
    best: list[Point] = []
    above = [point for point in points if point.margin > 1]
    for point in sorted(above, key=lambda point: (point.seconds.total, point.error.largest)):
        if not best or point.error.largest < best[-1].error.largest:
            best.append(point)
    return best


def by_knob(points: Sequence[Point]) -> dict[str, list[Point]]:
    """Each knob's points, the crudest first."""
    found: dict[str, list[Point]] = {}
    for point in points:
        found.setdefault(point.configuration.knob, []).append(point)
    return {name: sorted(of, key=lambda point: -point.configuration.value) for name, of in found.items()}


def own_error(point: Point, knob: Knob) -> Error:
    """Of the source that the knob turns; of a knob of several, the whole."""
    if knob.source is None:
        return point.error
    return point.parts.get(knob.source, Error((0.0, 0.0, 0.0)))


def slope(x: Sequence[float], y: Sequence[float]) -> float | None:
    """Least squares through the logarithms."""
    if len(set(x)) < 2 or min(y) <= 0:
        return None
    return float(np.polyfit(np.log(x), np.log(y), 1)[0])


def exchange(name: str, knob: Knob, points: Sequence[Point]) -> Price | None:
    """Of two ways to one solution: what either leaves of the solver's error, and takes. None where one of them failed."""
    if len(points) != 2:
        return None
    first, second = sorted(points, key=lambda point: point.configuration.value)
    errors = [own_error(point, knob).largest for point in (first, second)]
    times = (first.seconds.total, second.seconds.total)
    return Price(name, 2, (None,) * 3, 0.0, None, errors[0], errors[1], times)


def price(name: str, knob: Knob, points: Sequence[Point], own: float) -> Price | None:
    """`own`: the bound of the reference's error of that source. None where less than two of the knob's own errors are
    told from it and from round-off."""
    if knob.ways:
        return exchange(name, knob, points)
    least = max(RESOLVED, CLEAR * own)
    usable = [point for point in points if own_error(point, knob).largest > least][-3:]
    if len({point.configuration.value for point in usable}) < 2:
        return None
    values = [point.configuration.value for point in usable]
    errors = [own_error(point, knob) for point in usable]
    times = [point.seconds.total for point in usable]
    orders = [slope(values, [error.norms[norm] for error in errors]) for norm in range(3)]
    largest = [error.largest for error in errors]
    digits = math.log10(largest[0] / largest[-1])
    factor = None
    if digits >= TURNED:
        factor = (times[-1] / times[0]) ** (1 / digits)
    return Price(name, len(usable), orders, digits, factor, largest[0], largest[-1], (times[0], times[-1]))


def prices(
    points: Sequence[Point], knobs: Mapping[str, Knob], own: Mapping[str | None, float]
) -> list[Price]:
    """`own`: the bounds of the reference's error, by source, and by None of all."""
    found = by_knob(points)
    listed = [
        price(name, knob, found[name], own.get(knob.source, 0.0))
        for name, knob in knobs.items()
        if name in found and name != BARGAIN
    ]
    return [entry for entry in listed if entry]


def below_theory(found: Price, knob: Knob) -> list[str]:
    """The norms in which the order measured is less than theory's."""
    pairs = zip(NAMES, found.orders, knob.theory or (None,) * 3)
    return [name for name, seen, due in pairs if seen is not None and due is not None and seen < due - SLACK]
