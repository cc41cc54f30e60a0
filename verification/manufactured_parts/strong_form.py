"""The equations (2.1)-(2.10) in strong form, applied to exact fields: what is left over is the source of a case.

Written from the paper's equations and not from the residuals of forms/: a wrong sign there must not be repeated here.
UFL differentiates, in x and in t.
"""

import ufl
from ufl.algorithms.apply_algebra_lowering import apply_algebra_lowering
from ufl.algorithms.apply_derivatives import apply_derivatives

from manufactured_parts.cases import Case, Contact, Expression


def rate(f: Expression, t: Expression) -> Expression:
    """df/dt for `t` a ufl.variable. Evaluated at once: a gradient taken first would forget the variable."""
    return apply_derivatives(apply_algebra_lowering(ufl.diff(f, t)))


def strain(u: Expression) -> Expression:
    gradient = ufl.grad(u)
    return (gradient + ufl.transpose(gradient)) / 2


def stress(case: Case, u: Expression, w: Expression, theta: Expression | None) -> Expression:
    """(2.1): E eps(u) + V eps(w) - theta M, with Lame's constants of three-dimensional or plane strain."""
    m, d = case.material, len(u)
    assert m is not None
    lame = m.young * m.poisson / ((1 + m.poisson) * (1 - 2 * m.poisson))
    shear_modulus = m.young / (2 * (1 + m.poisson))
    identity = ufl.Identity(d)
    elastic = lame * ufl.div(u) * identity + 2 * shear_modulus * strain(u)
    viscous = m.trace * ufl.div(w) * identity + m.shear * strain(w)
    if theta is None:
        return elastic + viscous
    assert case.heat is not None
    return elastic + viscous - theta * ufl.as_matrix(case.heat.thermal_stress(d))


def heat_flux_vector(case: Case, theta: Expression, d: int) -> Expression:
    """(2.2): q = -K grad(theta)."""
    assert case.heat is not None
    return -ufl.as_matrix(case.heat.conductivity(d)) * ufl.grad(theta)


def body_force(case: Case, u: Expression, t: Expression, theta: Expression | None) -> Expression:
    """(2.3): f0 = rho u'' - Div(sigma)."""
    assert case.material is not None
    w = rate(u, t)
    return case.material.density * rate(w, t) - ufl.div(stress(case, u, w, theta))


def heat_source(case: Case, theta: Expression, t: Expression, u: Expression | None, d: int) -> Expression:
    """(2.4): q0 = c theta' + div(q) - R : eps(u), and less R' : eps(w)."""
    assert case.heat is not None
    source = case.heat.capacity * rate(theta, t) + ufl.div(heat_flux_vector(case, theta, d))
    if u is None:
        return source
    source -= ufl.inner(ufl.as_matrix(case.heat.strain_heating(d)), strain(u))
    if case.heat.rate_heating is None:
        return source
    return source - ufl.inner(ufl.as_matrix(case.heat.rate_heating(d)), strain(rate(u, t)))


def penetration(u: Expression, g: Expression, n: Expression) -> Expression:
    return ufl.dot(u, n) - g


def pressure_on(contact: Contact, r: Expression) -> Expression:
    """(2.8)."""
    return contact.stiffness * ufl.conditional(ufl.gt(r, 0), r, 0.0) ** contact.exponent


def slip_over(v: Expression | None, w: Expression, n: Expression) -> Expression:
    """The tangential velocity over a foundation that moves with `v`, or rests."""
    over = w if v is None else w - v
    return over - ufl.dot(over, n) * n


def drag(contact: Contact, pressure: Expression, slip: Expression) -> Expression:
    """(2.9), the norm of the slip regularised: what friction exerts on the body."""
    speed = ufl.sqrt(ufl.dot(slip, slip) + contact.regularisation**2)
    return -contact.friction * pressure * slip / speed


def spring_traction(contact: Contact, u: Expression, far_end: Expression) -> Expression:
    """sigma n = -k_s (u - u_s) of springs alone."""
    assert contact.spring is not None
    return -ufl.as_matrix(contact.spring(len(u))) * (u - far_end)


def contact_traction(contact: Contact, r: Expression, slip: Expression, n: Expression) -> Expression:
    """The traction that the foundation exerts."""
    pressure = pressure_on(contact, r)
    return -pressure * n + drag(contact, pressure, slip)


def friction_heat(contact: Contact, r: Expression, slip: Expression) -> Expression:
    """The body's share of what friction dissipates."""
    return -contact.heat_share * ufl.dot(drag(contact, pressure_on(contact, r), slip), slip)


def contact_outflow(contact: Contact, theta: Expression, foundation: Expression, r: Expression) -> Expression:
    """(2.10): q.n = k_c(r) (theta - theta_F), with k_c growing from 0 at r = 0 to its value at the onset."""
    share = ufl.conditional(
        ufl.lt(r, 0), 0.0, ufl.conditional(ufl.lt(r, contact.onset), r / contact.onset, 1.0)
    )
    return contact.conductance * share * (theta - foundation)
