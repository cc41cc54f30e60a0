"""Viscous part of the stress, V eps(du/dt) of (2.1), with a general tensor in Voigt form."""

from space import V, mesh, strain, voigt, voigt_size
from ufl import Constant, TestFunction, TrialFunction, dot, dx, inner

Visc = Constant(mesh, shape=(voigt_size, voigt_size))
w, v = TrialFunction(V), TestFunction(V)

damping = inner(dot(Visc, voigt(strain(w))), voigt(strain(v))) * dx
