"""Heat released by strain, R : eps(u) of (2.4), and by its rate, R_rate : eps(du/dt)."""

from space import Q, V, dim, mesh, strain
from ufl import Constant, TestFunction, TrialFunction, dx, inner

R, R_rate = (Constant(mesh, shape=(dim, dim)) for _ in range(2))
u, eta = TrialFunction(V), TestFunction(Q)

coupling = inner(R, strain(u)) * eta * dx
rate_coupling = inner(R_rate, strain(u)) * eta * dx
