"""The manufactured solutions: exact u(x, t) and theta(x, t), and the laws and numbers they go with.

Nothing here is differentiated: rates, loads, tractions and contact sources follow in strong_form.py, the scene in
scenes.py. `x` is a point of d coordinates, `t` the time; both studies serve d = 2 and d = 3, and every cell: the space
of degree p holds the polynomials of degree p on each of them.

A study fixes how a solution depends on x and t, so that only one of the two errors is left:

    space    smooth in x, at most linear in t, where backward Euler is exact. So is the lagged coupling: beside each
             other theta rests, and the part of u that moves has R : eps(u) = 0.
    time     polynomials in x of the degree of the space, which holds them exactly; smooth and curved in t.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import ufl

Expression = Any  # of UFL, which has no types

END = 1.0  # s

# Wave vectors or slopes b (1/m): of theta and of all that moves, then of the components of u.
DIRECTIONS = ((0.7, -0.9, 0.5), (0.9, 0.6, 0.3), (-0.6, 1.0, 0.4), (0.5, -0.7, 1.0))
AMPLITUDE = 0.3  # of u, m
GROWTH = 0.6  # of u in the study in space, m/s: large enough for the error of w to be more than an echo of that of u


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


STRAIN_HEATING = symmetric(0.5, -0.2, 0.25)
RATE_HEATING = symmetric(-0.6, 0.4, 0.2)


@dataclass(frozen=True)
class Heat:
    capacity: float = 1.5
    conductivity: Callable[[int], list[list[float]]] = symmetric(1.0, 0.4, 0.3)
    thermal_stress: Callable[[int], list[list[float]]] = symmetric(0.8, 0.3, 0.2)
    strain_heating: Callable[[int], list[list[float]]] = STRAIN_HEATING
    rate_heating: Callable[[int], list[list[float]]] | None = None  # of the strain rate


@dataclass(frozen=True)
class Contact:
    """On the side y = 0, where n = -e_y. `penetration` (m) of the exact solution fixes the gap, g = u_n - r; None: `gap` is given."""

    stiffness: float
    exponent: float
    friction: float
    regularisation: float  # m/s
    conductance: float
    onset: float  # m
    gap: Callable[[Expression], Expression] | None = None
    penetration: Callable[[Expression], Expression] | None = None
    velocity: Callable[[Expression, Expression], list[Expression]] | None = None  # of the foundation, m/s
    heat_share: float = 0.0
    convection: float = 0.0  # beside the conductance, to air as warm as the foundation, W/(m2 K)
    spring: Callable[[int], list[list[float]]] | None = None  # beside the laws, N/m3, to what is at anchor()


def turntable(x: Expression, t: Expression) -> list[Expression]:
    """A foundation that turns, faster and faster, and moves along; its normal part counts for nothing."""
    return [-0.4 * (1 + t) + 0.1 * x[1], 0.3 * x[0], 0.2 * x[0]][: len(x)]


def anchor(x: Expression, t: Expression) -> list[Expression]:
    """Where the springs' far ends are (m); in the space of every degree."""
    return [0.3 - 0.2 * x[0] + 0.4 * t, 0.1 * t - 0.3 * x[0] * t, 0.2 * x[0]][: len(x)]


def foundation_temperature(x: Expression, t: Expression) -> Expression:
    """In the space of every degree."""
    return 0.7 - 0.4 * x[0] + 0.5 * t


@dataclass(frozen=True)
class Case:
    about: str
    material: Material | None = None
    heat: Heat | None = None
    contact: Contact | None = None
    coarsest_steps: int = 32  # of the study in time: from where on errors fall by theory's order

    @property
    def coupled(self) -> bool:
        return self.material is not None and self.heat is not None

    @property
    def body(self) -> str:
        """Name of the case without contact that has the same exact fields and laws inside: it has the same sources
        there and on the other sides, and the same errors."""
        alike = (self.material, self.heat, None)
        return next(name for name, case in CASES.items() if (case.material, case.heat, case.contact) == alike)


