"""Scenes moved: x' = Q x + shift with an orthogonal Q, or x' = x + V t. What moves with them is derived here.

Rectangles and boxes are mirrored, turned by right angles and shifted, so that sides remain sides; a mesh file is turned
by any angle.
"""

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from invariance_parts.compared import Array, Carry
from matrix_parts.scenes import Flat

VECTOR_KEYS: Final = (
    "body_force",
    ".displacement",
    ".velocity",
    ".traction",
    ".foundation_velocity",
    ".anchor",
)
OTHER_DIAGONAL: Final = {"right": "left", "left": "right", "crossed": "crossed"}
SIDES: Final = {  # outward normals
    "left": (-1, 0, 0),
    "right": (1, 0, 0),
    "bottom": (0, -1, 0),
    "top": (0, 1, 0),
    "front": (0, 0, -1),
    "back": (0, 0, 1),
}


@dataclass(frozen=True)
class Motion:
    """Q is [d][d], the shift [d], m."""

    name: str
    matrix: tuple[tuple[float, ...], ...]
    shift: tuple[float, ...] = ()

    def carry(self) -> Carry:
        Q, move = self.embedded()
        return Carry(points=lambda points: points @ Q.T + move, vectors=lambda vectors: vectors @ Q.T)

    def scene(self, scene: Mapping[str, Any]) -> Flat:
        moved = {} if "mesh.file" in scene else self._shape(scene)
        for key, value in scene.items():
            if key not in moved:
                moved[self._key(key, scene)] = self._value(key, value)
        return moved

    def embedded(self) -> tuple[Array, Array]:
        """Q [3][3] and shift [3]."""
        d = len(self.matrix)
        Q, move = np.eye(3), np.zeros(3)
        Q[:d, :d] = self.matrix
        move[: len(self.shift)] = self.shift
        return Q, move

    def _shape(self, scene: Mapping[str, Any]) -> Flat:
        d = len(self.matrix)
        Q, move = (entries[:d] for entries in self.embedded())
        Q = Q[:, :d]
        corners = np.array([scene.get("mesh.lower", [0.0] * d), scene["mesh.upper"]]) @ Q.T + move
        shape: Flat = {
            "mesh.lower": corners.min(axis=0).tolist(),
            "mesh.upper": corners.max(axis=0).tolist(),
            "mesh.cells": (np.abs(Q) @ scene["mesh.cells"]).astype(int).tolist(),
        }
        if d == 2 and scene.get("mesh.cell", "simplex") == "simplex":
            diagonal = str(scene.get("mesh.diagonal", "right"))
            along = Q @ [1, 1]
            shape["mesh.diagonal"] = diagonal if along[0] == along[1] else OTHER_DIAGONAL[diagonal]
        return shape

    def _key(self, key: str, scene: Mapping[str, Any]) -> str:
        parts = key.split(".")
        if parts[0] == "boundary" and "mesh.file" not in scene:
            normal = tuple(int(entry) for entry in self.embedded()[0] @ SIDES[parts[1]])
            parts[1] = next(side for side, outward in SIDES.items() if outward == normal)
        return ".".join(parts)

    def _value(self, key: str, value: Any) -> Any:
        d = len(self.matrix)
        if isinstance(value, list) and key.endswith(VECTOR_KEYS):
            return self._vector([self._expression(entry) for entry in value])
        if isinstance(value, list) and isinstance(value[0], list) and len(value) == d:
            Q = np.array(self.matrix)
            return (Q @ np.array(value) @ Q.T).tolist()
        return self._expression(value) if isinstance(value, str) and key != "mesh.file" else value

    def _vector(self, components: list[Any]) -> list[Any]:
        return [_combined(row, components) for row in self.matrix]

    def _expression(self, value: Any) -> Any:
        """A function of the new place: x = Q^T (x' - shift)."""
        if not isinstance(value, str) or not re.search(r"\b[xyz]\b", value):
            return value
        d = len(self.matrix)
        move = self.embedded()[1]
        new = [f"({'xyz'[row]} - ({float(move[row])!r}))" for row in range(d)]
        old = {
            "xyz"[column]: f"({_combined([row[column] for row in self.matrix], new)})" for column in range(d)
        }
        return re.sub(r"\b[xyz]\b", lambda match: old[match[0]], value)


