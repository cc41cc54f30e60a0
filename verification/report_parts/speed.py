"""Times, side by side with the oracle's."""

import json
from collections.abc import Sequence
from pathlib import Path

from report_parts.html import table
from report_parts.section import DRIVER, OUT, Command, Findings, Kept, Section, Unreadable


def commands(small: bool) -> list[Command]:
    few = ["--sizes", "8", "16", "--oracle-sizes", "8", "--repeat", "1"] if small else []
    return [
        Command("side by side", ["verification/benchmark.py", "--output", OUT, *few], ["--driver", DRIVER])
    ]


def read(folder: Path, kept: Sequence[Kept]) -> Findings:
    try:
        found = json.loads((folder / "benchmark.json").read_text(encoding="utf-8"))
        beside = [
            [
                str(row["n"]),
                *(f"{row[key]['median']:.3g}" for key in ("driver_seconds", "oracle_seconds")),
                f"{row['ratio']:.0f}",
            ]
            for row in found["against_oracle"]
        ]
        steps = [
            [str(row["n"]), f"{1e3 * row['step_seconds']['median']:.3g}", f"{row['peak_memory_mib']:.0f}"]
            for row in found["growth"]
        ]
        n, _, _, ratio = beside[-1]
        twice = found["against_memory"]["factors_twice_seconds"]["array_of_the_factors_size"]
        against = found["growth"][-1]["step_seconds"]["median"] / twice
    except (OSError, ValueError, KeyError, IndexError) as problem:
        raise Unreadable(f"benchmark.json: {problem!r}") from problem
    words = (
        f"both solve the same problem; at n = {n} the whole process takes 1/{ratio} of the oracle's time, "
        f"at n = {steps[-1][0]} a step {against:.1f} times what reading both factors twice takes"
    )
    return Findings(
        all(run.exit_code == 0 for run in kept),
        words,
        [
            table(["n", "driver, s", "oracle, s", "ratio"], beside),
            table(["n", "ms a step", "peak memory, MiB"], steps),
        ],
    )


SECTION = Section(
    "speed",
    "How fast is it?",
    "Driver and oracle in turn on paper-isotropic with h = k = 1/n, whole processes, medians; steps as n grows, "
    "and what reading the factors from memory takes at least. A time is no verdict: the machine may be busy. What "
    "is judged is that both solve the same problem.",
    commands,
    read,
)
