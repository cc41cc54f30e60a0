"""What was expected, what was found, and whether it is near enough."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt


@dataclass(frozen=True)
class Row:
    quantity: str
    expected: float
    found: float
    tolerance: float  # of the difference, in the unit of the quantity

    @property
    def passes(self) -> bool:
        return abs(self.found - self.expected) <= self.tolerance  # false for a NaN


HEADER = f"{'quantity':<58} {'expected':>16} {'found':>16} {'difference':>10} {'tolerance':>9}"


def text(row: Row) -> str:
    numbers = (
        f"{row.expected:16.10g} {row.found:16.10g} {row.found - row.expected:10.1e} {row.tolerance:9.1e}"
    )
    return f"{row.quantity:<58} {numbers}  {'ok' if row.passes else 'FAILED'}"


def relative(quantity: str, expected: float, found: float, tolerance: float) -> Row:
    return Row(quantity, expected, found, tolerance * abs(expected))


def largest(quantity: str, difference: npt.ArrayLike, tolerance: float) -> Row:
    """The largest magnitude of a difference that should vanish."""
    return Row(quantity, 0.0, float(np.max(np.abs(difference))), tolerance)


def orders(quantity: str, expected: float, errors: Sequence[float], tolerance: float) -> list[Row]:
    """The order between each error and the next, found with a step (or width) half as large."""
    return [
        Row(f"{quantity}, order {i + 1}", expected, order(coarse, fine), tolerance)
        for i, (coarse, fine) in enumerate(zip(errors, errors[1:]))
    ]


def order(coarse: float, fine: float) -> float:
    """NaN, which fails, where an error has changed its sign."""
    return math.log2(coarse / fine) if coarse * fine > 0 else math.nan
