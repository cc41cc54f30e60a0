"""Elasticity: sigma = lambda tr(eps) I + 2 G eps; lambda of plane stress where strains out of the plane are not given."""

from law import parameter
from ufl import Identity, tr

E = parameter(
    "young", unit="Pa", above=0, example=2.1e11, meaning="Young's modulus of an isotropic material."
)
nu = parameter(
    "poisson", above=-1, below=0.5, example=0.3, meaning="Poisson's ratio of an isotropic material."
)


def stress(strain):
    size = strain.ufl_shape[0]
    lame = E * nu / ((1 + nu) * (1 - 2 * nu)) if size == 3 else E * nu / (1 - nu**2)
    return lame * tr(strain) * Identity(size) + E / (1 + nu) * strain
