"""Heat flux into the body, -q.n, prescribed on a side and interpolated in the space of the temperature."""

from space import Q
from ufl import Coefficient, TestFunction, ds

flux = Coefficient(Q)
eta = TestFunction(Q)

load = flux * eta * ds
