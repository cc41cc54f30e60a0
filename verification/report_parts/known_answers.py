"""Benchmarks whose exact answer is known."""

import re
from collections.abc import Sequence
from pathlib import Path

from report_parts.html import details, picture, table
from report_parts.section import DRIVER, OUT, Command, Findings, Kept, Section, Unreadable

ROW = re.compile(r"^(.{58}) +(\S+) +(\S+) +(\S+) +(\S+)  (ok|FAILED)$")
FIGURE = "known-answers.png"
SMALL = ["slope-creep", "conductance-slab"]


def commands(small: bool) -> list[Command]:
    program, hidden = "verification/known_answers.py", ["--driver", DRIVER]
    answers = Command("answers", [program, *(SMALL if small else [])], hidden)
    return (
        [answers] if small else [answers, Command("figure", [program, "--figure", f"{OUT}/{FIGURE}"], hidden)]
    )


def read(folder: Path, kept: Sequence[Kept]) -> Findings:
    rows, benchmark, failed, share, worst = [], "", 0, -1.0, ""
    for line in kept[0].printed.splitlines():
        if found := ROW.match(line):
            quantity, expected, value, difference, tolerance, verdict = (
                text.strip() for text in found.groups()
            )
            rows.append([benchmark, quantity, expected, value, difference, tolerance, verdict])
            failed += verdict != "ok"
            used = abs(float(difference)) / float(tolerance) if float(tolerance) else 0.0
            if verdict != "ok" or used > share:
                share, worst = used, f"{benchmark}: {quantity}: {difference} of {tolerance} allowed"
        elif line.startswith("FAILED"):
            failed += 1
            worst = f"{benchmark}: {line}"
        elif re.fullmatch(r"[a-z-]+", line):
            benchmark = line
    if not rows:
        raise Unreadable("no quantities in the output of known_answers.py")
    words = f"{len(rows) - failed} of {len(rows)} quantities within tolerance; nearest to its own is {worst}"
    header = ["benchmark", "quantity", "exact", "found", "difference", "tolerance", ""]
    blocks = [details(f"All {len(rows)} quantities", table(header, rows))]
    if (folder / FIGURE).is_file():
        blocks.insert(0, picture(folder / FIGURE, "Pressures against the exact answers"))
    return Findings(kept[0].exit_code == 0, words, blocks)


SECTION = Section(
    "known-answers",
    "Does it find answers that are known?",
    "Each scene in scenes/benchmarks states the exact value, the tolerance with its derivation, and the "
    "source.",
    commands,
    read,
)
