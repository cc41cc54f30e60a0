"""What a plane body is held by and lies on, in moving pictures: springs as zigzags, the marks of a belt that runs."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from oracle_parts import vtu
from oracle_parts.expressions import Expression
from plotting.results import Array

SIDES = {"left": (0, -1.0), "right": (0, 1.0), "bottom": (1, -1.0), "top": (1, 1.0)}  # axis, outward
LENGTH = 0.45  # of a spring at rest, of the body's extent along it
SPRINGS, TURNS = 3, 6  # drawn on a side, and the turns of each
MARKS = 12  # on a belt, along the body
LONG = 0.06  # a mark, of the body's width


@dataclass(frozen=True)
class Spring:
    """Points of a side that are held, and where their springs' far ends are when nothing has moved."""

    nodes: Any
    far: Array  # [springs][2]
    anchor: list[Expression]
    places: Array  # of the nodes, undeformed

    def lines(self, moved: Array, time: float) -> list[Array]:
        """A zigzag for each from its node to its far end."""
        shift = np.stack([part(self.places, time) for part in self.anchor], axis=1)
        return [zigzag(moved[node, :2], end) for node, end in zip(self.nodes, self.far + shift)]


def springs(scene: Mapping[str, Any], body: vtu.Grid) -> list[Spring]:
    """Of the sides of a rectangle; a mesh file does not say which nodes a side has."""
    found = []
    lower, upper = body.points.min(axis=0), body.points.max(axis=0)
    for name, (axis, outward) in SIDES.items():
        spring = scene.get("boundary", {}).get(name, {}).get("spring")
        if spring is None or "file" in scene.get("mesh", {}):
            continue
        place = (lower if outward < 0 else upper)[axis]
        on_side = np.flatnonzero(np.abs(body.points[:, axis] - place) < 1e-9 * np.ptp(body.points))
        along = body.points[on_side, 1 - axis]
        wanted = lower[1 - axis] + (np.arange(SPRINGS) + 0.5) / SPRINGS * (upper - lower)[1 - axis]
        nodes = on_side[np.argmin(np.abs(along[None] - wanted[:, None]), axis=1)]
        far = body.points[nodes, :2].copy()
        far[:, axis] += outward * LENGTH * (upper - lower)[axis]
        anchor = [Expression(part) for part in spring.get("anchor", [0.0, 0.0])]
        found.append(Spring(nodes, far, anchor, body.points[nodes]))
    return found


def zigzag(start: Array, end: Array) -> Array:
    """Straight at both ends, TURNS turns between."""
    along = np.concatenate(
        [[0.0, 0.15], 0.15 + 0.7 * (np.arange(2 * TURNS) + 0.5) / (2 * TURNS), [0.85, 1.0]]
    )
    aside = np.concatenate([[0.0, 0.0], np.tile([1.0, -1.0], TURNS), [0.0, 0.0]])
    length = end - start
    across = np.array([-length[1], length[0]]) / max(float(np.linalg.norm(length)), 1e-300)
    width = 0.035 * LENGTH
    return np.asarray(start + along[:, None] * length + width * aside[:, None] * across * _size(length))


def _size(length: Array) -> float:
    return float(np.linalg.norm(length)) / LENGTH


def marks(
    scene: Mapping[str, Any], ground: Array, width: tuple[float, float], time: float
) -> Iterator[Array]:
    """Strokes below a level belt of constant speed that move with it; `ground` [facets][nodes][2], from `width[0]` to
    `width[1]`, the picture's edges."""
    for name in ("bottom", "top"):
        contact = scene.get("boundary", {}).get(name, {}).get("contact", {})
        velocity = contact.get("foundation_velocity")
        if velocity is None or not all(isinstance(part, (int, float)) for part in velocity):
            continue
        level, extent = float(ground[..., 1].mean()), float(np.ptp(ground[..., 0]))
        if np.ptp(ground[..., 1]) > 0.05 * extent:
            continue
        step, down = extent / MARKS, SIDES[name][1] * LONG * extent
        first = width[0] - 2 * step + (velocity[0] * time) % step
        yield np.array([[width[0], level], [width[1], level]])
        for x in np.arange(first, width[1] + 2 * step, step):
            yield np.array([[x, level], [x - abs(down) / 2, level + down]])
