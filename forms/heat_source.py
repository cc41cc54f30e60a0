"""Heat source q0 of (2.4): interpolated in the space of the temperature, or the law of a file at the points of its rule."""

from in_force import dx_of, is_own, law
from space import Q, mesh, x
from ufl import Coefficient, Constant, TestFunction

eta = TestFunction(Q)
t = Constant(mesh)

q0 = law("source", x=x, t=t) if is_own("source") else Coefficient(Q)

load = q0 * eta * dx_of("source")
