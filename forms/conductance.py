"""Contact conductance (2.10): q.n = k_c(u.n - g) phi_L(theta - theta_F).

k_c(r) rises linearly from 0 at r = 0 to k_c at r = eps_c; phi_L(s) = s cut off at -L and L.
"""

from space import Q, V, mesh, n, over_contact, at_nodes
from ufl import Coefficient, Constant, TestFunction, TrialFunction, conditional, derivative, dot, gt, lt

k_c, eps_c, L = Constant(mesh), Constant(mesh), Constant(mesh)
theta, theta_F = Coefficient(Q), Coefficient(Q)
u, g = Coefficient(V), Coefficient(Q)
eta, dtheta = TestFunction(Q), TrialFunction(Q)

r = dot(u, n) - g
s = theta - theta_F
phi_L = conditional(gt(s, L), L, conditional(lt(s, -L), -L, s))
q_n = conditional(lt(r, 0), 0, conditional(gt(r, eps_c), k_c, k_c * r / eps_c)) * phi_L

residual = over_contact(q_n * eta)
jacobian = derivative(residual, theta, dtheta)
heat_flow = at_nodes(q_n * eta)
