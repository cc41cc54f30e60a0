"""Elastic part of the stress, E eps(u) of (2.1), with a general tensor in Voigt form."""

from space import V, mesh, strain, voigt, voigt_size
from ufl import Constant, TestFunction, TrialFunction, dot, dx, inner

E = Constant(mesh, shape=(voigt_size, voigt_size))
u, v = TrialFunction(V), TestFunction(V)

stiffness = inner(dot(E, voigt(strain(u))), voigt(strain(v))) * dx
