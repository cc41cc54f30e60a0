"""What the tables of variations must hold, as the driver's own schema demands it; anything missing is named."""

import json
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from matrix_parts.cases import Case, Variation, generic
from matrix_parts.scenes import ABSENT, BASES, DIMENSION, SIDES, is_below

Entry = Mapping[str, Any]  # one key of the schema
FEW = 20  # an integer key with no more values than this has every one of them tried
FREE = "free"


def is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def is_expression(value: Any) -> bool:
    return isinstance(value, str) and not is_free(value)


def is_free(value: Any) -> bool:
    return isinstance(value, str) and str(value) == FREE


def is_empty(value: Any) -> bool:
    return isinstance(value, list) and not value


def is_matrix(value: Any) -> bool:
    return isinstance(value, list) and any(isinstance(row, list) for row in value)


def has(what: Callable[[Any], bool]) -> Callable[[Any], bool]:
    return lambda value: isinstance(value, list) and any(what(entry) for entry in value)


TENSOR = {"a number": is_number, "a matrix that is not isotropic": is_matrix}
EXPRESSION = {"a number": is_number, "an expression": is_expression}
EXPRESSIONS = {"a number": has(is_number), "an expression": has(is_expression)}
# The forms that a value of each type takes, each to be tried. A type that is not here is a failure too.
FORMS: Mapping[str, Mapping[str, Callable[[Any], bool]]] = {
    "string": {"a string": lambda value: isinstance(value, str)},
    "number": {"a number": is_number},
    "integer": {"an integer": is_number},
    "choice": {},
    "integer or choice": {"an integer": is_number},
    "list of choices": {"an empty list": is_empty},
    "expression": EXPRESSION,
    "positive semidefinite tensor": TENSOR,
    "symmetric tensor": TENSOR,
    "positive semidefinite Voigt matrix": {"a matrix": is_matrix},
}
# What the cross checks of the scenes brake-pad and press-fit try, beside the matrix
ELSEWHERE = ("mesh.file", "region")
# and of "2 numbers", "d expressions or free" and so on, by what follows the number
LIST_FORMS: Mapping[str, Mapping[str, Callable[[Any], bool]]] = {
    "numbers": {"numbers": has(is_number)},
    "integers": {"integers": has(is_number)},
    "expressions": EXPRESSIONS,
    "expressions or free": {**EXPRESSIONS, "a free component": has(is_free)},
}


@dataclass(frozen=True)
class Table:
    """The variations of bodies of one shape. `alike`: keys without any, and why those of another shape are enough."""

    shape: str
    variations: Mapping[str, Sequence[Variation]]
    alike: Mapping[str, str] = field(default_factory=dict)

    @property
    def variables(self) -> set[str]:
        return set("xyz"[: DIMENSION[self.shape]])


def gaps(schema: Sequence[Entry], tables: Sequence[Table], cases: Sequence[Case]) -> list[str]:
    """Everything that the schema has and the matrix does not try, or the other way round."""
    schema = [entry for entry in schema if not _is_elsewhere(str(entry["key"]))]
    found = [gap for table in tables for gap in _gaps_in(schema, table)]
    shapes = {table.shape for table in tables}
    for entry in schema:
        if entry["key"] == "mesh.shape":
            found += [
                f"mesh.shape: no table of the shape {shape}"
                for shape in entry["choices"]
                if shape not in shapes
            ]
    return found + [gap for table in tables for gap in _sides_without(schema, table.shape, cases)]


def _is_elsewhere(key: str) -> bool:
    return any(is_below(key, prefix) for prefix in ELSEWHERE)


def _gaps_in(schema: Sequence[Entry], table: Table) -> list[str]:
    keys = [str(entry["key"]) for entry in schema]
    name = f"in the table of the {table.shape}"
    listed = [*table.variations, *table.alike]
    found = [f"{key}: in the schema, but no variation of it {name}" for key in keys if key not in listed]
    found += [f"{key}: {name}, but not in the schema" for key in listed if key not in keys]
    found += [f"{key}: alike, but has variations {name}" for key in table.alike if key in table.variations]
    for entry in schema:
        if variations := table.variations.get(str(entry["key"])):
            own = _of_shape(entry, table.shape)
            found += [f"{entry['key']}: {gap} {name}" for gap in _gaps_of(own, variations, table.variables)]
    return found


