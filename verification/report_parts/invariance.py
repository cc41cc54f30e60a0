"""The same scene, said otherwise."""

import re
from collections.abc import Sequence
from pathlib import Path

from report_parts.html import details, table
from report_parts.section import DRIVER, Command, Findings, Kept, Section, Unreadable

ROW = re.compile(r"^(FAILED )?(.+?) +(\S+) in (.*)$")
SUMMARY = re.compile(r"^(?:all (\d+) agree to (\S+)|(\d+) of (\d+) differ)$", re.MULTILINE)
TOLERANCE = 1e-10


def commands(small: bool) -> list[Command]:
    words = ["verification/invariance.py", *(["box: mirrored"] if small else [])]
    return [Command("invariance", words, ["--driver", DRIVER])]


def read(folder: Path, kept: Sequence[Kept]) -> Findings:
    (run,) = kept
    if not SUMMARY.search(run.printed):
        raise Unreadable("no summary in the output of invariance.py")
    found = [match.groups() for match in map(ROW.match, run.printed.splitlines()) if match]
    rows = [
        [name, difference, where, "FAILED" if failed else ""] for failed, name, difference, where in found
    ]
    rows.sort(key=lambda row: -float(row[1]))
    words = (
        f"largest relative difference {rows[0][1]} ({rows[0][0]}, of {len(rows)} ways), "
        f"allowed {TOLERANCE:.0e}"
    )
    header = ["said otherwise", "largest difference", "in", ""]
    return Findings(run.exit_code == 0, words, [details(f"All {len(rows)}", table(header, rows))])


SECTION = Section(
    "invariance",
    "Is the answer the same in other words?",
    "Lengths, times, masses and temperatures in other units, the body mirrored, turned or shifted, its mesh "
    "renumbered, the keys in another order: the fields must follow.",
    commands,
    read,
)
