"""Viscosity: mu1 tr(de) I + mu2 de of the strain rate de."""

from law import parameter
from ufl import Identity, tr

mu1 = parameter(
    "trace",
    unit="Pa s",
    example=10.0,
    meaning="mu1 in the viscous stress mu1 tr(e) I + mu2 e, e the strain rate.",
)
mu2 = parameter(
    "shear",
    unit="Pa s",
    at_least=0,
    example=10.0,
    meaning="mu2 in the viscous stress mu1 tr(e) I + mu2 e, e the strain rate.",
)


def stress(strain_rate):
    return mu1 * tr(strain_rate) * Identity(strain_rate.ufl_shape[0]) + mu2 * strain_rate
