"""The error curve of the paper's example."""

import csv
from collections.abc import Sequence
from itertools import groupby
from pathlib import Path

from report_parts.html import picture, table
from report_parts.section import DRIVER, OUT, Command, Findings, Kept, Section, Unreadable


def commands(small: bool) -> list[Command]:
    sizes = ["--scene", "paper-isotropic", "--mode", "both", "--sizes", "4", "8", "--reference", "16"]
    words = ["verification/convergence.py", *(sizes if small else []), "--output", OUT, "--small"]
    return [Command("error-curve", words, ["--driver", DRIVER])]


def read(folder: Path, kept: Sequence[Kept]) -> Findings:
    with (folder / "error-curve.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    rows = [row for row in rows if row["mode"] == "both" and row["variant"] == rows[0]["variant"]]
    cells, ratios = [], []
    for scene, own in groupby(rows, key=lambda row: row["scene"]):
        curve = sorted(own, key=lambda row: -float(row["h"]))
        errors = [float(row["error"]) for row in curve]
        ratios += [fine / coarse for coarse, fine in zip(errors, errors[1:])]
        for row in curve:
            n, order = round(1 / float(row["h"])), float(row["order"])
            relative = float(row["relative_error"])
            cells.append([scene, f"1/{n}", f"{float(row['error']):.3e}", f"{relative:.1%}", f"{order:.2f}"])
    if not ratios:
        raise Unreadable("fewer than two sizes in error-curve.csv")
    words = (
        f"the error falls with every refinement of h = k: at worst to {max(ratios):.2f} of itself, where less "
        f"than 1 is asked; at the finest size {cells[-1][3]} of the solution ({cells[-1][0]}) "
        f"against h = k = 1/{rows[-1]['reference']}"
    )
    header = ["scene", "h = k", "E_hk", "of the solution", "order"]
    shown = [[cell.replace("nan", "–") for cell in row] for row in cells]
    return Findings(
        max(ratios) < 1,
        words,
        [table(header, shown), picture(folder / "error-curve.png", "Error against h + k")],
    )


SECTION = Section(
    "error-curve",
    "How large is the error on the paper's own example?",
    "Figure 5 of the paper: the largest error over all times, in the sum of three norms, against a fine "
    "reference. There is no tolerance to meet: loads that start suddenly, corners and a jump of the "
    "conductance keep the order below 1 in places; docs/accuracy.md shows by experiment which does what.",
    commands,
    read,
    files=True,
)
