"""Heat of a laser whose spot travels along the top: q0 = P exp(-|x - x_s(t)|^2/(2 r^2) - (H - y)/d)/((2 pi)^(n/2) r^n d)."""

from law import parameter
from ufl import exp, pi

P = parameter("power", above=0, example=10.0, meaning="P, absorbed: W, in 2D W/m.")
r = parameter("radius", unit="m", above=0, example=1e-3, meaning="r, over which the spot's light falls off.")
d = parameter(
    "depth", unit="m", above=0, example=1e-4, meaning="d, over which it falls off below the surface."
)
H = parameter("surface", unit="m", example=1.0, meaning="H, height y of the surface.")
start = parameter("start", unit="m", default=0.0, meaning="x of the spot's centre at time 0; its z is 0.")
speed = parameter("speed", unit="m/s", default=0.0, meaning="Velocity of the spot along x.")


def source(x, t):
    n = len(x) - 1  # axes of the surface
    squared = (x[0] - start - speed * t) ** 2 + (x[2] ** 2 if n == 2 else 0)
    return P / ((2 * pi) ** (n / 2) * r**n * d) * exp(-squared / (2 * r**2) - (H - x[1]) / d)
