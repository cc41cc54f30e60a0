"""Body force f0 of (2.3): interpolated in the space of the displacement, or the law of a file at the points of its rule."""

from in_force import dx_of, is_own, law
from space import V, mesh, x
from ufl import Coefficient, Constant, TestFunction, inner

v = TestFunction(V)
t = Constant(mesh)

f = law("body_force", x=x, t=t) if is_own("body_force") else Coefficient(V)

load = inner(f, v) * dx_of("body_force")
