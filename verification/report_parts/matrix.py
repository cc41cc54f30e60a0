"""An oracle for every switch."""

import re
from collections.abc import Sequence
from pathlib import Path

from report_parts.html import details, markdown_rows, table
from report_parts.section import DRIVER, OUT, Command, Findings, Kept, Section, Unreadable, last_line

SUMMARY = re.compile(r"^(\d+) cases, .*?(\d+) refusals; largest difference (\S+); (\d+) failures$")
TOLERANCE = 1e-9


def commands(small: bool) -> list[Command]:
    groups = ["heat.source"] if small else []
    words = ["verification/matrix.py", *groups, "--table", f"{OUT}/matrix.md"]
    return [Command("matrix", words, ["--driver", DRIVER])]


def read(folder: Path, kept: Sequence[Kept]) -> Findings:
    (run,) = kept
    found = SUMMARY.match(last_line(run.printed))
    if not found:
        raise Unreadable(f"no summary in {last_line(run.printed)!r}")
    cases, refusals, largest, failures = found.groups()
    header, *rows = markdown_rows((folder / "matrix.md").read_text(encoding="utf-8"))
    words = (
        f"largest relative difference of {cases} scenes {largest}, allowed {TOLERANCE:.0e}; "
        f"{refusals} wrong scenes refused by name; {failures} failures"
    )
    failed = [line for line in run.printed.splitlines() if line.startswith("FAILED")]
    blocks = [
        table(["keys", "scenes", "largest difference"], by_family(rows)),
        details(f"All {cases} scenes", table(header, rows)),
    ]
    if failed:
        blocks.insert(0, table(["failures"], [[line] for line in failed]))
    return Findings(run.exit_code == 0, words, blocks)


def by_family(rows: Sequence[Sequence[str]]) -> list[list[str]]:
    """The number of scenes and the largest difference for each table of keys."""
    families: dict[str, list[str]] = {}
    for key, _, _, difference, *_ in rows:
        parts = key.split(".")
        family = ".".join(parts[:3] if parts[0] in ("boundary", "region") else parts[:1])
        families.setdefault(family, []).append(difference)

    def largest(differences: Sequence[str]) -> str:
        if "failed" in differences:
            return "failed"
        return max(differences, key=float)

    return [[name, str(len(found)), largest(found)] for name, found in families.items()]


SECTION = Section(
    "matrix",
    "Is every switch checked?",
    "The schema that the driver prints says which keys there are; a key, a choice or a form of a value "
    "without a case is a failure. Each case must also move some field against its base scene, or say why "
    "it cannot.",
    commands,
    read,
)
