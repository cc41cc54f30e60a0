"""Viscous part of the stress, V eps(du/dt) of (2.1), with a general tensor in Voigt form: that of the scene, or of its law file."""

from in_force import dx_of, tensor
from space import V, strain, voigt
from ufl import TestFunction, TrialFunction, dot, inner

Visc, _ = tensor("viscosity")
w, v = TrialFunction(V), TestFunction(V)

damping = inner(dot(Visc, voigt(strain(w))), voigt(strain(v))) * dx_of("viscosity")
