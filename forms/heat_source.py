"""Heat source q0 of (2.4), interpolated in the space of the temperature."""

from space import Q
from ufl import Coefficient, TestFunction, dx

q0 = Coefficient(Q)
eta = TestFunction(Q)

load = q0 * eta * dx
