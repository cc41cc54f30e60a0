"""Normal compliance (2.8): -sigma_n = p_n(u.n - g) with p_n(r) = c_n r_+^m.

The unknown is the velocity w of the step; the displacement is u = u_old + k w.
"""

from space import Q, V, mesh, n, over_contact, at_nodes, positive_part
from ufl import Coefficient, Constant, TestFunction, TrialFunction, derivative, dot

c_n, m, k = Constant(mesh), Constant(mesh), Constant(mesh)
w, u_old, g = Coefficient(V), Coefficient(V), Coefficient(Q)
v, dw, q = TestFunction(V), TrialFunction(V), TestFunction(Q)

p_n = c_n * positive_part(dot(u_old + k * w, n) - g) ** m

residual = over_contact(p_n * dot(v, n))
jacobian = derivative(residual, w, dw)
normal_force = over_contact(p_n)
pressure = at_nodes(p_n * q)
