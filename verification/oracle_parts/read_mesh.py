"""[mesh]: the shape or the file, how it is graded, whether it adapts."""

from pathlib import Path

from oracle_parts.errors import SceneError
from oracle_parts.scene import SIDES, Shape
from oracle_parts.tables import Table, count, list_of, not_negative, number, one_of, positive, ratio

SHAPES = {"rectangle": 2, "box": 3}


def read_mesh(mesh: Table, path: Path) -> tuple[int, Shape | None, Path | None]:
    """The dimension, and the shape or the file."""
    name = mesh.optional("file", str)
    if name is not None:
        file = path.parent / name
        return max(dimension for dimension, _, _ in group_names(file)), None, file
    dimension = SHAPES[mesh.take("shape", one_of(*SHAPES), "rectangle")]
    lower = mesh.take("lower", list_of(number, dimension), dimension * [0.0])
    upper = mesh.take("upper", list_of(number, dimension), dimension * [1.0])
    cells = mesh.take("cells", list_of(count, dimension))
    cell = mesh.take("cell", one_of("simplex", "tensor"), "simplex")
    diagonal = mesh.take("diagonal", one_of("right", "left", "crossed"), "right")
    return dimension, Shape(lower, upper, cells, cell, diagonal, _grading(mesh, dimension)), None


def adapts_mesh(mesh: Table) -> bool:
    """Whether the mesh adapts; how it does is the driver's own affair (followed_mesh.py)."""
    table = mesh.table("refinement")
    if table is None:
        return False
    table.take("tolerance", positive)
    for limit, value in (("every", 5), ("max_cells", 200000), ("max_level", 30)):
        table.take(limit, not_negative if limit == "max_level" else count, value)
    table.close()
    return True


def _grading(mesh: Table, dimension: int) -> list[tuple[float, float]]:
    ratios = [(1.0, 1.0)] * dimension
    table = mesh.table("grading")
    if table is not None:
        ratios = [
            (table.take(one, ratio, 1.0), table.take(two, ratio, 1.0)) for one, two in SIDES[:dimension]
        ]
        table.close()
    return ratios


def group_names(file: Path) -> list[tuple[int, int, str]]:
    """(dimension, tag, name) of the physical groups in a Gmsh file; that section is text in binary files too."""
    try:
        content = file.read_bytes()
    except OSError as problem:
        raise SceneError(f"{file}: {problem}") from problem
    section = content.partition(b"$PhysicalNames")[2].partition(b"$EndPhysicalNames")[0].decode()
    rows = [row.split(maxsplit=2) for row in section.split("\n")[2:] if row.strip()]
    if not rows:
        raise SceneError(f"{file}: the oracle needs named physical groups")
    return [(int(dimension), int(tag), name.strip().strip('"')) for dimension, tag, name in rows]
