"""Whether the law of a file can be one of elasticity or viscosity, a heat source or a body force, and of which bodies.

What it is at the points of a mesh, with the numbers of a scene, is judged there: that it is finite, symmetric and not
negative (src/model/law_samples.h). Here only what does not depend on these.
"""

import math

import in_force
import law as law_file
import space
import ufl
from in_force import LawError
from ufl.algorithms import expand_derivatives, extract_type

KINDS = (*in_force.TENSORS, *in_force.LOADS)
BODIES = {
    "plane stress": ("triangle", False),
    "plane strain": ("triangle", True),
    "space": ("tetrahedron", False),
}
PLACES = ((0.3, 0.4, 0.2), (-0.3, -0.4, -0.2), (30.0, 70.0, 50.0))


def refused(kind):
    """The bodies that the law in force cannot be of, with "LINE: why"; LawError where there is no other."""
    errors = {}
    for body, (cell, plane_strain) in BODIES.items():
        space.select(cell, 1)
        in_force.replace({}, plane_strain)  # read again: its constants belong to a mesh
        try:
            _try(kind, in_force.loaded(kind))
        except LawError as error:
            errors[body] = error
    if len(errors) == len(BODIES):
        raise errors["space"]
    return {body: f"{error.line}: {error}" for body, error in errors.items()}


def _try(kind, the_law):
    given = {"x": space.x, "t": ufl.Constant(space.mesh)}
    if kind in in_force.LOADS:
        in_force.expect_given(the_law, the_law(given), given.values())
        return
    name, function = in_force.FUNCTIONS[kind][1][0], the_law.function.__name__
    if name not in the_law.arguments:
        raise LawError(the_law.line, f"{function} does not take {name}")
    strain = ufl.Constant(space.mesh, shape=the_law.shape)
    variable = ufl.variable(strain)
    value = the_law({**given, name: variable})
    in_force.expect_given(the_law, value, (strain, space.x))
    try:
        slope = expand_derivatives(ufl.diff(value, variable))
    except Exception as error:
        raise LawError(
            the_law.line, f"{function} has no derivative by {name}: {in_force.said(error)}"
        ) from error
    if strain in extract_type(slope, ufl.Constant):
        raise LawError(
            the_law.line,
            f"{function} is not linear in {name}: its derivative depends on {name} again. Only linear laws can be: "
            "operators of the body are assembled and factored once, and the balances of energy are those of a "
            "quadratic energy",
        )
    if isinstance(slope, ufl.constantvalue.Zero):
        raise LawError(the_law.line, f"{function} does not depend on {name}")
    _expect_no_prestress(the_law, name, given)
    _expect_symmetric_stress(kind, the_law)


def _expect_no_prestress(the_law, name, given):
    """Of a law that is linear but for a constant, by its numbers where its parameters are as in their examples."""
    size = the_law.shape[0]
    at_rest = the_law({**given, name: ufl.as_matrix(size * [size * [0.0]])})
    for place in PLACES:
        for i in range(size):
            for j in range(size):
                if _number(the_law, at_rest[i, j], place) not in (0.0, None):
                    raise LawError(
                        the_law.line,
                        f"{the_law.function.__name__} is not zero where {name} is: a stress that is always there is a load",
                    )


def _expect_symmetric_stress(kind, the_law):
    """sigma = sigma^T of every unit strain, as far as it can be evaluated."""
    for stress in in_force.unit_stresses(kind):
        for place in PLACES:
            for i in range(the_law.shape[0]):
                for j in range(i):
                    one, other = (_number(the_law, stress[a, b], place) for a, b in ((i, j), (j, i)))
                    if None not in (one, other) and abs(one - other) > 1e-12 * max(abs(one), abs(other)):
                        function = the_law.function.__name__
                        raise LawError(
                            the_law.line,
                            f"{function} is no symmetric tensor: {function}[{i}, {j}] differs from [{j}, {i}]",
                        )


def _number(the_law, expression, place):
    """None where it cannot be evaluated: the place may be out of the law's domain."""
    numbers = {
        constant: law_file.declared_as(constant)["example"] for constant in the_law.parameters.values()
    }
    try:
        number = expand_derivatives(expression)(place, numbers)
        return number if math.isfinite(number) else None
    except (ArithmeticError, ValueError, TypeError):
        return None
