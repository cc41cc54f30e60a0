"""What a law file says of itself, and whether it can be a law: tried on numbers before any kernel is made of it."""

import itertools
import math

import describe_body
import in_force
import law as law_file
import space
import ufl
from in_force import LawError
from ufl.algorithms import expand_derivatives

# What a law is tried on: contact that is open, touches, and is closed; speeds are at least eps > 0
TRIED = {"r": (-0.5, 0.0, 0.5), "p_n": (0.0, 2.0), "speed": (1e-3, 1.0), "s": (-1.5, 0.0, 1.5)}
# What the forms differentiate a law by, where it takes it; the first has to matter
UNKNOWNS = {"compliance": ("r",), "friction": ("p_n", "speed"), "conductance": ("s",)}


def description(kind, path):
    """Everything of a law file that the driver wants to know, as JSON takes it. Raises LawError."""
    space.select("triangle", 1)
    in_force.replace({kind: path})
    the_law = in_force.loaded(kind)
    _expect_widths(kind, the_law)
    refused = {}
    if kind in describe_body.KINDS:
        refused = describe_body.refused(kind)
    else:
        _try(kind, the_law)
    return {
        "kind": kind,
        "title": the_law.title,
        "line": the_law.line,
        "refused": refused,
        "function": in_force.FUNCTIONS[kind][0],
        "possible": list(in_force.FUNCTIONS[kind][1]),
        "takes": list(the_law.arguments),
        "parameters": [
            {"name": name, **law_file.declared_as(value)} for name, value in the_law.parameters.items()
        ],
    }


def _expect_widths(kind, the_law):
    widths = [name for name, value in the_law.parameters.items() if law_file.declared_as(value)["width"]]
    if widths and (kind != "conductance" or len(widths) > 1):
        raise LawError(
            the_law.line, f"{' and '.join(widths)}: only a conductance has a width, and one of its parameters"
        )


def _try(kind, the_law):
    """The law and its derivatives must be finite numbers, and what it must depend on must matter."""
    points = {name: ufl.Constant(space.mesh) for name in the_law.arguments}
    unknowns = {name: ufl.variable(points[name]) for name in UNKNOWNS[kind] if name in points}
    function = the_law.function.__name__
    needed = UNKNOWNS[kind][0]
    if needed not in points:
        raise LawError(the_law.line, f"{function} does not take {needed}")
    value = the_law({**points, **unknowns})
    in_force.expect_given(the_law, value, points.values())
    slopes = {name: expand_derivatives(ufl.diff(value, variable)) for name, variable in unknowns.items()}
    if isinstance(slopes[needed], ufl.constantvalue.Zero):
        raise LawError(the_law.line, f"{function} does not depend on {needed}")
    numbers = {
        constant: law_file.declared_as(constant)["example"] for constant in the_law.parameters.values()
    }
    for place in itertools.product(*(TRIED[name] for name in the_law.arguments)):
        at = dict(zip(the_law.arguments, place))
        mapping = {**numbers, **{points[name]: number for name, number in at.items()}}
        _expect_finite(the_law, f"{function} is", value, at, mapping)
        for name, slope in slopes.items():
            _expect_finite(the_law, f"the derivative of {function} by {name} is", slope, at, mapping)


def _expect_finite(the_law, what, expression, at, mapping):
    try:
        number = ufl.as_ufl(expression)((), mapping)
        found = f"{number:g}" if isinstance(number, (int, float)) else f"{number}"
        if isinstance(number, (int, float)) and math.isfinite(number):
            return
    except (ArithmeticError, ValueError) as error:
        found = in_force.said(error)
    values = {
        law_file.declared_as(constant)["key"]: mapping[constant] for constant in the_law.parameters.values()
    }
    where = ", ".join(f"{name} = {number:g}" for name, number in {**at, **values}.items())
    raise LawError(the_law.line, f"{what} no finite number at {where}: {found}")
