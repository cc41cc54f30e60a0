"""Thermal part of the stress, -theta M of (2.1), moved to the right-hand side of the momentum balance."""

from space import Q, V, dim, mesh, strain
from ufl import Constant, TestFunction, TrialFunction, dx, inner

M = Constant(mesh, shape=(dim, dim))
theta, v = TrialFunction(Q), TestFunction(V)

coupling = theta * inner(M, strain(v)) * dx
