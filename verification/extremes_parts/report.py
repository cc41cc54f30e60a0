"""The table of outcomes: by group on the terminal, by case as CSV."""

import csv
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from extremes_parts.cases import Case
from extremes_parts.judge import BAD, COMPLETED, STOPPED, Verdict
from extremes_parts.runs import Ended
from extremes_parts.second_opinion import Opinion

GROUPS = ("alone", "exact friction", "in space", "newton-krylov", "pair", "draw", "situation")


@dataclass(frozen=True)
class Row:
    case: Case
    ended: Ended
    verdict: Verdict
    opinion: Opinion | None = None


def print_table(rows: Sequence[Row]) -> None:
    print(
        f"{'group':<14} {'cases':>5} {COMPLETED:>10} {STOPPED:>8} {BAD:>5} {'retries':>8} {'longest run':>12}"
    )
    for name in (*GROUPS, "all"):
        chosen = [row for row in rows if name in (row.case.group, "all")]
        if chosen:
            print(_line(name, chosen))
    opinions = [row.opinion for row in rows if row.opinion is not None]
    if opinions:
        by = Counter(opinion.by for opinion in opinions)
        share = ", ".join(f"{count} by {name}" for name, count in sorted(by.items()))
        print(f"second opinions: {share}; {sum(not opinion.agrees for opinion in opinions)} disagree")
    for row in rows:
        if row.verdict.outcome != COMPLETED:
            print(
                f"\n{row.verdict.outcome}: {row.case.group}: {row.case.name} ({row.ended.directory.name})\n    {row.verdict.why}"
            )


def _line(name: str, rows: Sequence[Row]) -> str:
    outcomes = Counter(row.verdict.outcome for row in rows)
    retries = sum(row.verdict.retries > 0 for row in rows)
    return (
        f"{name:<14} {len(rows):>5} {outcomes[COMPLETED]:>10} {outcomes[STOPPED]:>8} {outcomes[BAD]:>5} "
        f"{retries:>8} {max(row.ended.seconds for row in rows):>10.1f} s"
    )


def write_csv(rows: Iterable[Row], file: Path) -> None:
    with file.open("w", encoding="utf-8", newline="") as stream:
        table = csv.writer(stream)
        table.writerow(
            ["group", "case", "scene", "outcome", "retries", "iterations", "seconds", "second opinion", "why"]
        )
        for row in rows:
            verdict, opinion = row.verdict, row.opinion.text if row.opinion else ""
            table.writerow(
                [row.case.group, row.case.name, row.ended.directory.name, verdict.outcome, verdict.retries]
                + [verdict.iterations, f"{row.ended.seconds:.3f}", opinion, verdict.why]
            )
