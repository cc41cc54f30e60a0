"""Scenes in other units. The schema states the unit of every key; what a number becomes in another system follows.

A system is given by the numbers that 1 m, 1 s, 1 kg and 1 K have in it.
"""

import json
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Final

from matrix_parts.scenes import Flat

BASE: Final = ("m", "s", "kg", "K")
DERIVED: Final = {  # exponents of m, s, kg, K
    "m": (1, 0, 0, 0),
    "s": (0, 1, 0, 0),
    "kg": (0, 0, 1, 0),
    "K": (0, 0, 0, 1),
    "N": (1, -2, 1, 0),
    "Pa": (-1, -2, 1, 0),
    "J": (2, -2, 1, 0),
    "W": (2, -3, 1, 0),
    "": (0, 0, 0, 0),
}
FIELDS: Final = {  # of the results
    "displacement": "m",
    "velocity": "m/s",
    "temperature": "K",
    "stress": "Pa",
    "von_mises": "Pa",
    "gap": "m",
    "pressure": "Pa",
    "traction": "Pa",
    "slip_velocity": "m/s",
    "heat_flow": "W/m^2",
}


@dataclass(frozen=True)
class System:
    """m, s, kg, K: what one of each is in the other system."""

    name: str
    m: float = 1.0
    s: float = 1.0
    kg: float = 1.0
    K: float = 1.0

    def factor(self, unit: str) -> float:
        result = 1.0
        for name, exponent in zip(BASE, exponents(unit)):
            result *= float(getattr(self, name)) ** exponent
        return result


def systems() -> Iterator[System]:
    """Length, time, mass and temperature each by 1e-9 ... 1e9, and all at once."""
    for number in (1e-9, 1e-3, 1e3, 1e9):
        for name in BASE:
            yield System(f"1 {name} = {number:.0e}", **{name: number})
    yield System("mm, ms, g, mK", m=1e3, s=1e3, kg=1e3, K=1e3)
    yield System("all mixed", m=1e6, s=1e-9, kg=1e-7, K=1e5)


def exponents(unit: str) -> tuple[int, ...]:
    """Of m, s, kg, K in a unit such as "W/(m^2 K)"."""
    above, _, below = unit.partition("/")
    total = [0, 0, 0, 0]
    for part, sign in ((above, 1), (below.strip("()"), -1)):
        for word in part.split():
            name, _, power = word.partition("^")
            for i, exponent in enumerate(DERIVED[name]):
                total[i] += sign * exponent * int(power or 1)
    return tuple(total)


class Keys:
    """What the schema says of the keys."""

    def __init__(self, schema: str) -> None:
        self._units = {entry["key"]: entry["unit"] for entry in json.loads(schema)}

    def unit(self, key: str, scene: Mapping[str, Any]) -> str:
        parts = key.split(".")
        if parts[0] in ("boundary", "region"):
            parts[1] = "NAME"
        unit = self._units[".".join(parts)] or ""
        if "^exponent" not in unit:
            return unit
        exponent = float(scene.get(key.replace("stiffness", "exponent"), 1.0))
        if exponent != round(exponent):
            raise ValueError(f"{key}: a fractional exponent is not scaled here")
        return unit.replace("^exponent", f"^{exponent:.0f}")

    def in_units(self, scene: Mapping[str, Any], system: System) -> Flat:
        return {
            key: _scaled(value, system.factor(self.unit(key, scene)), system) for key, value in scene.items()
        }


def _scaled(value: Any, factor: float, system: System) -> Any:
    if isinstance(value, list):
        return [_scaled(entry, factor, system) for entry in value]
    if isinstance(value, str):
        return _expression(value, factor, system) if _is_expression(value) else value
    return value if isinstance(value, (bool, int)) and factor == 1.0 else value * factor


def _is_expression(text: str) -> bool:
    return re.search(r"\b[xyzt]\b|\b\d", text) is not None  # "bdf2" is none


def _expression(text: str, factor: float, system: System) -> str:
    """The same function in the new numbers of space and time."""
    old = {"x": system.m, "y": system.m, "z": system.m, "t": system.s}
    inner = re.sub(r"\b[xyzt]\b", lambda match: f"({match[0]}/{old[match[0]]!r})", text)
    return f"{factor!r}*({inner})"
