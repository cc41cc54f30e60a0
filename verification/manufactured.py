"""Manufactured solutions: the orders in space and time that the driver shows, against those of theory.

    python3 verification/manufactured.py [--study space|time ...] [--case NAME ...] [--cell NAME ...] [--degree P ...]
                                         [--scheme NAME ...] [--graded RATIO] [--program build/manufactured] [--output DIR] [--small]

An exact u(x,t) and theta(x,t) is written in UFL (manufactured_parts/cases.py). UFL derives the loads, tractions and
contact sources that make it exact from the equations in strong form, FFCx compiles them, and the program `manufactured`
marches the scene with these sources and integrates the errors at the end. L2 errors must fall with h^(p+1), those of
eps(u) and grad(theta) with h^p, all with k in the order of the scheme, for every scheme of the scene's schema; each of
three observed orders within 0.1.

--output writes orders.csv, orders.txt, orders.md (the least and the greatest order of each case) and pictures. Exit codes: 0 all orders as in theory, 1 one is not, 2 wrong usage
or a run that failed, 3 a run that found no solution.
"""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from benchmarking.process import ROOT
from manufactured_parts import report
from manufactured_parts.cases import CASES
from manufactured_parts.scenes import CELLS
from manufactured_parts.study import (
    SCHEMES,
    STUDIES,
    TOLERANCE,
    Curve,
    Driver,
    NoSolution,
    RunFailed,
    all_curves,
    check_schemes,
)

AS_IN_THEORY, OFF, BROKEN, NOT_SOLVED = 0, 1, 2, 3


def parse(arguments: Sequence[str]) -> argparse.Namespace:
    degrees = sorted({degree for cell in CELLS.values() for degree in cell.sizes})
    parser = argparse.ArgumentParser(
        description="Compare orders of convergence on manufactured solutions with theory."
    )
    parser.add_argument("--study", choices=STUDIES, nargs="+", default=list(STUDIES))
    parser.add_argument("--case", choices=CASES, nargs="+", default=list(CASES))
    parser.add_argument("--cell", choices=CELLS, nargs="+", default=list(CELLS))
    parser.add_argument("--degree", type=int, choices=degrees, nargs="+", default=degrees)
    parser.add_argument(
        "--scheme", choices=SCHEMES, nargs="+", default=list(SCHEMES), help="of the study in time"
    )
    parser.add_argument("--graded", type=float, default=1.0, metavar="RATIO", help="toward some of the sides")
    parser.add_argument("--program", type=Path, default=ROOT / "build" / "manufactured")
    parser.add_argument("--output", type=Path, metavar="DIR", help="where table and pictures go")
    parser.add_argument("--small", action="store_true", help="small PNGs only, for a README")
    options = parser.parse_args(arguments)
    if not options.program.is_file():
        parser.error(f"no program at {options.program}")
    return options


def show(lines: list[str], text: str) -> None:
    lines.append(text)
    print(text, flush=True)


def measure(options: argparse.Namespace, lines: list[str]) -> list[Curve]:
    """All curves, each reported as soon as it is known."""
    found: list[Curve] = []
    program = options.program.resolve()
    check_schemes(program.with_name("thermocontact"))
    series = all_curves(
        Driver(program, options.graded),
        options.study,
        options.case,
        options.cell,
        options.degree,
        options.scheme,
    )
    for curves in series:
        for scheme in dict.fromkeys(curve.scheme for curve in curves):
            own = [curve for curve in curves if curve.scheme == scheme]
            show(lines, report.heading(own[0]))
            for curve in own:
                show(lines, report.row(curve))
        found += curves
    return found


def write(options: argparse.Namespace, lines: Sequence[str], curves: Sequence[Curve]) -> None:
    from manufactured_parts import picture  # matplotlib takes a second, which checks do without
    from plotting.style import Album, styled

    options.output.mkdir(parents=True, exist_ok=True)
    report.write_csv(options.output / "orders.csv", curves)
    (options.output / "orders.md").write_text(report.summary(curves), encoding="utf-8")
    (options.output / "orders.txt").write_text("\n".join(lines) + "\n", encoding="utf-8")
    with styled():
        picture.draw(curves, Album(options.output, options.small), "orders")


def main(arguments: Sequence[str]) -> int:
    options = parse(arguments)
    lines: list[str] = []
    try:
        curves = measure(options, lines)
        differences = [abs(order - curve.theory) for curve in curves for order in curve.orders]
        off = sum(not difference <= TOLERANCE for difference in differences)
        lowest = min(order for curve in curves for order in curve.orders)
        show(
            lines,
            f"\n{len(differences) - off} of {len(differences)} orders within {TOLERANCE} of theory; "
            f"largest difference {max(differences):.3f}, lowest order {lowest:.3f}",
        )
        if options.output:
            write(options, lines, curves)
    except (RunFailed, OSError) as problem:
        print(f"manufactured: {problem}", file=sys.stderr)
        return NOT_SOLVED if isinstance(problem, NoSolution) else BROKEN
    return OFF if off else AS_IN_THEORY


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
