"""Traction f1 of (2.6), interpolated in the space of the displacement."""

from space import V
from ufl import Coefficient, TestFunction, ds, inner

f = Coefficient(V)
v = TestFunction(V)

load = inner(f, v) * ds
