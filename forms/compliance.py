"""Normal compliance (2.8): -sigma_n = p_n(u.n - g), p_n the law of laws/compliance.py or of a scene's file.

The unknown is the velocity w of the step; the displacement is u = u_old + k w.
"""

from in_force import law
from space import Q, V, mesh, n, over_contact, at_nodes
from ufl import Coefficient, Constant, TestFunction, TrialFunction, derivative, dot

k = Constant(mesh)
w, u_old, g = Coefficient(V), Coefficient(V), Coefficient(Q)
v, dw, q = TestFunction(V), TrialFunction(V), TestFunction(Q)

p_n = law("compliance", r=dot(u_old + k * w, n) - g)

residual = over_contact(p_n * dot(v, n))
jacobian = derivative(residual, w, dw)
normal_force = over_contact(p_n)
pressure = at_nodes(p_n * q)
