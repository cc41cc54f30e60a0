"""The contact laws, each written once for two algebras: UFL (weak forms) and numpy (nodal results).

r = u_n - g is the penetration; an `Algebra` supplies the only operations that UFL and numpy spell differently.
"""

from dataclasses import dataclass
from typing import Any, Callable

import numpy as np
import ufl


@dataclass(frozen=True)
class Algebra:
    where: Callable[[Any, Any, Any], Any]
    sqrt: Callable[[Any], Any]


UFL = Algebra(where=ufl.conditional, sqrt=ufl.sqrt)
NUMPY = Algebra(where=np.where, sqrt=np.sqrt)


def positive_part(m: Algebra, r: Any) -> Any:
    """r_+; its derivative at r = 0 is 1, that is, contact just touching counts as closed."""
    return m.where(r >= 0.0, r, 0.0)


def pressure(m: Algebra, r: Any, stiffness: Any, exponent: Any) -> Any:
    """p_n(r) = c_n r_+^m."""
    return stiffness * positive_part(m, r) ** exponent


def regularised_norm(m: Algebra, slip_squared: Any, epsilon: Any) -> Any:
    """|v|_epsilon = sqrt(|v|^2 + epsilon^2)."""
    return m.sqrt(slip_squared + epsilon**2)


def conductance(m: Algebra, r: Any, coefficient: Any, onset: Any) -> Any:
    """k_c(r): 0 when open, rising linearly over the onset depth, then constant."""
    return m.where(r <= 0.0, 0.0, m.where(r <= onset, coefficient * r / onset, coefficient))


def clamped(m: Algebra, s: Any, limit: Any | None) -> Any:
    """phi_L(s) = clamp(s, -L, L); without L the identity."""
    if limit is None:
        return s
    return m.where(s > limit, limit, m.where(s < -limit, -limit, s))
