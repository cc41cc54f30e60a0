"""Power law of rough surfaces: p_n(r) = c r_+^m."""

from law import parameter, positive_part

c = parameter(
    "hardness",
    unit="Pa/m^power",
    above=0,
    example=1e3,
    meaning="c in p_n = c r_+^m: the pressure of a penetration of 1 m.",
)
m = parameter("power", at_least=1, default=2.0, meaning="m in p_n = c r_+^m: 1 is a bed of springs.")


def pressure(r):
    return c * positive_part(r) ** m
