"""Coulomb friction: p_t = mu p_n."""

from law import parameter

mu = parameter(
    "coefficient",
    at_least=0,
    example=0.2,
    meaning="Coulomb's friction coefficient mu: the friction bound is mu p_n.",
)


def bound(p_n):
    return mu * p_n
