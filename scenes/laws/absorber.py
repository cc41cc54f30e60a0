"""Viscosity that grows towards the right, so that waves die away there: mu(x) e, mu = mu_0 + mu_1 (x - x_0)_+^2."""

from law import parameter, positive_part

mu_0 = parameter("shear", unit="Pa s", at_least=0, example=1.0, meaning="mu_0, that of the whole body.")
mu_1 = parameter("growth", unit="Pa s/m^2", at_least=0, example=10.0, meaning="mu_1, of the absorbing end.")
x_0 = parameter("start", unit="m", example=0.5, meaning="x_0, where the absorbing end begins.")


def stress(strain_rate, x):
    return (mu_0 + mu_1 * positive_part(x[0] - x_0) ** 2) * strain_rate
