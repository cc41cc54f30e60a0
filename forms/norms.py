"""Gram matrices of the norms: those reported, ||w||_L2, ||eps(u)||_L2 (that of V), ||theta||_L2, and those of the
theory's inequalities (2.12)-(2.15), ||grad(theta)||_L2 (that of Q) and the L2 norms of traces on a boundary."""

from space import Q, V, strain
from ufl import TestFunction, TrialFunction, dot, ds, dx, grad, inner

u, v = TrialFunction(V), TestFunction(V)
theta, eta = TrialFunction(Q), TestFunction(Q)

velocity = inner(u, v) * dx
strains = inner(strain(u), strain(v)) * dx
temperature = theta * eta * dx
gradients = dot(grad(theta), grad(eta)) * dx
velocity_trace = inner(u, v) * ds
temperature_trace = theta * eta * ds
