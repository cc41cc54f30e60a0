"""Inertia, rho du'/dt of (2.3), and the squared L2 norm of a velocity."""

from space import V, mesh
from ufl import Constant, TestFunction, TrialFunction, dx, inner

rho = Constant(mesh)
w, v = TrialFunction(V), TestFunction(V)

mass = rho * inner(w, v) * dx
