"""Contact conductance (2.10): q.n of r = u.n - g, p_n(r) and theta - theta_F, the law of laws/conductance.py or of a
scene's file."""

from in_force import law
from space import Q, V, n, over_contact, at_nodes
from ufl import Coefficient, TestFunction, TrialFunction, derivative, dot

theta, theta_F = Coefficient(Q), Coefficient(Q)
u, g = Coefficient(V), Coefficient(Q)
eta, dtheta = TestFunction(Q), TrialFunction(Q)

r = dot(u, n) - g
q_n = law("conductance", r=r, s=theta - theta_F, p_n=lambda: law("compliance", r=r))

residual = over_contact(q_n * eta)
jacobian = derivative(residual, theta, dtheta)
heat_flow = at_nodes(q_n * eta)
