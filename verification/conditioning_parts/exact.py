"""A linear system solved in 50 digits, and what rounding its entries does to the solution."""

from dataclasses import dataclass
from typing import Any

import mpmath
import numpy as np
import numpy.typing as npt

EPSILON = 2.0**-52
DIGITS = 50
ROUNDINGS = 5  # random ones
Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Loss:
    """Of the driver's solution, relative to the largest entries."""

    residual: float
    forward_error: float  # against the exact solution of the rounded system
    rounding: float  # what other roundings of the system change the exact solution by

    def digits(self) -> float:
        """That are right: neither lost in the solve nor undetermined by data that are rounded."""
        return float(-np.log10(max(self.forward_error, self.rounding, EPSILON / 2)))


def largest(values: Any) -> float:
    return max((float(abs(value)) for value in values), default=0.0)


def measure(matrix: Array, rhs: Array, solution: Array) -> Loss:
    """Each entry of matrix and right-hand side is rounded another way by at most EPSILON / 2 of itself."""
    with mpmath.workdps(DIGITS):
        size = len(rhs)
        T, b, x = (
            mpmath.matrix(matrix.tolist()),
            mpmath.matrix(rhs.tolist()),
            mpmath.matrix(solution.tolist()),
        )
        factors, pivots = mpmath.mp.LU_decomp(T)

        def solve(right: Any) -> Any:
            return mpmath.mp.U_solve(factors, mpmath.mp.L_solve(factors, right, pivots))

        exact = solve(b)
        scale = largest(exact)
        residual = largest(T * x - b) / max(largest(b), float(mpmath.mpf(2) ** -1000))
        random = np.random.default_rng(1)
        worst = 0.0
        for _ in range(ROUNDINGS):  # T dx = db - dT x, to first order
            shares = random.uniform(-1, 1, (size, size + 1)) * EPSILON / 2
            change = [
                mpmath.fsum(
                    [shares[i, size] * b[i]] + [-shares[i, j] * T[i, j] * exact[j] for j in range(size)]
                )
                for i in range(size)
            ]
            worst = max(worst, largest(solve(mpmath.matrix(change))))
        return Loss(residual, largest(x - exact) / scale, worst / scale)
