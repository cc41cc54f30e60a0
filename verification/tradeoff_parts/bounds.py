"""How far the reference itself is from the solution that it approximates, for each source of error.

One source at a time is made coarser by a ratio r, twice where that pays: with D1 the distance of the reference x(s) to
x(r s), and D2 that of x(r s) to x(r^2 s), the observed order is q = log(D2 / D1) / log r. If every further refinement
by r changes the solution by at most r^-q times what the one before it did, as errors C s^q do, then with x the limit

    ||x(s) - x|| <= sum_{j >= 1} ||x(s / r^(j-1)) - x(s / r^j)|| <= sum_{j >= 1} D1 r^(-q j) = D1 / (r^q - 1).

The order taken is the smaller one of q and the theory's, so that an order that is seen before it is asymptotic does not
make the bound small. Where q is less than LEAST, differences do not fall, and LEAST is taken and said: an estimate, no
bound. With one coarser run alone, theory's order is taken. Where D1 is round-off, it is the bound. Distances are in
the norm of the study, so that the bounds of the sources add up to one of the whole (triangle inequality).
"""

import math
from dataclasses import dataclass

ROUND_OFF = 1e-9  # of the solution: distances below this have no order
LEAST = 0.3


@dataclass(frozen=True)
class Bound:
    source: str
    ratio: float
    first: float  # D1
    second: float | None  # D2
    theory: float
    observed: float | None
    order: float  # that the bound is made with
    value: float
    sure: bool  # differences were seen to fall

    def text(self) -> str:
        seen = "" if self.observed is None else f", order seen {self.observed:.2f}"
        doubt = "" if self.sure else "; differences do not fall: an estimate"
        return f"{self.source:<15} {self.value:.1e}  (D1 {self.first:.1e}, by {self.ratio:g}{seen}{doubt})"


def bound(source: str, ratio: float, theory: float, first: float, second: float | None) -> Bound:
    if first <= ROUND_OFF:
        return Bound(source, ratio, first, second, theory, None, theory, first, True)
    observed = None
    if second is not None:
        observed = math.log(second / first) / math.log(ratio) if second > 0 else -math.inf
    order = theory if observed is None else min(theory, observed)
    sure = order >= LEAST
    order = max(order, LEAST)
    return Bound(source, ratio, first, second, theory, observed, order, first / (ratio**order - 1), sure)
