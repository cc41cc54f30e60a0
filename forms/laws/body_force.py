"""Body force: f0(x, t), to be written; that of a scene without a file is the expressions of the key."""

from law import parameter
from ufl import as_vector

f = parameter("weight", unit="N/m^3", example=9.81, meaning="Force per volume, along -y.")


def force(x, t):
    return as_vector([-f if axis == 1 else 0 for axis in range(len(x))])
