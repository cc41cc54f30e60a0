"""Coulomb friction (2.9) with the norm regularised: -sigma_t = mu p_n w_t / |w_t|_eps, |v|_eps = sqrt(v.v + eps^2).

w_t is the tangential velocity relative to the foundation, which moves with v_F. What friction dissipates, -sigma_t.w_t,
becomes heat, of which the body gets a share.

The unknown is the velocity w of the step; the displacement is u = u_old + k w.
"""

from space import V, Q, mesh, n, over_contact, at_nodes, positive_part, tangential
from ufl import Coefficient, Constant, TestFunction, TrialFunction, derivative, dot, sqrt

c_n, m, mu, eps, k, heat_share = (Constant(mesh) for _ in range(6))
w, u_old, g, v_F = Coefficient(V), Coefficient(V), Coefficient(Q), Coefficient(V)
v, dw, eta = TestFunction(V), TrialFunction(V), TestFunction(Q)

w_t = tangential(w - v_F)
p_t = mu * c_n * positive_part(dot(u_old + k * w, n) - g) ** m
sigma_t = -p_t * w_t / sqrt(dot(w_t, w_t) + eps**2)

residual = over_contact(-dot(sigma_t, tangential(v)))
jacobian = derivative(residual, w, dw)
traction = at_nodes(dot(sigma_t, v))
heat = over_contact(-heat_share * dot(sigma_t, w_t) * eta)
