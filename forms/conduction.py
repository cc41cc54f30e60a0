"""Fourier's law, q = -K grad(theta) of (2.2), with a general symmetric tensor."""

from space import Q, dim, mesh
from ufl import Constant, TestFunction, TrialFunction, dot, dx, grad

K = Constant(mesh, shape=(dim, dim))
theta, eta = TrialFunction(Q), TestFunction(Q)

conduction = dot(dot(K, grad(theta)), grad(eta)) * dx
