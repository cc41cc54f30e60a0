"""Scenes as flat tables, dotted key to value, and the base scenes that the variations change one thing in."""

import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, Final

Flat = dict[str, Any]

ABSENT: Final = None  # as the value of a change: the key, or everything below it, is left out
SIDES = {"rectangle": ("left", "right", "bottom", "top")}  # of each mesh.shape
OPPOSITE = {"left": "right", "right": "left", "bottom": "top", "top": "bottom"}
BESIDE = {"left": "bottom", "right": "bottom", "bottom": "left", "top": "left"}

# What needs [material], and what needs [heat]; NAME.key stands for that key of every boundary
MECHANICAL = ("material", "load", "initial.displacement", "initial.velocity") + (
    "heat.thermal_stress",
    "heat.strain_heating",
    "NAME.displacement",
    "NAME.traction",
    "NAME.contact.compliance",
    "NAME.contact.friction",
)
THERMAL = ("heat", "initial.temperature", "NAME.temperature", "NAME.heat_flux", "NAME.contact.conductance")


def is_below(key: str, prefix: str) -> bool:
    """key is the prefix or one of its table's keys; NAME in the prefix stands for any boundary."""
    if prefix.startswith("NAME."):
        parts = key.split(".")
        return parts[0] == "boundary" and is_below(".".join(parts[2:]), prefix.removeprefix("NAME."))
    return key == prefix or key.startswith(prefix + ".")


def without(scene: Mapping[str, Any], prefixes: Iterable[str]) -> Flat:
    gone = tuple(prefixes)
    return {key: value for key, value in scene.items() if not any(is_below(key, prefix) for prefix in gone)}


def changed(scene: Mapping[str, Any], changes: Mapping[str, Any]) -> Flat:
    """First everything that is to be absent goes, then the new values come."""
    kept = without(scene, [key for key, value in changes.items() if value is ABSENT])
    return kept | {key: value for key, value in changes.items() if value is not ABSENT}


def write(path: Path, scene: Mapping[str, Any]) -> None:
    """JSON's strings, numbers and lists are also TOML's."""
    lines = (f"{key} = {json.dumps(value)}\n" for key, value in scene.items())
    path.write_text("".join(lines), encoding="utf-8")


def _on_axes(side: str, along_normal: Any, along_side: Any) -> list[Any]:
    """The two components of a vector given by its part along the side's axis and the other one."""
    return [along_normal, along_side] if side in ("left", "right") else [along_side, along_normal]


def contact_laws(side: str) -> Flat:
    """All laws on that side, whose gap varies along it and is closed nearly everywhere."""
    along = "y" if side in ("left", "right") else "x"
    contact = f"boundary.{side}.contact"
    return {
        f"{contact}.gap": f"0.004*cos(5*{along}) - 0.004",
        f"{contact}.compliance.stiffness": 200.0,
        f"{contact}.friction.coefficient": 0.3,
        f"{contact}.friction.regularisation": 5e-3,
        f"{contact}.conductance.coefficient": 2.0,
        f"{contact}.conductance.onset": 0.02,
        f"{contact}.conductance.foundation_temperature": 3.0,
    }


def contact_on(side: str) -> Flat:
    """A body that a lid presses onto a foundation at that side, with every physics there is.

    Stiffness, viscosity, inertia and loads are of one size, so that each of them is seen in the result, and so
    small in number (h = 1/4) that the matrices have condition numbers below 1e3.
    """
    lid, beside = OPPOSITE[side], BESIDE[side]
    outward = 1.0 if side in ("right", "top") else -1.0
    return {
        "mesh.upper": [1.0, 0.8],
        "mesh.cells": [4, 3],
        "time.end": 0.3,
        "time.steps": 3,
        "material.density": 1.5,
        "material.elasticity.young": 6.0,
        "material.elasticity.poisson": 0.25,
        "material.viscosity.trace": 0.4,
        "material.viscosity.shear": 0.6,
        "heat.capacity": 1.3,
        "heat.conductivity": 0.7,
        "heat.source": 1.0,
        "heat.thermal_stress": 0.3,
        "heat.strain_heating": 0.4,
        "load.body_force": _on_axes(side, outward, 0.3),
        "initial.displacement": _on_axes(side, 0.005 * outward, "0.004*x*y"),
        "initial.velocity": _on_axes(side, 0.05 * outward, "0.1*x - 0.05*y"),
        "initial.temperature": "0.5*y + x",
        f"boundary.{lid}.displacement": _on_axes(side, f"{outward}*(0.01 + 0.05*t)", "0.02*t"),
        f"boundary.{lid}.temperature": 0.5,
        f"boundary.{beside}.traction": [0.8, 0.2],
        f"boundary.{beside}.heat_flux": 0.6,
        **contact_laws(side),
    }


def _bases() -> dict[str, Flat]:
    everything = contact_on("bottom")
    coupled = without(everything, ["boundary.bottom"])
    return {
        **{f"contact {side}": contact_on(side) for side in SIDES["rectangle"]},
        "coupled": coupled,
        "mechanics": without(coupled, THERMAL),
        "heat": without(coupled, MECHANICAL),
        "contact without heat": without(everything, THERMAL),
        "contact without mechanics": without(everything, MECHANICAL),
    }


BASES = _bases()
