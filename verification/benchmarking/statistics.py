"""Medians with their range, and the exponent of a power law."""

import math
import statistics
from collections.abc import Mapping, Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Sample:
    median: float
    least: float
    most: float

    @classmethod
    def of(cls, values: Sequence[float]) -> "Sample":
        return cls(statistics.median(values), min(values), max(values))

    def text(self, factor: float = 1.0, digits: int = 3) -> str:
        low, high = (f"{factor * value:.{digits}g}" for value in (self.least, self.most))
        return f"{factor * self.median:.{digits}g} ({low}-{high})"


def exponent(seconds_by_n: Mapping[int, float]) -> float | None:
    """p of the least-squares fit seconds = a n^p."""
    if len(seconds_by_n) < 2:
        return None
    x = [math.log(n) for n in seconds_by_n]
    y = [math.log(seconds) for seconds in seconds_by_n.values()]
    return statistics.linear_regression(x, y).slope
