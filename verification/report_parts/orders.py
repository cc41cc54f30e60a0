"""Orders of convergence on manufactured solutions."""

import csv
from collections.abc import Sequence
from pathlib import Path

from manufactured_parts.study import TOLERANCE
from report_parts.html import details, markdown_rows, picture, table
from report_parts.section import MANUFACTURED, OUT, Command, Findings, Kept, Section, Unreadable


def commands(small: bool) -> list[Command]:
    part = ["--case", "heat", "--cell", "quadrilateral", "--degree", "1"] if small else []
    words = ["verification/manufactured.py", *part, "--output", OUT, "--small"]
    return [Command("orders", words, ["--program", MANUFACTURED])]


def read(folder: Path, kept: Sequence[Kept]) -> Findings:
    with (folder / "orders.csv").open(encoding="ascii", newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["order"]]
    if not rows:
        raise Unreadable("no orders in orders.csv")
    worst = max(rows, key=lambda row: abs(float(row["order"]) - float(row["theory"])))
    difference = abs(float(worst["order"]) - float(worst["theory"]))
    off = sum(not abs(float(row["order"]) - float(row["theory"])) <= TOLERANCE for row in rows)
    words = (
        f"{len(rows) - off} of {len(rows)} orders within {TOLERANCE} of theory; the worst is {difference:.3f} off: "
        f"{float(worst['order']):.3f} for {worst['theory']} ({worst['case']}, {worst['cell']}, degree "
        f"{worst['degree']}, {worst['norm']})"
    )
    header, *summary = markdown_rows((folder / "orders.md").read_text(encoding="utf-8"))
    blocks = [
        "<p>Smallest and largest order in the L2 norms; in the energy norms.</p>",
        table(header, summary),
        picture(
            folder / "orders.png", "Errors against h and k beside the slopes of theory, a panel for each cell"
        ),
    ]
    cells = sorted(path for path in folder.glob("orders-*.png"))
    if cells:
        blocks.append(
            details("Each cell, a panel for each case", *(picture(path, path.stem) for path in cells))
        )
    return Findings(off == 0, words, blocks)


SECTION = Section(
    "orders",
    "Does it converge as theory says?",
    "Exact fields are written in UFL, which derives the loads that make them exact from the equations in "
    "strong form. In L2 the error must fall with h to the power p + 1, in the energy norms with h to the "
    "power p, and with the step in the order of the scheme.",
    commands,
    read,
    files=True,
)
