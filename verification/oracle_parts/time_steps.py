"""A step of each time scheme, from the definition that they share.

Over a step from t to t + k a field y moves on by its mean rate d = (y_new - y)/k. Rates are taken to be linear in time,
through q, which the step before left, and d in the middle of the step. The balance laws hold at the stage, a fraction
alpha of the step after t, for the value y + alpha (y_new - y) and the rate r that the line has there.

    alpha = 1, r = d                     backward Euler
    alpha = 1/(1 + rho)                  generalized-alpha; q belongs to the time (alpha - 1/2) k before the step's end
    rho = 1, rho = 0                     midpoint rule, BDF2

The first step has no q and is one of backward Euler.
"""

from dataclasses import dataclass
from typing import Any

RADII = {"backward-euler": None, "bdf2": 0.0, "midpoint": 1.0}


@dataclass(frozen=True)
class Step:
    """y_s = y + carried q + tau r."""

    start: float
    end: float
    size: float
    alpha: float
    tau: float
    carried: float
    turn: float  # q_new = q + turn (d - q)

    @property
    def stage(self) -> float:
        return self.end if self.alpha == 1.0 else self.start + self.alpha * self.size


def step_of(radius: float | None, start: float, end: float, size: float, before: float | None) -> Step:
    """`before` is the size of the step before; None: there was none. `radius` None is backward Euler."""
    if radius is None or before is None:
        return Step(start, end, size, 1.0, size, 0.0, 1.0)
    alpha = 1.0 / (1.0 + radius)
    # times after `start`
    of_q, of_d, of_r = (0.5 - alpha) * before, 0.5 * size, alpha * size
    of_next = size + (0.5 - alpha) * size
    share = (of_d - of_q) / (of_r - of_q)  # d = (1 - share) q + share r
    tau = alpha * size * share
    return Step(start, end, size, alpha, tau, alpha * size - tau, (of_next - of_q) / (of_d - of_q))


class Evolution:
    """One field at the begin of a step, its rate there, and what the step makes of them."""

    def __init__(self, function: Any) -> None:
        self.function = function
        self.rate = 0.0 * function.x.array

    def base(self, step: Step) -> Any:
        """y_s less tau r."""
        return self.function.x.array + step.carried * self.rate

    def expected(self, step: Step) -> Any:
        """The value at the stage as far as it is known before the step."""
        return self.function.x.array + step.alpha * step.size * self.rate

    def at_stage(self, step: Step, end_value: Any, dofs: Any) -> Any:
        value = self.function.x.array[dofs]
        return value + step.alpha * (end_value - value)

    def move(self, step: Step, stage_value: Any, keep_rate: bool) -> None:
        mean_rate = (stage_value - self.function.x.array) / (step.alpha * step.size)
        self.function.x.array[:] += step.size * mean_rate
        if keep_rate:
            self.rate += step.turn * (mean_rate - self.rate)
