"""VTK's unstructured grid files with inline binary data, and the collection of them over time: write and read.

Data arrays are base64, little endian, uncompressed, each with its own UInt64 length before it. A grid may lie in
pieces, one for each process that wrote it, listed in a PVTU file.
"""

import base64
import os
import xml.etree.ElementTree as ElementTree
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

LINE, TRIANGLE, QUADRATIC_TRIANGLE = 3, 5, 22
# VTK's type of the cell, and the place of VTK's nodes among Basix's, by kind of cell and number of nodes
VTK_CELLS: dict[tuple[str, int], tuple[int, list[int]]] = {
    ("interval", 2): (3, [0, 1]),
    ("interval", 3): (21, [0, 1, 2]),
    ("triangle", 3): (5, [0, 1, 2]),
    ("triangle", 6): (22, [0, 1, 2, 5, 3, 4]),
    ("quadrilateral", 4): (9, [0, 1, 3, 2]),
    ("quadrilateral", 9): (28, [0, 1, 3, 2, 4, 6, 7, 5, 8]),
    ("tetrahedron", 4): (10, [0, 1, 2, 3]),
    ("tetrahedron", 10): (24, [0, 1, 2, 3, 9, 6, 8, 7, 5, 4]),
    ("hexahedron", 8): (12, [0, 1, 3, 2, 4, 5, 7, 6]),
    ("hexahedron", 27): (
        29,
        [0, 1, 3, 2, 4, 5, 7, 6]
        + [8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 15, 14]
        + [22, 23, 21, 24, 20, 25]
        + [26],
    ),
}
VERTICES = {3: 2, 21: 2, 5: 3, 22: 3, 9: 4, 28: 4, 10: 4, 24: 4, 12: 8, 29: 8}
TYPES = {"Float64": "<f8", "Float32": "<f4", "Int32": "<i4", "Int64": "<i8", "UInt8": "|u1", "UInt64": "<u8"}
NAMES = {np.dtype(code): name for name, code in TYPES.items()}
HEADER = np.dtype("<u8")

Array = npt.NDArray[Any]


@dataclass(frozen=True)
class Grid:
    """One piece: points[n, 3], cells[m, nodes per cell], data by name with one row per point or cell."""

    points: Array
    cells: Array
    cell_type: int
    point_data: Mapping[str, Array]
    cell_data: Mapping[str, Array]


@dataclass(frozen=True)
class DataSet:
    time: float
    part: int
    file: str


def write_grid(path: Path, grid: Grid) -> None:
    cells = np.ascontiguousarray(grid.cells, dtype="<i8")
    offsets = np.arange(1, len(cells) + 1, dtype="<i8") * cells.shape[1]
    types = np.full(len(cells), grid.cell_type, dtype=np.uint8)
    lines = [
        '<?xml version="1.0"?>',
        '<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">',
        "<UnstructuredGrid>",
        f'<Piece NumberOfPoints="{len(grid.points)}" NumberOfCells="{len(cells)}">',
        "<Points>",
        _encoded("Points", np.asarray(grid.points, dtype="<f8")),
        "</Points>",
        "<Cells>",
        _encoded("connectivity", cells.ravel()),
        _encoded("offsets", offsets),
        _encoded("types", types),
        "</Cells>",
        "<PointData>",
        *(_encoded(name, values) for name, values in grid.point_data.items()),
        "</PointData>",
        "<CellData>",
        *(_encoded(name, values) for name, values in grid.cell_data.items()),
        "</CellData>",
        "</Piece>",
        "</UnstructuredGrid>",
        "</VTKFile>",
        "",
    ]
    path.write_text("\n".join(lines), encoding="ascii")


def _encoded(name: str, values: Array) -> str:
    kind = NAMES[np.dtype(values.dtype).newbyteorder("<")]
    components = values.shape[1] if values.ndim > 1 else 1
    raw = np.ascontiguousarray(values, dtype=TYPES[kind]).tobytes()
    text = base64.b64encode(np.array([len(raw)], dtype=HEADER).tobytes() + raw).decode("ascii")
    attributes = f'type="{kind}" Name="{name}" NumberOfComponents="{components}" format="binary"'
    return f"<DataArray {attributes}>{text}</DataArray>"


def read_grid(path: Path) -> Grid:
    """A VTU, or the pieces of a PVTU one after the other: points on a seam are there once a piece (`without_seams`).

    Raises ValueError or OSError where the file is no such grid of one cell type.
    """
    root = _parse(path)
    if root.get("type") == "PUnstructuredGrid":
        return _read_pieces(path, root)
    piece = root.find("UnstructuredGrid/Piece")
    if piece is None or root.get("header_type") != "UInt64" or root.get("compressor"):
        raise ValueError(f"{path}: not an uncompressed unstructured grid with UInt64 headers")
    points, cells = _arrays(path, piece, "Points"), _arrays(path, piece, "Cells")
    types = np.unique(cells["types"])
    if len(types) > 1:
        raise ValueError(f"{path}: more than one type of cell")
    count = int(piece.get("NumberOfCells", "0"))
    return Grid(
        points=next(iter(points.values())).reshape(-1, 3),
        cells=cells["connectivity"].reshape(count, -1) if count else np.empty((0, 1), dtype=np.int64),
        cell_type=int(types[0]) if count else TRIANGLE,
        point_data=_arrays(path, piece, "PointData"),
        cell_data=_arrays(path, piece, "CellData"),
    )


