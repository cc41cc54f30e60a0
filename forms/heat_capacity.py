"""Stored heat, c dtheta/dt of (2.4)."""

from space import Q, mesh
from ufl import Constant, TestFunction, TrialFunction, dx

c = Constant(mesh)
theta, eta = TrialFunction(Q), TestFunction(Q)

capacity = c * theta * eta * dx
