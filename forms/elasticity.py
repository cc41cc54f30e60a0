"""Elastic part of the stress, E eps(u) of (2.1), with a general tensor in Voigt form: that of the scene, or of its law file."""

from in_force import dx_of, tensor
from space import V, strain, voigt
from ufl import TestFunction, TrialFunction, dot, inner

E, _ = tensor("elasticity")
u, v = TrialFunction(V), TestFunction(V)

stiffness = inner(dot(E, voigt(strain(u))), voigt(strain(v))) * dx_of("elasticity")
