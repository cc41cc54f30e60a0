"""Friction that weakens with the speed v of slip (Stribeck): p_t = (mu_d + (mu_s - mu_d) exp(-v/v_s)) p_n."""

from law import parameter
from ufl import exp

mu_s = parameter("static", at_least=0, example=0.4, meaning="mu_s, the friction coefficient at rest.")
mu_d = parameter("kinetic", at_least=0, example=0.2, meaning="mu_d, the friction coefficient of fast slip.")
v_s = parameter(
    "stribeck_velocity",
    unit="m/s",
    above=0,
    example=0.1,
    meaning="v_s, over which friction falls from one to the other.",
)


def bound(p_n, speed):
    return (mu_d + (mu_s - mu_d) * exp(-speed / v_s)) * p_n
