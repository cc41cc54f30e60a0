"""Heat source: q0(x, t), to be written; that of a scene without a file is the expression of the key."""

from law import parameter

q = parameter("power", unit="W/m^3", example=1.0, meaning="Heat produced per volume.")


def source(x, t):
    return q
