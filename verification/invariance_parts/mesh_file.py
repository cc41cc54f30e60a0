"""A mesh file said otherwise: nodes and cells numbered in another order, points moved. Gmsh's ASCII format 2.2."""

import random
from pathlib import Path

import numpy as np

from invariance_parts.compared import Array

SEED = 7
Move = tuple[Array, Array]  # Q [3][3] and shift [3]


def rewritten(source: Path, target: Path, move: Move, renumber: bool) -> None:
    lines = source.read_text(encoding="ascii").splitlines()
    nodes = _section(lines, "Nodes")
    elements = _section(lines, "Elements")
    rows = [line.split() for line in lines[nodes]]
    tags = [row[0] for row in rows]
    new_tags = random.Random(SEED).sample(tags, len(tags)) if renumber else tags
    renamed = dict(zip(tags, new_tags))
    points = np.array([[float(number) for number in row[1:]] for row in rows]) @ move[0].T + move[1]
    written = [
        f"{renamed[tag]} {' '.join(repr(float(x)) for x in point)}" for tag, point in zip(tags, points)
    ]
    cells = [_renamed(line.split(), renamed) for line in lines[elements]]
    if renumber:
        written.sort(key=lambda line: int(line.split()[0]))
        random.Random(SEED).shuffle(cells)
        cells = [f"{number} {cell.split(' ', 1)[1]}" for number, cell in enumerate(cells, 1)]
    lines[elements] = cells
    lines[nodes] = written
    target.write_text("\n".join(lines) + "\n", encoding="ascii")


def _section(lines: list[str], name: str) -> slice:
    """Without its first line, the count."""
    return slice(lines.index(f"${name}") + 2, lines.index(f"$End{name}"))


def _renamed(words: list[str], renamed: dict[str, str]) -> str:
    first = 3 + int(words[2])  # number, type, count of tags, tags
    return " ".join(words[:first] + [renamed[tag] for tag in words[first:]])
