"""Elasticity of a body with fibres, stiffer towards the bottom: sigma = s(x) (lambda tr(e) I + 2 G e + b (e : A) A)."""

from law import parameter
from ufl import Identity, as_vector, cos, inner, outer, pi, sin, tr

E = parameter("young", unit="Pa", above=0, example=1e9, meaning="Young's modulus between the fibres, on top.")
nu = parameter("poisson", above=-1, below=0.5, example=0.3, meaning="Poisson's ratio between the fibres.")
b = parameter(
    "fibres", unit="Pa", at_least=0, example=1e10, meaning="b, what the fibres add along themselves, on top."
)
angle = parameter(
    "angle", unit="degrees", default=0.0, meaning="Of the fibres to the x axis, in its plane with y."
)
top = parameter("top", unit="m", default=1.0, meaning="Height y where s = 1.")
gradient = parameter(
    "gradient", unit="1/m", default=0.0, meaning="By which s = 1 + gradient (top - y) grows with the depth."
)


def stress(strain, x):
    size = strain.ufl_shape[0]
    if size == 2:
        raise ValueError('needs plane = "strain": in plane stress the thickness follows')
    G, lame = E / (2 * (1 + nu)), E * nu / ((1 + nu) * (1 - 2 * nu))
    a = as_vector([cos(angle * pi / 180), sin(angle * pi / 180), 0])
    A = outer(a, a)
    matrix = lame * tr(strain) * Identity(size) + 2 * G * strain
    return (1 + gradient * (top - x[1])) * (matrix + b * inner(strain, A) * A)
