"""Law files that a scene names ([forms]), read with a module `law` of the oracle's own in place of the driver's."""

import inspect
import math
import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import numpy.typing as npt
import ufl

from oracle_parts.errors import SceneError

Array = npt.NDArray[np.float64]
FUNCTIONS = {
    "compliance": "pressure",
    "friction": "bound",
    "conductance": "heat_flux",
    "elasticity": "stress",
    "viscosity": "stress",
    "source": "source",
    "body_force": "force",
}


@dataclass(frozen=True)
class Declared:
    """What a file says of one of its constants."""

    key: str
    default: float | None
    above: float
    at_least: float
    below: float
    at_most: float

    def admits(self, value: float) -> bool:
        inside = self.above < value and self.at_least <= value <= self.at_most and value < self.below
        return inside or (value == math.inf and self.default == math.inf)


@dataclass(frozen=True)
class OwnLaw:
    """A law file, and the numbers of one of its tables by key."""

    kind: str
    path: Path
    numbers: dict[str, float] = field(default_factory=dict)

    def execute(self, constant: Callable[[Declared], Any]) -> tuple[Callable[..., Any], list[Declared]]:
        """The law's function, its constants made by `constant`, and what it declares."""
        declared: list[Declared] = []

        def parameter(key: str, *, default: float | None = None, **facts: Any) -> Any:
            low, high = -math.inf, math.inf
            bounds = (
                facts.get(name, unlimited)
                for name, unlimited in (("above", low), ("at_least", low), ("below", high), ("at_most", high))
            )
            declared.append(Declared(key, default, *bounds))
            return constant(declared[-1])

        module = ModuleType("law")
        vars(module).update(parameter=parameter, positive_part=lambda r: ufl.conditional(r >= 0.0, r, 0.0))
        before = sys.modules.get("law")
        sys.modules["law"] = module
        namespace: dict[str, Any] = {"__name__": self.path.stem}
        try:
            exec(compile(self.path.read_text(encoding="utf-8"), str(self.path), "exec"), namespace)
            return namespace[FUNCTIONS[self.kind]], declared
        except Exception as problem:
            raise SceneError(f"{self.path}: {type(problem).__name__}: {problem}") from problem
        finally:
            del sys.modules["law"]
            if before is not None:
                sys.modules["law"] = before

    def declarations(self) -> list[Declared]:
        mesh = (
            ufl.Mesh(ufl.VectorElement("Lagrange", ufl.triangle, 1))
            if hasattr(ufl, "VectorElement")
            else None
        )
        return self.execute(lambda _: ufl.Constant(mesh) if mesh else ufl.as_ufl(1.0))[1]


class LawOnMesh:
    """The law as an expression, and its values where what it takes is known."""

    def __init__(self, law: OwnLaw, constant: Callable[[float], Any]) -> None:
        self.constants: list[tuple[Any, float]] = []

        def make(declared: Declared) -> Any:
            self.constants.append((constant(law.numbers[declared.key]), law.numbers[declared.key]))
            return self.constants[-1][0]

        self.function, _ = law.execute(make)
        self.takes = tuple(inspect.signature(self.function).parameters)
        self.constant = constant

    def __call__(self, **given: Any) -> Any:
        value = self.function(**{name: given[name] for name in self.takes})
        return ufl.as_vector(value) if isinstance(value, (tuple, list)) else ufl.as_ufl(value)

    def at(self, slope: str = "", **given: Array) -> Array:
        """The values where what it takes has these, or those of its derivative by `slope`."""
        terminals = {name: self.constant(0.0) for name in self.takes}
        variables = {name: ufl.variable(terminal) for name, terminal in terminals.items()}
        expression = self(**variables)
        if slope:
            if slope not in self.takes:
                return np.zeros(np.broadcast(*given.values()).shape)
            expression = ufl.algorithms.expand_derivatives(ufl.diff(expression, variables[slope]))

        def value(*numbers: float) -> float:
            known = dict(self.constants) | dict(zip(terminals.values(), map(float, numbers)))
            return float(expression((), known))

        shape = np.broadcast_shapes(*(np.shape(given[name]) for name in self.takes))
        if 0 in shape:
            return np.zeros(shape)
        result: Array = np.vectorize(value, otypes=[np.float64])(*(given[name] for name in self.takes))
        return result