CASES = {
    "mechanics": Case("mechanics alone", material=Material()),
    "heat": Case("heat alone", heat=Heat()),
    "coupled": Case("mechanics and heat", material=Material(), heat=Heat()),
    # r lies between 0.3 and 1.1 m, |w_t| above 0.4 m/s: no law has a kink there
    "slipping": Case(
        "contact closed and slipping",
        Material(),
        Heat(),
        Contact(20.0, 1.5, 0.3, 0.1, 3.0, 0.1, gap=lambda t: -1.0 - 0.1 * t),
    ),
    "rated": Case("mechanics and heat of strain rates", Material(), Heat(rate_heating=RATE_HEATING)),
    # as slipping; |w_t - v_Ft| is above 0.8 m/s
    "rubbing": Case(
        "contact on a foundation that moves, heat of friction, convection, springs",
        Material(),
        Heat(rate_heating=RATE_HEATING),
        Contact(
            20.0,
            1.5,
            0.3,
            0.1,
            3.0,
            0.1,
            gap=lambda t: -1.0 - 0.1 * t,
            velocity=turntable,
            heat_share=0.6,
            convection=1.5,
            spring=symmetric(3.0, 2.0, 0.8),
        ),
        coarsest_steps=64,  # heat is quadratic in the slip: midpoint's orders start at 1.89 from 1/32
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
    """b . x, whose functions are the shapes."""
    return sum(DIRECTIONS[field][i] * x[i] for i in range(len(x)))


def wave(x: Expression, field: int) -> Expression:
    return ufl.sin(slope(x, field) + 0.4 * (field + 1))


def polarisation(d: int) -> list[float]:
    """A unit vector a with a . R b = 0, so that the wave a sin(b . x) has R : eps = 0."""
    R, b = STRAIN_HEATING(d), DIRECTIONS[0]
    c = [sum(R[i][j] * b[j] for j in range(d)) for i in range(d)]
    length = math.hypot(c[0], c[1])
    return [c[1] / length, -c[0] / length] + [0.0] * (d - 2)


def drift(component: int) -> float:
    """Along the contact side: the body slips there."""
    return 1.0 if component == 0 else 0.0


class InSpace:
    """Waves in x, linear in t."""

    def displacement(self, x: Expression, t: Expression, degree: int) -> list[Expression]:
        a, common = polarisation(len(x)), wave(x, 0)
        return [
            drift(i) * (1 + t) + AMPLITUDE * wave(x, i + 1) + GROWTH * t * (a[i] * common)
            for i in range(len(x))
        ]

    def temperature(self, x: Expression, t: Expression, degree: int, alone: bool) -> Expression:
        return (1 + 0.5 * t if alone else 1.0) * (1 + wave(x, 0))


class InTime:
    """Polynomials in x, transcendental in t."""

    def polynomial(self, x: Expression, field: int, degree: int) -> Expression:
        s = slope(x, field)
        return sum(s**power / (2 * math.factorial(power)) for power in range(1, degree + 1))

    def displacement(self, x: Expression, t: Expression, degree: int) -> list[Expression]:
        factor = 0.5 + 0.6 * ufl.sin(t)
        return [
            factor * (2 * drift(i) + AMPLITUDE * self.polynomial(x, i + 1, degree)) for i in range(len(x))
        ]

    def temperature(self, x: Expression, t: Expression, degree: int, alone: bool) -> Expression:
        return ufl.exp(-t) * (1 + self.polynomial(x, 0, degree))


STUDIES: dict[str, InSpace | InTime] = {"space": InSpace(), "time": InTime()}


def displacement(study: str, x: Expression, t: Expression, degree: int) -> Expression:
    """u (m)."""
    return ufl.as_vector(STUDIES[study].displacement(x, t, degree))


def temperature(study: str, case: Case, x: Expression, t: Expression, degree: int) -> Expression:
    """theta (K)."""
    return STUDIES[study].temperature(x, t, degree, not case.coupled)


def gap(contact: Contact, u: Expression, t: Expression) -> Expression:
    """g (m) as a function on the whole body; only its values on the contact side, where n = -e_y, matter."""
    if contact.gap is not None:
        return contact.gap(t)
    assert contact.penetration is not None
    return -u[1] - contact.penetration(t)