@dataclass(frozen=True)
class Boost:
    """The scene in a frame in which everything moves with `velocity` [d], m/s, beside what it does already."""

    name: str
    velocity: tuple[float, ...]

    def scene(self, scene: Mapping[str, Any]) -> Flat:
        d = len(self.velocity)
        boosted = {"initial.velocity": [0.0] * d, **scene}
        boosted["initial.velocity"] = self._faster(boosted["initial.velocity"])
        for key, value in scene.items():
            side, _, rest = key.removeprefix("boundary.").partition(".")
            if rest in ("displacement", "spring.anchor"):
                boosted[key] = [_plus(part, v, "*t") for part, v in zip(value, self.velocity)]
            elif rest == "contact.compliance.stiffness":
                contact = f"boundary.{side}.contact"
                along_normal = float(np.dot(self.velocity, SIDES[side][:d]))
                boosted[f"{contact}.gap"] = _plus(scene.get(f"{contact}.gap", 0.0), along_normal, "*t")
                belt = f"{contact}.foundation_velocity"
                if f"{contact}.friction.coefficient" in scene:
                    boosted[belt] = self._faster(scene.get(belt, [0.0] * d))
        return boosted

    def carry(self, end: float) -> Carry:
        """Of results at the time `end` (s)."""
        velocity = np.zeros(3)
        velocity[: len(self.velocity)] = self.velocity
        return Carry(drift={"displacement": end * velocity, "velocity": velocity})

    def _faster(self, components: list[Any]) -> list[Any]:
        return [_plus(part, v, "") for part, v in zip(components, self.velocity)]


def _plus(part: Any, number: float, factor: str) -> Any:
    return part if part == "free" else f"({part}) + ({number!r}){factor}"


def _combined(weights: tuple[float, ...] | list[float], parts: list[Any]) -> Any:
    """The weighted sum: the part itself, a number, or an expression. "free" moves whole."""
    used = [(weight, part) for weight, part in zip(weights, parts) if weight != 0]
    if used[0][1] == "free" or used[0][0] == 1 and len(used) == 1:
        return used[0][1]
    if all(not isinstance(part, str) for _, part in used):
        return float(sum(weight * part for weight, part in used))
    return " + ".join(f"({float(weight)!r})*({part})" for weight, part in used)


def turned(degrees: float) -> Motion:
    c, s = float(np.cos(np.radians(degrees))), float(np.sin(np.radians(degrees)))
    return Motion(f"turned by {degrees:g}", ((c, -s), (s, c)))


PLANE: Final = (
    Motion("mirrored, x", ((-1, 0), (0, 1))),
    Motion("mirrored, y", ((1, 0), (0, -1))),
    Motion("turned by 90", ((0, -1), (1, 0))),
    Motion("turned by 180", ((-1, 0), (0, -1))),
    Motion("turned by 270", ((0, 1), (-1, 0))),
    Motion("x and y exchanged", ((0, 1), (1, 0))),
    Motion("shifted", ((1, 0), (0, 1)), (3.0, -7.0)),
    Motion("turned and shifted", ((0, -1), (1, 0)), (-0.625, 1.25)),
)
SPACE: Final = (
    Motion("mirrored, z", ((1, 0, 0), (0, 1, 0), (0, 0, -1))),
    Motion("x to y to z to x", ((0, 0, 1), (1, 0, 0), (0, 1, 0))),
    Motion("turned about x by 90, shifted", ((1, 0, 0), (0, 0, -1), (0, 1, 0)), (0.5, -4.0, 2.0)),
    Motion("x and z exchanged", ((0, 0, 1), (0, 1, 0), (1, 0, 0))),
)


BOOSTS: Final = (Boost("seen from a train", (0.7, -0.4)), Boost("seen from a lift", (0.0, 3.0)))


def orders(scene: Flat) -> Iterator[tuple[str, Callable[[], Flat]]]:
    """The same keys in other orders."""
    yield "keys reversed", lambda: dict(reversed(scene.items()))
    yield "keys sorted", lambda: dict(sorted(scene.items()))
