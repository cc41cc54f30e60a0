"""Body force f0 of (2.3), interpolated in the space of the displacement."""

from space import V
from ufl import Coefficient, TestFunction, dx, inner

f = Coefficient(V)
v = TestFunction(V)

load = inner(f, v) * dx
