"""Springs that hold a side: sigma n = -k_s (u - u_s), u_s where their far ends are, interpolated in the space of u."""

from space import V, dim, mesh
from ufl import Constant, TestFunction, TrialFunction, dot, ds, inner

k_s = Constant(mesh, shape=(dim, dim))
u, v = TrialFunction(V), TestFunction(V)

stiffness = inner(dot(k_s, u), v) * ds
