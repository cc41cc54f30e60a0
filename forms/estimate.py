"""What recovered gradients leave of the discrete ones, cell by cell, in the norms of energy: squares of the estimated
error, and of the fields themselves. G0, G1, G2: recovered gradients of the displacement's (or velocity's) components, H
that of the temperature."""

from in_force import dx_of, tensor
from space import D, Q, V, dim, mesh, strain, voigt
from ufl import Coefficient, Constant, TestFunction, as_matrix, dot, dx, grad, sym

(E, _), (Visc, _) = tensor("elasticity"), tensor("viscosity")
K = Constant(mesh, shape=(dim, dim))
u, w, theta = Coefficient(V), Coefficient(V), Coefficient(Q)
G0, G1, G2, H = Coefficient(V), Coefficient(V), Coefficient(V), Coefficient(V)
q = TestFunction(D)

rows = (G0, G1, G2)[:dim]
recovered = voigt(sym(as_matrix([[row[j] for j in range(dim)] for row in rows])))
elastic_rest = recovered - voigt(strain(u))
viscous_rest = recovered - voigt(strain(w))
heat_rest = H - grad(theta)

elastic_error = dot(dot(E, elastic_rest), elastic_rest) * q * dx_of("elasticity")
viscous_error = dot(dot(Visc, viscous_rest), viscous_rest) * q * dx_of("viscosity")
heat_error = dot(dot(K, heat_rest), heat_rest) * q * dx
elastic_energy = dot(dot(E, voigt(strain(u))), voigt(strain(u))) * q * dx_of("elasticity")
viscous_energy = dot(dot(Visc, voigt(strain(w))), voigt(strain(w))) * q * dx_of("viscosity")
heat_energy = dot(dot(K, grad(theta)), grad(theta)) * q * dx
