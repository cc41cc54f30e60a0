"""Scenes that must be refused, made from the schema: each needs exit code 2 and the key in the message."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from matrix_parts.body_law_files import ABSORBER, FIBRES, LAWS, PLANE, SPIN, SPOT
from matrix_parts.cases import generic
from matrix_parts.coverage import Entry
from matrix_parts.scenes import ABSENT, BASES, Flat, changed, is_below, without

BASE, SIDE = "contact bottom", "bottom"


@dataclass(frozen=True)
class Refusal:
    key: str
    why: str
    scene: Flat


def refusals(schema: Sequence[Entry]) -> list[Refusal]:
    # keys of a region need a mesh that has one: the C++ tests of the schema break their rules
    here = [entry for entry in schema if not str(entry["key"]).startswith("region.")]
    found = [refusal for entry in here for refusal in _of(entry, schema)]
    unknown = Refusal("mesh.no_such_key", "an unknown key", BASES[BASE] | {"mesh.no_such_key": 1})
    return [*found, unknown, *_graded(), *_refined(), *_exact_friction(), *_law_files(), *_in_space(schema)]


def _graded() -> Iterator[Refusal]:
    base, front, left = BASES[BASE], "mesh.grading.front", "mesh.grading.left"
    yield Refusal(front, "a rectangle has no such side", base | {front: 2.0})
    yield Refusal("mesh.grading.lfet", "an unknown side", base | {"mesh.grading.lfet": 2.0})
    yield Refusal(left, "cells too thin to tell from round-off", base | {left: 1e14})


def _refined() -> Iterator[Refusal]:
    key = "mesh.refinement.tolerance"
    for shape in ("", "box "):
        tensor = {"mesh.cell": "tensor", key: 0.1}
        yield Refusal(key, "only simplices are bisected", BASES[f"{shape}{BASE}"] | tensor)
    rigid = without(BASES["mechanics"], ["material.elasticity", "material.viscosity"])
    yield Refusal(key, "no energy to measure errors in", rigid | {key: 0.1})
    yield Refusal(key, "left out", BASES[BASE] | {"mesh.refinement.every": 2})


def _exact_friction() -> Iterator[Refusal]:
    rule, epsilon = (f"boundary.{SIDE}.contact.{key}" for key in ("quadrature", "friction.regularisation"))
    for degree in (3, 5, 9):
        changes = {rule: degree, epsilon: 0.0}
        yield Refusal(rule, f"no multipliers for the points of degree {degree}", BASES[BASE] | changes)


def _law_files() -> Iterator[Refusal]:
    """Laws of the body from files that cannot be of this one, or are not asked for."""
    base, plane = BASES[BASE], "material.elasticity.plane"
    yield Refusal("forms.elasticity", "no law of plane stress", changed(base, FIBRES))
    for kind, law in (
        ("elasticity", FIBRES),
        ("viscosity", ABSORBER),
        ("source", SPOT),
        ("body_force", SPIN),
    ):
        key, other = f"forms.{kind}", str(LAWS / "power-law.py")
        beside = PLANE if kind == "elasticity" else {}
        yield Refusal(key, "the file of another law", changed(base, {**law, **beside, key: other}))
        yield Refusal(key, "no table of its numbers", without(base | {key: law[key]}, [_table_of(kind)]))
        numbers = [name for name in law if name.startswith(_table_of(kind) + ".")]
        scene = changed(base, {**law, **beside, numbers[0]: ABSENT})
        yield Refusal(numbers[0], "a number of the law is left out", scene)
        yield Refusal(numbers[0], "no number", changed(base, {**law, **beside, numbers[0]: "x"}))
    yield Refusal(plane, "no such plane", changed(base, {**FIBRES, plane: "strian"}))
    tensor = {"material.elasticity.tensor": _unit(3)}
    yield Refusal("material.elasticity.tensor", "beside a law", changed(base, {**FIBRES, **PLANE, **tensor}))


def _table_of(kind: str) -> str:
    above = {"source": "heat", "body_force": "load"}.get(kind, "material")
    return f"{above}.{kind}"


def _in_space(schema: Sequence[Entry]) -> Iterator[Refusal]:
    """What belongs to plane bodies: their keys, vectors of two components, their matrices."""
    base, plane = BASES[f"box {BASE}"], BASES[BASE]
    yield Refusal("mesh.diagonal", "a box has none", base | {"mesh.diagonal": "left"})
    yield Refusal("material.elasticity.plane", "not plane", base | {"material.elasticity.plane": "strain"})
    for entry in schema:
        key = str(entry["key"])
        if str(entry["type"]).startswith("d ") and not key.startswith("region."):
            names = [name for name in plane if generic(name) == key] or [key.replace("NAME", SIDE)]
            short = {names[0]: base.get(names[0], [0.0] * 3)[:2]}
            yield Refusal(key, "two components in space", base | short)
    for key, rows in (("heat.conductivity", 2), ("heat.thermal_stress", 2), ("heat.strain_heating", 2)):
        yield Refusal(key, "a matrix of the plane", base | {key: _unit(rows)})
    for law in ("elasticity", "viscosity"):
        key = f"material.{law}.tensor"
        yield Refusal(
            key, "a Voigt matrix of the plane", without(base, [f"material.{law}"]) | {key: _unit(3)}
        )


def _unit(rows: int) -> list[list[float]]:
    return [[float(row == column) for column in range(rows)] for row in range(rows)]


def _of(entry: Entry, schema: Sequence[Entry]) -> Iterator[Refusal]:
    key, name = str(entry["key"]), str(entry["key"]).replace("NAME", SIDE)
    base = _with_room(entry)
    yield Refusal(key, "a value of the wrong type", base | {name: True})
    for value in _out_of_range(entry):
        yield Refusal(key, f"{value} is out of range", base | {name: value})
    if entry["choices"] and "list" not in str(entry["type"]):
        yield Refusal(key, "no such choice", base | {name: "no such choice"})
    if entry["required"] and name in base:
        yield Refusal(key, "required, and left out", _beside(entry, schema) | without(base, [name]))
    for need in entry["needs"]:
        scene = _stripped(base, need, schema)
        yield Refusal(key, f"needs {need}", scene | {name: entry["example"]})
    for other in entry["excludes"]:
        # whichever of the two the message names
        beside = without(base, [other]) if f"{other}.".replace("NAME", SIDE) in name else base
        yield Refusal(key, f"excludes {other}", beside | _least(other, schema) | {name: entry["example"]})


def _with_room(entry: Entry) -> Flat:
    """The base scene without what stands instead of the key."""
    base = BASES[BASE]
    return without(base, [entry["instead"]]) if entry["instead"] else base


def _out_of_range(entry: Entry) -> list[Any]:
    limits = entry["range"]
    if not limits:
        return []
    values = [limits["low"] if limits["low_open"] else limits["low"] - 1]
    if limits["high"] is not None:
        values.append(limits["high"] if limits["high_open"] else limits["high"] + 1)
    if "integer" in str(entry["type"]):
        values = [int(value) for value in values]
    if str(entry["type"])[0].isdigit():
        values = [[value] * int(str(entry["type"]).split()[0]) for value in values]
    return values


def _beside(entry: Entry, schema: Sequence[Entry]) -> Flat:
    """An optional key of the same table, which else might vanish with its only key and be right again."""
    table = str(entry["key"]).rpartition(".")[0]
    beside = {
        str(other["key"]).replace("NAME", SIDE): other["example"] for other in schema if not other["required"]
    }
    found = [name for name in beside if name.rpartition(".")[0] == table.replace("NAME", SIDE)]
    return {name: beside[name] for name in found[:1]} if "contact" in table else {}


def _stripped(scene: Flat, need: str, schema: Sequence[Entry]) -> Flat:
    """The scene without that table and without all that needs it, so that one mistake is left."""
    needs = {str(entry["key"]): [str(need) for need in entry["needs"]] for entry in schema}
    kept, before = without(scene, [need.replace("NAME", SIDE)]), scene
    while len(kept) < len(before):
        before = kept
        kept = {name: value for name, value in kept.items() if _is_served(name, needs, before)}
    return kept


def _is_served(name: str, needs: Mapping[str, Sequence[str]], scene: Flat) -> bool:
    tables = [need.replace("NAME", SIDE) for need in needs.get(generic(name), ())]
    return all(any(is_below(key, table) for key in scene) for table in tables)


def _least(key: str, schema: Sequence[Entry]) -> Flat:
    """What a scene needs to have that key, or the table of that name."""
    scene = BASES[BASE]
    prefix = key.replace("NAME", SIDE)
    found = {name: value for name, value in scene.items() if is_below(name, prefix)}
    examples = {str(entry["key"]).replace("NAME", SIDE): entry["example"] for entry in schema}
    return found or {name: value for name, value in examples.items() if is_below(name, prefix)}
