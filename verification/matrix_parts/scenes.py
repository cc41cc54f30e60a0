"""Scenes as flat tables, dotted key to value, and the base scenes that the variations change one thing in."""

import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, Final

Flat = dict[str, Any]

ABSENT: Final = None  # as the value of a change: the key, or everything below it, is left out
# Of each mesh.shape
DIMENSION = {"rectangle": 2, "box": 3}
SIDES = {
    "rectangle": ("left", "right", "bottom", "top"),
    "box": ("left", "right", "bottom", "top", "front", "back"),
}
BODY: dict[str, dict[str, Any]] = {
    "rectangle": {
        "mesh.upper": [1.0, 0.8],
        "mesh.cells": [4, 3],
        "initial.temperature": "0.5*y + x",
    },
    "box": {
        "mesh.shape": "box",
        "mesh.upper": [1.0, 0.8, 0.9],
        "mesh.cells": [3, 2, 2],
        "initial.temperature": "0.5*y + x - 0.3*z",
    },
}
AXIS = {"left": 0, "right": 0, "bottom": 1, "top": 1, "front": 2, "back": 2}
OPPOSITE = {
    "left": "right",
    "right": "left",
    "bottom": "top",
    "top": "bottom",
    "front": "back",
    "back": "front",
}
BESIDE = {
    "left": "bottom",
    "right": "bottom",
    "bottom": "left",
    "top": "left",
    "front": "left",
    "back": "bottom",
}

# What needs [material], and what needs [heat]; NAME.key stands for that key of every boundary
MECHANICAL = ("material", "load", "initial.displacement", "initial.velocity") + (
    "heat.thermal_stress",
    "heat.strain_heating",
    "heat.strain_rate_heating",
    "NAME.displacement",
    "NAME.traction",
    "NAME.spring",
    "NAME.contact.foundation_velocity",
    "NAME.contact.compliance",
    "NAME.contact.friction",
)
THERMAL = ("heat", "initial.temperature", "NAME.temperature", "NAME.heat_flux", "NAME.convection") + (
    "NAME.contact.conductance",
    "NAME.contact.friction.heat_share",
)


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


def _on_axes(side: str, dimension: int, along_normal: Any, *along_side: Any) -> list[Any]:
    """The components of a vector given by its part along the side's axis and those along the others."""
    components = list(along_side[: dimension - 1])
    components.insert(AXIS[side], along_normal)
    return components


def gap(side: str, shape: str) -> str:
    """Varies along the side, and is closed nearly everywhere."""
    along = [name for axis, name in enumerate("xyz"[: DIMENSION[shape]]) if axis != AXIS[side]]
    if len(along) == 1:
        return f"0.004*cos(5*{along[0]}) - 0.004"
    return f"0.004*cos(5*{along[0]}) + 0.003*sin(4*{along[1]}) - 0.006"


def contact_laws(side: str, shape: str = "rectangle") -> Flat:
    """All laws on that side."""
    contact = f"boundary.{side}.contact"
    return {
        f"{contact}.gap": gap(side, shape),
        f"{contact}.compliance.stiffness": 200.0,
        f"{contact}.friction.coefficient": 0.3,
        f"{contact}.friction.regularisation": 5e-3,
        f"{contact}.conductance.coefficient": 2.0,
        f"{contact}.conductance.onset": 0.02,
        f"{contact}.conductance.foundation_temperature": 3.0,
    }


def contact_on(side: str, shape: str = "rectangle") -> Flat:
    """A body that a lid presses onto a foundation at that side, with every physics there is.

    Stiffness, viscosity, inertia and loads are of one size, so that each of them is seen in the result, and so
    small in number (h = 1/4, in space 2/5) that the matrices have condition numbers below 1e3.
    """
    dimension, lid, beside = DIMENSION[shape], OPPOSITE[side], BESIDE[side]
    outward = 1.0 if side in ("right", "top", "back") else -1.0

    def on_axes(along_normal: Any, *along_side: Any) -> list[Any]:
        return _on_axes(side, dimension, along_normal, *along_side)

    return {
        **BODY[shape],
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
        "load.body_force": on_axes(outward, 0.3, -0.2),
        "initial.displacement": on_axes(0.005 * outward, "0.004*x*y", "0.003*z*x"),
        "initial.velocity": on_axes(0.05 * outward, "0.1*x - 0.05*y", "0.06*z - 0.04*x"),
        f"boundary.{lid}.displacement": on_axes(f"{outward}*(0.01 + 0.05*t)", "0.02*t", "-0.03*t*x"),
        f"boundary.{lid}.temperature": 0.5,
        f"boundary.{beside}.traction": [0.8, 0.2, -0.3][:dimension],
        f"boundary.{beside}.heat_flux": 0.6,
        **contact_laws(side, shape),
    }


def base_name(shape: str, name: str) -> str:
    return name if shape == "rectangle" else f"{shape} {name}"


def _bases(shape: str) -> dict[str, Flat]:
    everything = contact_on("bottom", shape)
    coupled = without(everything, ["boundary.bottom"])
    bases = {
        **{f"contact {side}": contact_on(side, shape) for side in SIDES[shape]},
        "coupled": coupled,
        "mechanics": without(coupled, THERMAL),
        "heat": without(coupled, MECHANICAL),
        "contact without heat": without(everything, THERMAL),
        "contact without mechanics": without(everything, MECHANICAL),
    }
    return {base_name(shape, name): scene for name, scene in bases.items()}


BASES = {name: scene for shape in SIDES for name, scene in _bases(shape).items()}
