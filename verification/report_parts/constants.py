"""The theory's constants and bounds, computed twice."""

import re
from collections.abc import Sequence
from pathlib import Path

from report_parts.html import table
from report_parts.section import DRIVER, Command, Findings, Kept, Section, Unreadable

ROW = re.compile(r"^(\S+) +(\S+) +(\S+?)( +differs)?$")
TOLERANCE = 1e-5  # check prints six digits
LIPSCHITZ = ["--set", "boundary.bottom.contact.compliance.exponent=1.0"]
SCENES: dict[str, Sequence[str]] = {
    "paper": [],
    "press-fit": [],
    "box": LIPSCHITZ,
    "anisotropic": LIPSCHITZ,
}


def commands(small: bool) -> list[Command]:
    program = "verification/theory_constants.py"
    return [
        Command(name, [program, f"scenes/{name}.toml", *settings], ["--driver", DRIVER])
        for name, settings in SCENES.items()
        if name == "paper" or not small
    ]


def read(folder: Path, kept: Sequence[Kept]) -> Findings:
    rows, worst, where = [], -1.0, ""
    for run in kept:
        found = [match.groups() for match in map(ROW.match, run.printed.splitlines()) if match]
        numbers = [(name, float(here), float(there)) for name, here, there, _ in found if number(here, there)]
        if not numbers:
            raise Unreadable(f"{run.command.name}: no numbers")
        for name, here, there in numbers:
            difference = 0.0 if here == there else abs(here - there) / abs(there)
            rows.append([run.command.name, name, f"{here:.6g}", f"{there:.12g}", f"{difference:.1e}"])
            if not difference <= worst:
                worst, where = difference, f"{name} of {run.command.name}"
    words = f"largest relative difference {worst:.1e} ({where}), allowed {TOLERANCE:.0e}"
    passes = all(run.exit_code == 0 for run in kept)
    header = ["scene", "number", "check", "dolfinx, SciPy", "difference"]
    return Findings(passes, words, [table(header, rows)])


def number(*texts: str) -> bool:
    try:
        return all(isinstance(float(text), float) for text in texts)
    except ValueError:
        return False


SECTION = Section(
    "constants",
    "Are the theory's constants right?",
    "thermocontact check judges the paper's hypotheses with constants of trace, Korn's and Friedrichs' "
    "inequalities on the scene's mesh, and with bounds over all regions. Here dolfinx's matrices, SciPy's "
    "eigenvalues and NumPy find them again.",
    commands,
    read,
)
