"""Every scene with the driver and with the oracle."""

import re
from collections.abc import Sequence
from pathlib import Path

from benchmarking.process import ROOT
from report_parts.html import table
from report_parts.section import DRIVER, Command, Findings, Kept, Section, Unreadable, last_line

VERDICT = re.compile(r"^(\w+) .*?(\S+); the worst is (.*): (\S+)$")  # compare.py's last line


def commands(small: bool) -> list[Command]:
    scenes = ["heat-only"] if small else sorted(path.stem for path in (ROOT / "scenes").glob("*.toml"))
    return [
        Command(name, ["verification/cross_check.py", f"scenes/{name}.toml"], ["--driver", DRIVER])
        for name in scenes
    ]


def read(folder: Path, kept: Sequence[Kept]) -> Findings:
    rows, worst, tolerance, scene = [], -1.0, 0.0, ""
    for run in kept:
        found = VERDICT.match(last_line(run.printed))
        if not found:
            raise Unreadable(f"{run.command.name}: no verdict in {last_line(run.printed)!r}")
        _, tolerance_text, where, difference = found.groups()
        tolerance = float(tolerance_text)
        if not float(difference) <= worst:
            worst, scene = float(difference), run.command.name
        rows.append([run.command.name, difference, where, "ok" if run.exit_code == 0 else "FAILED"])
    words = (
        f"largest relative difference of any field at any output step {worst:.1e} ({scene}), "
        f"allowed {tolerance:.0e}"
    )
    passes = all(run.exit_code == 0 for run in kept)
    return Findings(passes, words, [table(["scene", "largest difference", "in", ""], rows)])


SECTION = Section(
    "agreement",
    "Does an independent program find the same?",
    "The oracle solves the same scene file with dolfinx, from a weak form of its own and with Newton's "
    "method on the full system; it shares no line with the driver. Every field is compared at every "
    "output step, relative to its largest value. Both solve each step to 1e-12, and the steepest law "
    "multiplies an error by a few hundred at most.",
    commands,
    read,
)
