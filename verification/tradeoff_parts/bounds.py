"""How far the reference itself is from the solution that it approximates, for each source of error.

One source at a time is made coarser, twice where that pays: from the reference's s to r2 s and r3 s. With the distances
D1 of x(s) to x(r2 s) and D2 of x(r2 s) to x(r3 s), errors that fall like C s^q have

    D1 = C s^q (r2^q - 1),    D2 = C s^q (r3^q - r2^q),    D2 / D1 = (r3^q - r2^q) / (r2^q - 1),

and the last one, which grows with q, gives the order q that is seen. What is left of the error is then

    ||x(s) - x|| = C s^q = D1 / (r2^q - 1).

For r3 = r2^2 it is enough that each further refinement by r2 changes the solution by at most r2^-q times what the one
before it did: ||x(s) - x|| <= sum_{j >= 1} ||x(s / r2^(j-1)) - x(s / r2^j)|| <= sum_{j >= 1} D1 r2^(-q j), the same. The order taken is the smaller one of q and the theory's, so that an order seen before it is asymptotic does
not make the bound small. Where q is less than LEAST, differences hardly fall: LEAST is taken, and said to be an estimate.
With one coarser run alone, theory's order is taken. Where D1 is round-off, it is the bound. Distances are in the norm of
the study, so that the bounds of the sources add up to one of the whole (triangle inequality).
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

ROUND_OFF = 1e-9  # of the solution: distances below this have no order
LEAST, MOST = 0.3, 20.0


@dataclass(frozen=True)
class Bound:
    source: str
    ratio: float  # r2
    first: float  # D1
    observed: float | None
    value: float
    sure: bool  # differences were seen to fall

    def text(self) -> str:
        seen = "" if self.observed is None else f", order seen {self.observed:.2f}"
        doubt = "" if self.sure else "; differences hardly fall: an estimate"
        return f"{self.source:<15} {self.value:.1e}  (D1 {self.first:.1e}, by {self.ratio:.2g}{seen}{doubt})"


def bound(source: str, ratios: Sequence[float], theory: float, distances: Sequence[float]) -> Bound:
    """`ratios`: r2 and, if there is a second distance, r3."""
    first = distances[0]
    if first <= ROUND_OFF:
        return Bound(source, ratios[0], first, None, first, True)
    seen = order_of(ratios[0], ratios[1], distances[1] / first) if len(distances) > 1 else None
    order = theory if seen is None else min(theory, seen)
    value = first / (ratios[0] ** max(order, LEAST) - 1)
    return Bound(source, ratios[0], first, seen, value, order >= LEAST)


def order_of(second: float, third: float, quotient: float) -> float:
    """q of D2 / D1 = (r3^q - r2^q) / (r2^q - 1), by bisection; 0 where there is none above 0, MOST at most."""

    def of(q: float) -> float:
        return (third**q - second**q) / (second**q - 1)

    if quotient <= math.log(third / second) / math.log(second):  # the limit q -> 0
        return 0.0
    low, high = 0.0, MOST
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if of(middle) < quotient else (low, middle)
    return high
