"""Normal compliance: p_n(r) = c_n r_+^m."""

from law import parameter, positive_part

c_n = parameter(
    "stiffness",
    unit="Pa/m^exponent",
    above=0,
    example=1e4,
    meaning="c_n in the normal pressure p_n(r) = c_n max(r, 0)^exponent of a penetration r.",
)
m = parameter(
    "exponent", at_least=1, default=1.0, example=1.5, meaning="Exponent of the normal compliance law."
)


def pressure(r):
    return c_n * positive_part(r) ** m
