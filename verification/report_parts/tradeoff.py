"""Speed against accuracy on the paper's scene: what each knob costs and buys."""

import csv
from collections.abc import Mapping, Sequence
from pathlib import Path

from report_parts.html import picture, table
from report_parts.section import DRIVER, OUT, Command, Findings, Kept, Section, Unreadable
from tradeoff_parts.choice import SOURCES
from tradeoff_parts.plan import DEFAULT

NORMS = ("w", "strain", "theta")
ROUND_OFF = 1e-9  # of the sum: the distances are sums of their own
SMALL = ["--set", "mesh.cells=[8,8]", "--set", "time.steps=8", "--rounds", "1"]
SMALL_KNOBS = ["--knob", "the", "--knob", "mesh, degree 1", "--knob", "step, b", "--knob", "epsilon"]


def commands(small: bool) -> list[Command]:
    words = ["verification/tradeoff.py", *(SMALL + SMALL_KNOBS if small else []), "--output", OUT, "--small"]
    return [Command("tradeoff", words, ["--driver", DRIVER], judged=(0,))]


def read(folder: Path, kept: Sequence[Kept]) -> Findings:
    with (folder / "tradeoff.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    points = [row for row in rows if row["status"] == "completed"]
    own = next((row for row in rows if row["knob"] == "bound of the reference"), None)
    default = next((row for row in points if row["knob"] == DEFAULT), None)
    if own is None or default is None:
        raise Unreadable("no bound of the reference, or not the scene as it is, in tradeoff.csv")
    over = [row for row in points if float(row["error"]) > parts(row) * (1 + ROUND_OFF)]
    lost = [row for row in rows if row is not own and row["status"] != "completed"]
    told = default["told_from_reference"] == "True"
    sure = own["status"] == "bound"
    bounded = "bounded for each source" if sure else "an estimate where differences hardly fall"
    words = (
        f"{len(points)} of {len(points) + len(lost)} configurations completed, {len(over)} of them with an error "
        f"beyond the sum of its parts; the scene as it is errs by {float(default['error']):.1e}, the reference by at "
        f"most {float(own['error']):.1e} ({bounded}), where less than a third is asked"
    )
    with (folder / "prices.csv").open(encoding="utf-8", newline="") as file:
        prices = list(csv.DictReader(file))
    blocks = [
        price_table(prices),
        picture(folder / "tradeoff.png", "Error against time, and each knob's own"),
    ]
    return Findings(not over and not lost and told, words, blocks)


def parts(row: Mapping[str, str]) -> float:
    return sum(float(row[f"own_{source}"] or 0.0) for source in SOURCES)


def price_table(rows: Sequence[Mapping[str, str]]) -> str:
    header = ["knob", "its own error", "a digit more costs", "orders of w, ε(u), θ", "theory"]
    cells = []
    for row in rows:
        factor = f"a factor {float(row['factor_per_digit']):.2g}" if row["factor_per_digit"] else "–"
        errors = f"{float(row['from_error']):.1e} to {float(row['to_error']):.1e}"
        orders, theory = (
            ", ".join(
                f"{float(row[f'{what}_{norm}']):.2g}" if row[f"{what}_{norm}"] else "–" for norm in NORMS
            )
            for what in ("order", "theory")
        )
        cells.append([row["knob"], errors, factor, orders, theory])
    return table(header, cells)


SECTION = Section(
    "tradeoff",
    "What does accuracy cost?",
    "Every knob of the paper's scene is turned: the error in three norms against a reference whose own error is bounded "
    "for each source, split by source, and the time. The parts must add up to the error at least, and the reference "
    "must be far below the scene as it is. Orders below theory's have reasons, which tradeoff.txt lists: sudden loads, "
    "corners, contact that opens.",
    commands,
    read,
    files=True,
)
