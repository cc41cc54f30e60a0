"""UFL expressions of x and t as expressions of a scene file."""

from typing import Any

import ufl
from ufl.algorithms.apply_algebra_lowering import apply_algebra_lowering
from ufl.algorithms.apply_derivatives import apply_derivatives
from ufl.constantvalue import ScalarValue, Zero

from manufactured_parts.strong_form import rate

INFIX = {ufl.classes.Sum: " + ", ufl.classes.Product: "*", ufl.classes.Division: "/", ufl.classes.Power: "^"}


class Printer:
    """A point x of a mesh and a time t to write fields with, and their text."""

    def __init__(self, cell: str, dim: int) -> None:
        mesh = ufl.Mesh(vector_element(cell, dim))
        self.x, self.t = ufl.SpatialCoordinate(mesh), ufl.variable(ufl.Constant(mesh))

    def components(self, field: Any) -> list[str]:
        """The components of a vector, or of a scalar as the only one."""
        if field.ufl_shape == ():
            return [self.text(field)]
        return [self.text(field[i]) for i in range(field.ufl_shape[0])]

    def rate(self, field: Any) -> Any:
        return rate(field, self.t)

    def text(self, field: Any) -> str:
        """Of a scalar."""
        return self._text(apply_derivatives(apply_algebra_lowering(ufl.as_ufl(field))))

    def _text(self, node: Any) -> str:
        operands = node.ufl_operands
        if isinstance(node, Zero):
            return "0"
        if isinstance(node, ScalarValue):
            return f"({float(node)!r})"
        if isinstance(node, ufl.classes.Variable):
            return "t"
        if isinstance(node, ufl.classes.Indexed):
            return self._component(operands[0], int(operands[1][0]))
        if isinstance(node, ufl.classes.MathFunction):
            return f"{node._name}({self._text(operands[0])})"
        for kind, symbol in INFIX.items():
            if isinstance(node, kind):
                return f"({symbol.join(self._text(operand) for operand in operands)})"
        raise TypeError(f"no scene expression for {type(node).__name__}: {node}")

    def _component(self, vector: Any, index: int) -> str:
        if isinstance(vector, ufl.classes.ListTensor):
            return self._text(vector.ufl_operands[index])
        if vector == self.x:
            return "xyz"[index]
        raise TypeError(f"no scene expression for a component of {vector}")


def vector_element(cell: str, dim: int) -> Any:
    """The coordinate element, for the new (Basix) and the old (UFL) way of naming it."""
    try:
        import basix.ufl

        return basix.ufl.element("Lagrange", cell, 1, shape=(dim,))
    except ImportError:
        return ufl.VectorElement("Lagrange", cell, 1, dim=dim)
