"""Scene expressions (muParser's syntax) as functions of numpy arrays.

A recursive-descent parser, one method per level of precedence, loosest first:

    cond ? a : b      ||      &&      < <= > >= == !=      + -      * /      sign      ^ (to the right)

so that -x^2 is -(x^2) and 2^3^2 is 2^9, as in muParser. Truth is 1, falsehood 0.
"""

import re
from collections.abc import Callable, Mapping
from functools import reduce
from typing import Any

import numpy as np
import numpy.typing as npt

from oracle_parts.errors import SceneError

Array = npt.NDArray[np.float64]
Variables = Mapping[str, Array]
Evaluator = Callable[[Variables], Array]
Operation = Callable[[Any, Any], Any]

CONSTANTS = {"pi": np.pi, "e": np.e}
FUNCTIONS: dict[str, Callable[[Array], Array]] = {
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "asin": np.arcsin,
    "acos": np.arccos,
    "atan": np.arctan,
    "sinh": np.sinh,
    "cosh": np.cosh,
    "tanh": np.tanh,
    "exp": np.exp,
    "ln": np.log,
    "log10": np.log10,
    "sqrt": np.sqrt,
    "abs": np.abs,
}
VARIADIC: dict[str, Operation] = {"min": np.minimum, "max": np.maximum}
VARIABLES = ("x", "y", "z", "t")

SUMS: dict[str, Operation] = {"+": np.add, "-": np.subtract}
PRODUCTS: dict[str, Operation] = {"*": np.multiply, "/": np.divide}
COMPARISONS: dict[str, Operation] = {
    "<=": np.less_equal,
    ">=": np.greater_equal,
    "==": np.equal,
    "!=": np.not_equal,
    "<": np.less,
    ">": np.greater,
}
TOKEN = re.compile(
    r"\s*(?:(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)|(?P<name>[A-Za-z_]\w*)"
    r"|(?P<symbol>\|\||&&|<=|>=|==|!=|[-+*/^()<>?:,]))"
)


class Expression:
    """A number or a parsed formula in x, y, z, t; `varies_in_time` tells whether t occurs in it."""

    def __init__(self, source: float | str) -> None:
        self.source = source
        if isinstance(source, str):
            parser = _Parser(source)
            self._evaluate, self.varies_in_time = parser.parse(), "t" in parser.variables
        else:
            self._evaluate, self.varies_in_time = _constant(float(source)), False

    def __call__(self, points: Array, time: float) -> Array:
        """Values at the rows of points[:, (x, y, ...)]."""
        variables = {name: points[:, axis] for axis, name in enumerate("xyz")}
        variables["t"] = np.asarray(time, dtype=np.float64)
        with np.errstate(all="ignore"):  # the branch of ?: that is not taken may be undefined
            values = np.broadcast_to(self._evaluate(variables), points.shape[:1])
        if not np.all(np.isfinite(values)):
            raise SceneError(f"expression {self.source!r} is not finite everywhere at t = {time:g}")
        return np.asarray(values, dtype=np.float64)


def _constant(value: float) -> Evaluator:
    return lambda variables: np.asarray(value)


def _binary(operation: Operation, a: Evaluator, b: Evaluator) -> Evaluator:
    return lambda variables: np.asarray(operation(a(variables), b(variables)), dtype=np.float64)


class _Parser:
    def __init__(self, source: str) -> None:
        self.source = source
        self.variables: set[str] = set()
        self.tokens: list[tuple[str, str]] = []
        position, end = 0, len(source.rstrip())
        while position < end:
            match = TOKEN.match(source, position)
            if match is None:
                raise self.error(f"unexpected '{source[position:].strip()[0]}'")
            self.tokens.append((str(match.lastgroup), match[str(match.lastgroup)]))
            position = match.end()
        self.tokens.append(("end", ""))
        self.next = 0

    def error(self, what: str) -> SceneError:
        return SceneError(f"expression {self.source!r}: {what}")

    def accept(self, *symbols: str) -> str | None:
        kind, text = self.tokens[self.next]
        if kind != "symbol" or text not in symbols:
            return None
        self.next += 1
        return text

    def expect(self, symbol: str) -> None:
        if not self.accept(symbol):
            raise self.error(f"expected '{symbol}' before '{self.tokens[self.next][1] or 'the end'}'")

    def parse(self) -> Evaluator:
        result = self.ternary()
        if self.tokens[self.next][0] != "end":
            raise self.error(f"unexpected '{self.tokens[self.next][1]}'")
        return result

    def ternary(self) -> Evaluator:
        condition = self.disjunction()
        if not self.accept("?"):
            return condition
        yes = self.ternary()
        self.expect(":")
        no = self.ternary()
        return lambda variables: np.where(condition(variables) != 0.0, yes(variables), no(variables))

    def disjunction(self) -> Evaluator:
        left = self.conjunction()
        while self.accept("||"):
            left = _binary(np.logical_or, left, self.conjunction())
        return left

    def conjunction(self) -> Evaluator:
        left = self.comparison()
        while self.accept("&&"):
            left = _binary(np.logical_and, left, self.comparison())
        return left

    def comparison(self) -> Evaluator:
        left = self.sum()
        while operator := self.accept(*COMPARISONS):
            left = _binary(COMPARISONS[operator], left, self.sum())
        return left

    def sum(self) -> Evaluator:
        left = self.product()
        while operator := self.accept(*SUMS):
            left = _binary(SUMS[operator], left, self.product())
        return left

    def product(self) -> Evaluator:
        left = self.signed()
        while operator := self.accept(*PRODUCTS):
            left = _binary(PRODUCTS[operator], left, self.signed())
        return left

    def signed(self) -> Evaluator:
        if self.accept("-"):
            operand = self.power()
            return lambda variables: -operand(variables)
        self.accept("+")
        return self.power()

    def power(self) -> Evaluator:
        base = self.atom()
        if not self.accept("^"):
            return base
        return _binary(np.float_power, base, self.signed())

    def atom(self) -> Evaluator:
        if self.accept("("):
            inner = self.ternary()
            self.expect(")")
            return inner
        kind, text = self.tokens[self.next]
        self.next += 1
        if kind == "number":
            return _constant(float(text))
        if kind == "name":
            return self.call(text) if self.accept("(") else self.named(text)
        raise self.error(f"expected a value before '{text or 'the end'}'")

    def named(self, name: str) -> Evaluator:
        if name in CONSTANTS:
            return _constant(CONSTANTS[name])
        if name not in VARIABLES:
            raise self.error(f"unknown name '{name}'")
        self.variables.add(name)
        return lambda variables: variables[name]

    def call(self, name: str) -> Evaluator:
        arguments = [self.ternary()]
        while self.accept(","):
            arguments.append(self.ternary())
        self.expect(")")
        if name in VARIADIC:
            return reduce(lambda a, b: _binary(VARIADIC[name], a, b), arguments)
        if name not in FUNCTIONS or len(arguments) != 1:
            raise self.error(f"unknown function '{name}' of {len(arguments)} arguments")
        function, argument = FUNCTIONS[name], arguments[0]
        return lambda variables: function(argument(variables))
