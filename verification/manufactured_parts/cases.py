"""The manufactured solutions: exact u(x, t) and theta(x, t), and the laws and numbers they go with.

Nothing here is differentiated: rates, loads, tractions and contact sources follow in strong_form.py, the scene in
scenes.py. `x` is a point of d coordinates, `t` the time; both studies serve d = 2 and d = 3.

A study fixes how a solution depends on x and t, so that only one of the two errors is left:

    space    smooth in x; w and theta' do not change in time, where backward Euler has no error of its own. The lagged
             coupling has one, of first order: cases with both balances refine k with h^(p + 1).
    time     polynomials in x of the degree of the space, which holds them exactly; smooth and curved in t.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import ufl

Expression = Any  # of UFL, which has no types

END = 1.0  # s

# One row a field (the components of u, then theta): wave vector or slopes.
DIRECTIONS = ((1.1, 0.7, 0.4), (-0.8, 1.2, 0.5), (0.6, -0.9, 1.3), (0.9, -1.1, 0.7))


@dataclass(frozen=True)
class Material:
    """Isotropic; E tau = lambda tr(tau) I + 2 G tau (plane strain in 2D), V tau = trace tr(tau) I + shear tau."""

    density: float = 2.0
    young: float = 10.0
    poisson: float = 0.3
    trace: float = 0.5
    shear: float = 1.5


def symmetric(diagonal: float, growth: float, beside: float) -> Callable[[int], list[list[float]]]:
    """d x d with a diagonal that grows."""
    return lambda d: [[diagonal + growth * i if i == j else beside for j in range(d)] for i in range(d)]


@dataclass(frozen=True)
class Heat:
    capacity: float = 1.5
    conductivity: Callable[[int], list[list[float]]] = symmetric(1.0, 0.4, 0.3)
    thermal_stress: Callable[[int], list[list[float]]] = symmetric(0.8, 0.3, 0.2)
    strain_heating: Callable[[int], list[list[float]]] = symmetric(0.5, -0.2, 0.25)


@dataclass(frozen=True)
class Contact:
    """On the side x_{d-1} = 0. `penetration` (m) of the exact solution fixes the gap, g = u_n - r; None: `gap` is given."""

    stiffness: float
    exponent: float
    friction: float
    regularisation: float  # m/s
    conductance: float
    onset: float  # m
    gap: Callable[[Expression], Expression] | None = None
    penetration: Callable[[Expression], Expression] | None = None


def foundation_temperature(x: Expression, t: Expression) -> Expression:
    """In the space of every degree."""
    return 0.7 - 0.4 * x[0] + 0.5 * t


@dataclass(frozen=True)
class Case:
    about: str
    material: Material | None = None
    heat: Heat | None = None
    contact: Contact | None = None

    @property
    def coupled(self) -> bool:
        return self.material is not None and self.heat is not None


CASES = {
    "mechanics": Case("mechanics alone", material=Material()),
    "heat": Case("heat alone", heat=Heat()),
    "coupled": Case("mechanics and heat", material=Material(), heat=Heat()),
    # r lies between 0.3 and 1.1 m, |w_t| above 0.4 m/s: no law has a kink there
    "slipping": Case(
        "contact closed and slipping",
        Material(),
        Heat(),
        Contact(20.0, 1.5, 0.3, 0.1, 3.0, 0.1, gap=lambda t: -0.7 - 0.1 * t),
    ),
    # opens everywhere at once, at t = 0.545 s; both laws are Lipschitz there, and r is uniform, so that no kink lies
    # inside a facet: theory keeps its orders
    "opening": Case(
        "contact that opens",
        Material(),
        Heat(),
        Contact(20.0, 1.0, 0.3, 0.1, 3.0, 0.4, penetration=lambda t: 0.3 - 0.55 * t),
    ),
}


def slope(x: Expression, field: int) -> Expression:
    """b . x, whose powers are the shapes."""
    return sum(DIRECTIONS[field][i] * x[i] for i in range(len(x)))


@dataclass(frozen=True)
class InSpace:
    """Waves in x, linear in t."""

    name: str = "space"

    def displacement_factor(self, t: Expression) -> Expression:
        return 0.5 + 0.5 * t

    def temperature_factor(self, t: Expression) -> Expression:
        return 1 - 0.25 * t

    def shape(self, x: Expression, field: int, degree: int) -> Expression:
        return ufl.sin(slope(x, field) + 0.4 * (field + 1))


@dataclass(frozen=True)
class InTime:
    """Polynomials in x, transcendental in t."""

    name: str = "time"

    def displacement_factor(self, t: Expression) -> Expression:
        return 0.5 + 0.6 * ufl.sin(t)

    def temperature_factor(self, t: Expression) -> Expression:
        return ufl.exp(-t)

    def shape(self, x: Expression, field: int, degree: int) -> Expression:
        s = slope(x, field)
        return sum(s**power / (2 * math.factorial(power)) for power in range(1, degree + 1))


STUDIES = {"space": InSpace(), "time": InTime()}


def displacement(study: str, x: Expression, t: Expression, degree: int) -> Expression:
    """u (m). The first component carries a drift: the body slips along the contact side."""
    kind, d = STUDIES[study], len(x)
    shapes = [0.3 * kind.shape(x, i, degree) for i in range(d)]
    return ufl.as_vector([kind.displacement_factor(t) * (shapes[i] + (2.0 if i == 0 else 0.0)) for i in range(d)])


def temperature(study: str, x: Expression, t: Expression, degree: int) -> Expression:
    """theta (K)."""
    kind = STUDIES[study]
    return kind.temperature_factor(t) * (1.0 + kind.shape(x, 3, degree))


def gap(contact: Contact, u: Expression, t: Expression) -> Expression:
    """g (m) as a function on the whole body; only its values on the contact side, where n = -e_{d-1}, matter."""
    if contact.gap is not None:
        return contact.gap(t)
    assert contact.penetration is not None
    return -u[len(u) - 1] - contact.penetration(t)
