"""How far the results in two folders are apart."""

import csv
from pathlib import Path

import numpy as np
import numpy.typing as npt

from oracle_parts import vtu

Array = npt.NDArray[np.float64]
# columns that say how a step was solved, and how well: they follow the last digits
HOW = (
    "newton_iterations",
    "heat_iterations",
    "retries",
    "energy_residual",
    "heat_residual",
    "force_residual",
)


class Differs(Exception):
    """Results are not what they must be."""


def history(folder: Path) -> dict[str, Array]:
    """Raises Differs where a row is not whole or a step is missing or there twice."""
    with (folder / "history.csv").open(encoding="ascii", newline="") as file:
        rows = list(csv.reader(file))
    if any(len(row) != len(rows[0]) for row in rows):
        raise Differs(f"{folder}: a row of history.csv is not whole")
    table = np.array([[float(cell) for cell in row] for row in rows[1:]])
    columns = dict(zip(rows[0], table.T))
    steps = columns["step"]
    if not np.array_equal(steps, np.arange(steps[0], steps[-1] + 1)):
        raise Differs(f"{folder}: the steps in history.csv are {steps}")
    return columns


def scale_of(name: str, columns: dict[str, Array]) -> float:
    """What differences of a column are relative to: its largest value; of a jump as the mesh changes, as the difference
    of two energies, that of what is stored."""
    if name == "heat_of_remeshing":
        steps = np.diff(columns["time"], prepend=0.0)
        return float(np.abs(np.cumsum(columns["heat_storage_rate"] * steps)).max())
    return float(np.abs(columns[name.removesuffix("_of_remeshing")]).max())


def history_distance(whole: Path, other: Path) -> float:
    """The largest difference of a column at the steps of `other`, relative to scale_of()."""
    a, b = history(whole), history(other)
    if list(a) != list(b) or a["step"][-1] != b["step"][-1]:
        raise Differs(f"{other}: history.csv has other columns or another end than {whole}")
    rows = slice(int(b["step"][0] - a["step"][0]), None)
    worst = 0.0
    for name in a.keys() - set(HOW):
        scale = scale_of(name, a)
        if scale > 0:
            worst = max(worst, float(np.abs(a[name][rows] - b[name]).max()) / scale)
    return worst


def final_fields(folder: Path) -> dict[str, Array]:
    """Nodal fields of the last output, written by one process."""
    last = [entry for entry in vtu.read_collection(folder / "fields.pvd") if entry.part == 0][-1]
    return dict(vtu.read_grid(folder / last.file).point_data)


def field_distance(a: dict[str, Array], b: dict[str, Array]) -> float:
    """The largest difference of a field, relative to its largest value."""
    if a.keys() != b.keys():
        raise Differs(f"other fields: {sorted(a)} and {sorted(b)}")
    return max(float(np.abs(a[name] - b[name]).max() / np.abs(a[name]).max()) for name in a)


def check_same_files(whole: Path, other: Path) -> None:
    """Raises Differs unless both hold the same fields at the same times and adaptive steps, byte by byte."""
    files = [
        {
            str(path.relative_to(folder)): path
            for path in [folder / "fields.pvd", *folder.glob("steps.csv"), *(folder / "fields").iterdir()]
        }
        for folder in (whole, other)
    ]
    if files[0].keys() != files[1].keys():
        raise Differs(f"{other}: other files than {whole}: {sorted(files[0].keys() ^ files[1].keys())}")
    for name, path in files[0].items():
        if path.read_bytes() != files[1][name].read_bytes():
            raise Differs(f"{other}: {name} differs from that of {whole}")
