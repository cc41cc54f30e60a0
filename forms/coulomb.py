"""Coulomb friction (2.9) itself: -sigma_t in mu p_n d|w_t|, the limit of friction.py where eps falls to 0.

Method of multipliers: with a multiplier lam at the points of the rule and gamma > 0,

    -sigma_t = proj_B(lam + gamma w_t),   B = {t: |t| <= p_t},   p_t = mu p_n,

is Lipschitz in w, and where lam = -sigma_t it is the law, whatever gamma: |lam| < p_t asks for w_t = 0, and w_t != 0 for
lam = p_t w_t/|w_t|. The caller repeats lam := -sigma_t. lam is kept on one facet at a time as a function of degree 2, of
which only the values at the rule's points matter; `functional` and `gram` give them back (friction_multiplier.h).

The unknown is the velocity w of the step; the displacement is u = u_old + k w. w_t is relative to the foundation, which
moves with v_F, and the heat of friction as in friction.py.
"""

import space
from space import Q, V, at_nodes, dim, mesh, n, over_contact, positive_part, tangential
from ufl import (
    Coefficient,
    Constant,
    FunctionSpace,
    TestFunction,
    TrialFunction,
    conditional,
    derivative,
    dot,
    ge,
    gt,
    sqrt,
)

ON_FACET = [space._element("Lagrange", mesh.ufl_cell().cellname(), 2, shape) for shape in ((), (dim,))]
# A point slips where gamma |w_t| exceeds this share of p_t: what remains of w_t where it sticks is less by far.
SLIPS = 1e-6

c_n, m, mu, gamma, k, heat_share = (Constant(mesh) for _ in range(6))
w, u_old, g, v_F = Coefficient(V), Coefficient(V), Coefficient(Q), Coefficient(V)
lam = Coefficient(FunctionSpace(mesh, ON_FACET[1]))
v, dw, q = TestFunction(V), TrialFunction(V), TestFunction(Q)
chi, dchi = (argument(FunctionSpace(mesh, ON_FACET[0])) for argument in (TestFunction, TrialFunction))
psi = TestFunction(FunctionSpace(mesh, ON_FACET[1]))


def projected(t):
    """proj_B(t)."""
    size = sqrt(dot(t, t))
    return conditional(gt(size, p_t), p_t / size, 1) * t


w_t = tangential(w - v_F)
r = dot(u_old + k * w, n) - g
p_t = mu * c_n * positive_part(r) ** m
minus_sigma_t = projected(lam + gamma * w_t)
speed = sqrt(dot(w_t, w_t))
does_slip = gt(gamma * speed, SLIPS * p_t)

residual = over_contact(dot(minus_sigma_t, tangential(v)))
jacobian = derivative(residual, w, dw)
functional = over_contact(dot(minus_sigma_t, psi))
heat = over_contact(heat_share * dot(minus_sigma_t, w_t) * q)
gram = over_contact(dchi * chi)
slip_area = over_contact(conditional(does_slip, conditional(ge(r, 0), 1.0, 0.0), 0.0))
slips = at_nodes(conditional(does_slip, 1.0, 0.0) * q)
# -sigma_t of the state at hand, which of some schemes is not that at which lam was found
minus_sigma_t_now = conditional(does_slip, p_t / speed, 0) * w_t + conditional(does_slip, 0, 1) * projected(
    lam
)
force = over_contact(dot(minus_sigma_t_now, tangential(v)))
traction = at_nodes(-dot(minus_sigma_t_now, v))
