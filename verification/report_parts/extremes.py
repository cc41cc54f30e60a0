"""Every parameter at its limits."""

import csv
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from report_parts.html import details, picture, table
from report_parts.section import DRIVER, OUT, Command, Findings, Kept, Section, Unreadable

OUTCOMES = ("completed", "stopped", "bad")


def commands(small: bool) -> list[Command]:
    part = ["--only", "alone: c_n", "--draws", "0", "--second-opinion", "0"] if small else []
    words = ["verification/extremes.py", *part, "--output", OUT, "--small"]
    return [Command("extremes", words, ["--driver", DRIVER])]


def read(folder: Path, kept: Sequence[Kept]) -> Findings:
    """Which scenes have no solution, and so may stop, only the study knows: its exit code is the verdict."""
    with (folder / "cases.csv").open(encoding="utf-8", newline="") as file:
        cases = list(csv.DictReader(file))
    if not cases:
        raise Unreadable("no cases in cases.csv")
    groups = {
        name: Counter(c["outcome"] for c in cases if c["group"] == name)
        for c in cases
        for name in [c["group"]]
    }
    outcomes = Counter(case["outcome"] for case in cases)
    opinions = sum(bool(case["second opinion"]) for case in cases)
    words = (
        f"{outcomes['completed']} of {len(cases)} runs completed, where 95 % of those with a solution are asked; "
        f"{outcomes['stopped']} stopped and said why; {outcomes['bad']} ended badly, where none may; "
        f"{opinions} solved again by another way"
    )
    rows = [[name, str(found.total()), *(str(found[o]) for o in OUTCOMES)] for name, found in groups.items()]
    blocks = [table(["group", "runs", *OUTCOMES], rows)]
    if (folder / "extremes.png").is_file():
        blocks.append(picture(folder / "extremes.png", "Outcomes, parameter against parameter"))
    rest = [[c["group"], c["case"], c["outcome"], c["why"]] for c in cases if c["outcome"] != "completed"]
    if rest:
        blocks.append(
            details(f"The {len(rest)} that did not complete", table(["group", "case", "", "why"], rest))
        )
    return Findings(kept[0].exit_code == 0, words, blocks)


SECTION = Section(
    "extremes",
    "What happens at the limits?",
    "Each parameter alone over many decades, pairs of them, situations and random draws, on a scene with all "
    "physics. A run must complete with finite fields and closed balances, or stop with the reason; a share of the "
    "completed ones is solved again by the oracle.",
    commands,
    read,
)
