"""The balances that every step proves of itself."""

import json
from collections.abc import Sequence
from pathlib import Path

from benchmarking.process import ROOT
from report_parts.html import table
from report_parts.section import DRIVER, OUT, Command, Findings, Kept, Section

TOLERANCE = 1e-9  # of what a run should keep; above 1e-8 a step is not even accepted (docs/audits.md)


def commands(small: bool) -> list[Command]:
    scenes = ["paper"] if small else sorted(path.stem for path in (ROOT / "scenes").glob("*.toml"))
    return [
        Command(
            name, [DRIVER, "run", f"scenes/{name}.toml", "--quiet", "--output", f"{OUT}/{name}"], judged=(0,)
        )
        for name in scenes
    ]


def read(folder: Path, kept: Sequence[Kept]) -> Findings:
    rows, worst, where = [], -1.0, ""
    for run in kept:
        name = run.command.name
        summary = json.loads((folder / name / "summary.json").read_text(encoding="utf-8"))
        audit = {balance: float(value) for balance, value in summary["audit"].items() if value is not None}
        unknowns = sum(summary["mesh"]["unknowns"].values())
        row = [name, str(unknowns), str(summary["newton"]["iterations"])]
        rows.append(row + [f"{audit[balance]:.1e}" if balance in audit else "–" for balance in BALANCES])
        for balance, value in audit.items():
            if not value <= worst:
                worst, where = value, f"{balance} of {name}"
    words = f"largest relative residual {worst:.1e} ({where}), allowed {TOLERANCE:.0e}"
    header = ["scene", "unknowns", "Newton iterations", *BALANCES]
    return Findings(worst <= TOLERANCE, words, [table(header, rows)])


BALANCES = ("energy", "heat", "force")

SECTION = Section(
    "audits",
    "Does every step balance?",
    "Energy, heat and force balances of the discrete scheme are identities: they hold to round-off where "
    "each step was solved. The driver forms them from the assembled residuals at every step; given are "
    "the largest of a run.",
    commands,
    read,
)
