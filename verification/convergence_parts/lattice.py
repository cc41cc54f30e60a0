"""Piecewise linear functions on the unit square, n by n squares each split from lower left to upper right.

A function is an array whose last two axes are the vertices, rows along y. The triangles of a lattice are an array
[2, n, n]: below the diagonal, then above it.
"""

import math
from typing import Any

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[Any]

CORNER_RADIUS = 1.0 / 8.0
BAND = 1.0 / 32.0
REGIONS = ("all", "lower left", "lower right", "upper left", "upper right", "diagonal", "edges")
CORNERS = {"lower left": (0, 0), "lower right": (1, 0), "upper left": (0, 1), "upper right": (1, 1)}


def prolong(coarse: Array, cells: int) -> Array:
    """The same function on a lattice with `cells` squares a side, a multiple of its own."""
    own = coarse.shape[-1] - 1
    if cells % own:
        raise ValueError(f"a lattice of {own} squares a side is not nested in one of {cells}")
    if cells == own:
        return coarse
    ratio = cells // own
    index = np.arange(cells + 1)
    square = np.minimum(index // ratio, own - 1)
    local = (index - square * ratio) / ratio
    along_x, along_y = local[None, :], local[:, None]
    row, column = square[:, None], square[None, :]
    origin = coarse[..., row, column]
    opposite = coarse[..., row + 1, column + 1]
    below = along_x >= along_y
    side = np.where(below, coarse[..., row, column + 1], coarse[..., row + 1, column])
    first = np.maximum(along_x, along_y)
    second = np.minimum(along_x, along_y)
    result: Array = origin + first * (side - origin) + second * (opposite - side)
    return result


def integral_of_square(values: Array) -> Array:
    """Of a scalar function, over each triangle."""
    origin, right = values[:-1, :-1], values[:-1, 1:]
    above, opposite = values[1:, :-1], values[1:, 1:]
    a, b = np.stack([origin, origin]), np.stack([opposite, opposite])
    c = np.stack([right, above])
    area = 0.5 / (values.shape[-1] - 1) ** 2
    result: Array = area / 12.0 * (a**2 + b**2 + c**2 + (a + b + c) ** 2)
    return result


def gradient(values: Array) -> tuple[Array, Array]:
    """The constant d/dx and d/dy of a scalar function in each triangle."""
    along_x = np.diff(values, axis=1) * (values.shape[-1] - 1)
    along_y = np.diff(values, axis=0) * (values.shape[-1] - 1)
    return np.stack([along_x[:-1], along_x[1:]]), np.stack([along_y[:, 1:], along_y[:, :-1]])


def integral_of_strain_square(displacement: Array) -> Array:
    """Of eps(u) : eps(u), over each triangle."""
    (xx, xy), (yx, yy) = gradient(displacement[0]), gradient(displacement[1])
    area = 0.5 / (displacement.shape[-1] - 1) ** 2
    result: Array = area * (xx**2 + yy**2 + 0.5 * (xy + yx) ** 2)
    return result


def centroids(cells: int) -> tuple[Array, Array]:
    low, high = (np.arange(cells) + 1 / 3) / cells, (np.arange(cells) + 2 / 3) / cells
    shape = (cells, cells)
    x = np.stack([np.broadcast_to(high, shape), np.broadcast_to(low, shape)])
    y = np.stack([np.broadcast_to(low[:, None], shape), np.broadcast_to(high[:, None], shape)])
    return x, y


def region_masks(cells: int, closed: Array) -> Array:
    """1 or 0 for each of REGIONS and each triangle, by its centroid; triangles in one axis.

    The regions `diagonal` and `edges` are bands along (1, 1), the one direction in which the singular K of the
    paper conducts: from the lower left corner, and from each edge of the contact zone, whose vertices on the lower
    side are `closed`.
    """
    x, y = centroids(cells)
    masks = {"all": np.full(x.shape, True), "diagonal": abs(x - y) < BAND}
    for name, (corner_x, corner_y) in CORNERS.items():
        masks[name] = np.hypot(x - corner_x, y - corner_y) < CORNER_RADIUS
    edges = (np.flatnonzero(closed[1:] != closed[:-1]) + 0.5) / cells
    masks["edges"] = np.any([abs(x - y - edge) < BAND for edge in [math.inf, *edges]], axis=0)
    result: Array = np.stack([masks[name].ravel() for name in REGIONS]).astype(float)
    return result
