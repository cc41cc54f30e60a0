"""Centrifugal force about the axis x = c, spun up to omega over a time T: f = rho omega^2 min(t/T, 1)^2 (x - c)."""

from law import parameter
from ufl import as_vector, conditional, lt

rho = parameter("density", unit="kg/m^3", above=0, example=1.0, meaning="Density of what turns.")
omega = parameter("angular_velocity", unit="1/s", example=1.0, meaning="omega, reached at the time T.")
T = parameter("spin_up", unit="s", above=0, example=1.0, meaning="T, over which the body is spun up.")
c = parameter("axis", unit="m", default=0.0, meaning="c, where the axis, parallel to y, meets the x axis.")


def force(x, t):
    now = omega * conditional(lt(t, T), t / T, 1)
    return as_vector([rho * now**2 * (x[0] - c)] + [0] * (len(x) - 1))
