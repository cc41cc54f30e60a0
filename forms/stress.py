"""Stress (2.1) integrated over each cell, all three-dimensional components (xx, yy, zz, xy, yz, xz), and von Mises.

In 2D sigma_zz comes from the rows E_zz, Visc_zz, M_zz: those of plane strain, or zero for plane stress.
"""

from in_force import dx_of, tensor
from space import D, Q, S, V, dim, mesh, strain, voigt
from ufl import Coefficient, Constant, TestFunction, as_vector, dot, dx, inner, sqrt

E, E_zz = tensor("elasticity")
Visc, Visc_zz = tensor("viscosity")
M, M_zz = Constant(mesh, shape=(dim, dim)), Constant(mesh)
u, w, theta = Coefficient(V), Coefficient(V), Coefficient(Q)
s = Coefficient(S)
tau, q = TestFunction(S), TestFunction(D)

e, de = voigt(strain(u)), voigt(strain(w))
sigma = dot(E, e) + dot(Visc, de)
if dim == 2:
    zz = dot(E_zz, e) + dot(Visc_zz, de) - theta * M_zz
    components = (
        sigma[0] - theta * M[0, 0],
        sigma[1] - theta * M[1, 1],
        zz,
        sigma[2] - theta * M[0, 1],
        0,
        0,
    )
else:
    normal = tuple(sigma[i] - theta * M[i, i] for i in range(3))
    components = normal + (sigma[5] - theta * M[0, 1], sigma[3] - theta * M[1, 2], sigma[4] - theta * M[0, 2])

squares = (s[0] - s[1]) ** 2 + (s[1] - s[2]) ** 2 + (s[2] - s[0]) ** 2

volume = q * dx
integrated = inner(as_vector(components), tau) * dx_of("elasticity", "viscosity")
von_mises = sqrt(squares / 2 + 3 * (s[3] ** 2 + s[4] ** 2 + s[5] ** 2)) * q * dx
