"""Contact conductance: q.n = k_c(r) phi_L(s), k_c rising linearly up to r = eps_c, phi_L(s) = s cut off at -L and L."""

from law import parameter
from ufl import conditional, gt, lt

k_c = parameter(
    "coefficient",
    unit="W/(m^2 K)",
    at_least=0,
    example=1.0,
    meaning="Heat transfer coefficient k_c of closed contact.",
)
eps_c = parameter(
    "onset",
    unit="m",
    above=0,
    example=1e-5,
    meaning="Penetration over which the heat transfer coefficient rises from 0 to its full value.",
)
L = parameter(
    "limit",
    unit="K",
    above=0,
    default=float("inf"),
    example=100.0,
    meaning="Largest temperature difference that drives the heat flow; absent: unlimited.",
    width=True,
)


def heat_flux(r, s):
    phi_L = conditional(gt(s, L), L, conditional(lt(s, -L), -L, s))
    return conditional(lt(r, 0), 0, conditional(gt(r, eps_c), k_c, k_c * r / eps_c)) * phi_L