def _of_shape(entry: Entry, shape: str) -> Entry:
    """Of the shapes only its own can be chosen."""
    return {**entry, "choices": [shape]} if entry["key"] == "mesh.shape" else entry


def _gaps_of(entry: Entry, variations: Sequence[Variation], variables: set[str]) -> list[str]:
    key = str(entry["key"])
    touching = [variation for variation in variations if _touches(variation, key)]
    found = [] if len(touching) == len(variations) else ["a variation that does not touch it"]
    values = [value for variation in variations for value in _values(variation, key)]
    found += [f"no case with {form}" for form, is_it in _forms(entry).items() if not any(map(is_it, values))]
    found += [f"no case with the value {value!r}" for value in _listed(entry) if not _among(value, values)]
    if "expression" in str(entry["type"]):
        found += [f"no expression with {name} in it" for name in _variables_missing(entry, values, variables)]
    low = (entry["range"] or {}).get("low")
    if low is not None and not entry["range"]["low_open"] and not _among(low, _flat(values)):
        found.append(f"no case with the lower end of its range, {low:g}")
    if not entry["required"] and entry["default"] is None and not any(_toggles(v, key) for v in variations):
        found.append("no case that has it where the base has not, or leaves it out where the base has it")
    return found


def _touches(variation: Variation, key: str) -> bool:
    """Sets the key, or leaves out it or a table around it."""
    names = [generic(name) for name in variation.changes]
    return any(is_below(key, name) for name in names)


def _values(variation: Variation, key: str) -> list[Any]:
    return [
        value for name, value in variation.changes.items() if generic(name) == key and value is not ABSENT
    ]


def _toggles(variation: Variation, key: str) -> bool:
    before = {name for name in BASES[variation.base] if generic(name) == key}
    after = {name for name in variation.case(key).scene if generic(name) == key}
    return before != after


def _forms(entry: Entry) -> Mapping[str, Callable[[Any], bool]]:
    kind = str(entry["type"])
    if kind in FORMS:
        return FORMS[kind]
    counted = re.fullmatch(r"(?:d|\d+) (.+)", kind)
    if counted and counted[1] in LIST_FORMS:
        return LIST_FORMS[counted[1]]
    return {f"type {kind!r}, whose forms coverage.py does not know": lambda value: False}


def _listed(entry: Entry) -> list[Any]:
    """Every choice, and every integer of a small range."""
    listed = list(entry["choices"] or [])
    limits = entry["range"] or {}
    if "integer" in str(entry["type"]) and limits.get("high") is not None:
        low, high = int(limits["low"]), int(limits["high"])
        listed += range(low, high + 1) if high - low < FEW else []
    return listed


def _flat(values: Iterable[Any]) -> list[Any]:
    return [entry for value in values for entry in (value if isinstance(value, list) else [value])]


def _among(value: Any, values: Iterable[Any]) -> bool:
    return value in _flat(values)


def _variables_missing(entry: Entry, values: Iterable[Any], places: set[str]) -> list[str]:
    used = {name for text in map(str, _flat(values)) for name in re.findall(r"[A-Za-z_]\w*", text)}
    times = set() if str(entry["key"]).startswith("initial.") else {"t"}
    return sorted((places | times) - used)


def _sides_without(schema: Sequence[Entry], shape: str, cases: Sequence[Case]) -> list[str]:
    """A boundary's key has to be tried on each side of each shape."""
    tried = {key for case in cases if _shape(case) == shape for key in case.scene}
    keys = [str(entry["key"]) for entry in schema if ".NAME." in str(entry["key"])]
    return [
        f"{key}: no case on the side {side} of a {shape}"
        for key in keys
        for side in sorted(SIDES[shape])
        if key.replace("NAME", side) not in tried
    ]


def _shape(case: Case) -> str:
    return str(case.scene.get("mesh.shape", "rectangle"))


def read(text: str) -> list[Entry]:
    """What `thermocontact schema --format json` prints."""
    return list(json.loads(text))
