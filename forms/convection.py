"""Heat that a side exchanges with its surroundings: q.n = h (theta - theta_a), theta_a interpolated in the space of theta."""

from space import Q, mesh
from ufl import Coefficient, Constant, TestFunction, TrialFunction, ds

h = Constant(mesh)
theta, eta = TrialFunction(Q), TestFunction(Q)
theta_a = Coefficient(Q)

exchange = h * theta * eta * ds
ambient = h * theta_a * eta * ds