def _read_pieces(path: Path, root: ElementTree.Element) -> Grid:
    sources = [piece.get("Source", "") for piece in root.iter("Piece")]
    if not sources:
        raise ValueError(f"{path}: lists no piece")
    pieces = [read_grid(path.parent / source) for source in sources]
    for section, kind in (("PPointData", "point_data"), ("PCellData", "cell_data")):
        declared = {entry.get("Name") for entry in root.findall(f"PUnstructuredGrid/{section}/PDataArray")}
        for source, piece in zip(sources, pieces):
            if set(getattr(piece, kind)) != declared:
                raise ValueError(f"{path}: {section} declares other fields than {source} has")
    filled = [piece for piece in pieces if len(piece.cells)] or pieces[:1]
    if len({(piece.cell_type, piece.cells.shape[1]) for piece in filled}) > 1:
        raise ValueError(f"{path}: more than one type of cell")
    firsts = np.cumsum([0] + [len(piece.points) for piece in filled])
    return Grid(
        points=np.concatenate([piece.points for piece in filled]),
        cells=np.concatenate([piece.cells + first for piece, first in zip(filled, firsts)]),
        cell_type=filled[0].cell_type,
        point_data=_joined([piece.point_data for piece in filled]),
        cell_data=_joined([piece.cell_data for piece in filled]),
    )


def _joined(pieces: Sequence[Mapping[str, Array]]) -> dict[str, Array]:
    return {name: np.concatenate([piece[name] for piece in pieces]) for name in pieces[0]}


def without_seams(grid: Grid) -> Grid:
    """Points at one place become one, as the nodes are of which several pieces have a copy.

    Raises ValueError where copies of a point differ in a field by a single bit: they are one number that a process sent
    to the others, or an expression at the same place.
    """
    _, first, copy_of = np.unique(grid.points, axis=0, return_index=True, return_inverse=True)
    if len(first) == len(grid.points):
        return grid
    copy_of = copy_of.ravel()
    for name, values in grid.point_data.items():
        differs = (values != values[first][copy_of]).reshape(len(values), -1).any(axis=1)
        if differs.any():
            place = grid.points[np.flatnonzero(differs)[0]]
            raise ValueError(f"{name} at {place.tolist()} is not the same in all pieces that have this point")
    data = {name: values[first] for name, values in grid.point_data.items()}
    return Grid(grid.points[first], copy_of[grid.cells], grid.cell_type, data, grid.cell_data)


def _parse(path: Path) -> ElementTree.Element:
    try:
        return ElementTree.parse(path).getroot()
    except ElementTree.ParseError as problem:
        raise ValueError(f"{path}: {problem}") from problem


def _arrays(path: Path, piece: ElementTree.Element, section: str) -> dict[str, Array]:
    parent = piece.find(section)
    arrays = {}
    for element in [] if parent is None else parent.findall("DataArray"):
        name = element.get("Name", section)
        if element.get("format") != "binary" or element.get("type") not in TYPES:
            raise ValueError(f"{path}: {name} is not an inline binary array")
        raw = base64.b64decode((element.text or "").strip())
        length = int(np.frombuffer(raw[: HEADER.itemsize], dtype=HEADER)[0])
        values = np.frombuffer(raw[HEADER.itemsize :], dtype=TYPES[str(element.get("type"))])
        if values.nbytes != length:
            raise ValueError(f"{path}: {name} holds {values.nbytes} bytes where it says {length}")
        components = int(element.get("NumberOfComponents", "1"))
        arrays[name] = values.reshape(-1, components) if components > 1 else values
    return arrays


def write_collection(path: Path, datasets: Sequence[DataSet]) -> None:
    """Written beside and renamed over, so that a reader never sees half of it."""
    lines = [
        '<?xml version="1.0"?>',
        '<VTKFile type="Collection" version="1.0" byte_order="LittleEndian" header_type="UInt64">',
        "<Collection>",
        *(f'<DataSet timestep="{d.time!r}" group="" part="{d.part}" file="{d.file}"/>' for d in datasets),
        "</Collection>",
        "</VTKFile>",
        "",
    ]
    beside = path.with_suffix(".pvd.part")
    beside.write_text("\n".join(lines), encoding="ascii")
    os.replace(beside, path)


def read_collection(path: Path) -> list[DataSet]:
    return [
        DataSet(float(entry.get("timestep", "nan")), int(entry.get("part", "0")), entry.get("file", ""))
        for entry in _parse(path).iter("DataSet")
    ]
