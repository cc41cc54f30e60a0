"""Gram matrices of the norms that are reported: ||w||_L2, ||eps(u)||_L2, ||theta||_L2."""

from space import Q, V, strain
from ufl import TestFunction, TrialFunction, dx, inner

u, v = TrialFunction(V), TestFunction(V)
theta, eta = TrialFunction(Q), TestFunction(Q)

velocity = inner(u, v) * dx
strains = inner(strain(u), strain(v)) * dx
temperature = theta * eta * dx
