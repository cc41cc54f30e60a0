"""What the laws of a scene's files are at the points of their rule, times the weights: see `weights`. Compiled for such
scenes alone."""

from in_force import dx_of, is_own, law, stress_rows
from space import dim, mesh, points, x
from ufl import Constant, TestFunction, as_vector, inner

KINDS = ("elasticity", "viscosity", "source", "body_force")

one, force, tensor = (TestFunction(points(size)) for size in (1, dim, 6 * (6 if dim == 3 else 3)))
t = Constant(mesh)
dx = dx_of(*KINDS)


def flat(rows):
    return as_vector([entry for row in rows for entry in row])


weights = one[0] * dx
if is_own("elasticity"):
    E = inner(flat(stress_rows("elasticity")), tensor) * dx
if is_own("viscosity"):
    Visc = inner(flat(stress_rows("viscosity")), tensor) * dx
if is_own("source"):
    q0 = law("source", x=x, t=t) * one[0] * dx
if is_own("body_force"):
    f = inner(law("body_force", x=x, t=t), force) * dx
