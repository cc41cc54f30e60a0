"""Push every parameter to its limits, and see that each run completes or says clearly why it stopped.

    extremes.py [--driver PROGRAM] [--output DIR] [--draws N] [--seed S] [--only TEXT | --mended]
                [--second-opinion SHARE]

Runs each parameter alone, pairs of them, situations and random draws (fixed seed), some in space or by the other strategy, on a small scene that has all physics.
A tenth of the completed cases, drawn at random, is solved again by the oracle. With --output: cases.csv, maps of
parameter against parameter, and the scenes.

Exit codes: 0 all ended well and at least 95 % completed, 1 not so, 2 the study itself could not be made.
"""

import argparse
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from extremes_parts import report
from extremes_parts.cases import CONTESTED, MENDED, SEED, Case, all_cases
from extremes_parts.judge import BAD, COMPLETED, Verdict, judge
from extremes_parts.report import Row
from extremes_parts.runs import Driver
from extremes_parts.second_opinion import second_opinions

ENOUGH = 0.95  # of the cases that have a solution
WORKERS = 2


def parse() -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    built = Path(__file__).resolve().parents[1] / "build" / "thermocontact"
    parser.add_argument("--driver", type=Path, default=built)
    parser.add_argument("--output", type=Path, help="folder for the table, the maps and the scenes")
    parser.add_argument("--draws", type=int, default=240, help="number of random draws (default 240)")
    parser.add_argument("--seed", type=int, default=SEED, help="of the draws")
    chosen = parser.add_mutually_exclusive_group()
    chosen.add_argument("--only", default="", metavar="TEXT", help="cases whose group or name has this text")
    chosen.add_argument("--mended", action="store_true", help="cases that failed once, and must not again")
    parser.add_argument("--small", action="store_true", help="a small picture, no PDF")
    parser.add_argument(
        "--second-opinion",
        type=float,
        default=0.1,
        metavar="SHARE",
        help="of the completed cases (default 0.1)",
    )
    return parser.parse_args()


def run_all(driver: Driver, cases: list[Case]) -> list[Row]:
    """Each case once, two at a time."""

    def one(numbered: tuple[int, Case]) -> Row:
        number, case = numbered
        ended = driver.case(number, case)
        verdict = judge(case, ended)
        return Row(case, ended, verdict)

    with ThreadPoolExecutor(max_workers=WORKERS) as pool:
        return list(pool.map(one, enumerate(cases)))


def with_second_opinions(rows: list[Row], driver: Driver, share: float) -> list[Row]:
    """A completed case that the second opinion contradicts is bad after all."""
    opinions = second_opinions(rows, driver, share)
    result = []
    for number, row in enumerate(rows):
        opinion = opinions.get(number)
        if opinion is not None and not opinion.agrees:
            row = Row(row.case, row.ended, Verdict(BAD, "silent wrong answer? " + opinion.text), opinion)
        elif opinion is not None:
            row = Row(row.case, row.ended, row.verdict, opinion)
        result.append(row)
    return result


def study(options: argparse.Namespace, folder: Path) -> int:
    cases = [
        case
        for case in all_cases(options.draws, options.seed)
        if options.only in f"{case.group}: {case.name}"
    ]
    if options.mended:
        cases = [case for case in cases if case.name in MENDED | CONTESTED]
    if not cases:
        print(f"extremes: no case has {options.only!r} in its name", file=sys.stderr)
        return 2
    driver = Driver(options.driver.resolve(), folder / "scenes")
    rows = with_second_opinions(run_all(driver, cases), driver, options.second_opinion)
    report.print_table(rows)
    if options.output:
        report.write_csv(rows, folder / "cases.csv")
        from extremes_parts import picture  # matplotlib takes a second, which checks do without

        picture.draw(rows, folder, options.small)
    solvable = [row for row in rows if not row.case.singular]
    completed = sum(row.verdict.outcome == COMPLETED for row in solvable)
    bad = sum(row.verdict.outcome == BAD for row in rows)
    enough = 0 if options.mended else ENOUGH  # some of these are to stop, with the right reason
    return 1 if bad or completed < enough * len(solvable) else 0


def main() -> int:
    options = parse()
    if options.output:
        options.output.mkdir(parents=True, exist_ok=True)
        return study(options, options.output.resolve())
    with tempfile.TemporaryDirectory(prefix="extremes-") as folder:
        return study(options, Path(folder))


if __name__ == "__main__":
    sys.exit(main())
