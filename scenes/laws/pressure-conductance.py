"""Conductance of rough surfaces under pressure (Cooper, Mikic, Yovanovich): q.n = k_1 (p_n/H)^0.95 s."""

from law import parameter

k_1 = parameter(
    "coefficient",
    unit="W/(m^2 K)",
    above=0,
    example=10.0,
    meaning="k_1, the heat transfer coefficient at the pressure H.",
)
H = parameter("hardness", unit="Pa", above=0, example=5.0, meaning="H, the hardness of the softer surface.")
n = parameter("power", above=0, default=0.95, meaning="Power of the pressure; 0.95 in the cited theory.")


def heat_flux(p_n, s):
    return k_1 * (p_n / H) ** n * s
