"""Kinematics of contact: current gap g - u.n, slip velocity w_t over the foundation, which moves with v_F, and the
areas that are closed and that slip."""

from space import Q, V, at_nodes, mesh, n, over_contact, tangential
from ufl import Coefficient, Constant, TestFunction, as_ufl, conditional, dot, ge, gt, sqrt

eps = Constant(mesh)
u, w, g, v_F = Coefficient(V), Coefficient(V), Coefficient(Q), Coefficient(V)
v, q = TestFunction(V), TestFunction(Q)

w_t = tangential(w - v_F)
closed = conditional(ge(dot(u, n) - g, 0), 1.0, 0.0)
slips = conditional(gt(sqrt(dot(w_t, w_t)), eps), 1.0, 0.0)

area = over_contact(as_ufl(1.0))
closed_area = over_contact(closed)
slip_area = over_contact(closed * slips)
node_area = at_nodes(q)
gap = at_nodes((g - dot(u, n)) * q)
slip_velocity = at_nodes(dot(w_t, v))
