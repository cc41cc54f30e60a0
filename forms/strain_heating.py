"""Heat released by strain, R : eps(u) of (2.4)."""

from space import Q, V, dim, mesh, strain
from ufl import Constant, TestFunction, TrialFunction, dx, inner

R = Constant(mesh, shape=(dim, dim))
u, eta = TrialFunction(V), TestFunction(Q)

coupling = inner(R, strain(u)) * eta * dx
