"""Run the benchmarks with known answers and compare: scenes/benchmarks says what is expected, how nearly, and why.

    known_answers.py [--driver PROGRAM] [NAME...]       all, or the named ones; a row for each quantity
    known_answers.py --list
    known_answers.py [--driver PROGRAM] --figure FILE.png

Exits 0 if every quantity is within its tolerance, 1 if one is not or a run fails.
"""

import argparse
import sys
import tempfile
import tomllib
from collections.abc import Callable
from pathlib import Path

from known_answers_parts import blocks, exact, foundations, hertz, rods, springs, table, warmth
from known_answers_parts.driver import SCENES, Driver

BENCHMARKS: dict[str, Callable[[Driver], list[table.Row]]] = {
    "conductance-slab": exact.conductance_slab,
    "column": exact.column,
    "rod-impact": rods.rod_impact,
    "rod-signorini": rods.rod_signorini,
    "slope-creep": blocks.slope_creep,
    "slope-slide": blocks.slope_slide,
    "sliding-block": blocks.sliding_block,
    "hertz": hertz.hertz,
    "belt-block": foundations.belt_block,
    "disc-torque": foundations.disc_torque,
    "friction-heat": foundations.friction_heat,
    "oscillator": springs.oscillator,
    "drawn-block": springs.drawn_block,
    "convection-slab": warmth.convection_slab,
    "cooling-slab": warmth.cooling_slab,
    "stretched-bar": warmth.stretched_bar,
}


def parse() -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("names", nargs="*", metavar="NAME", help="one of: " + ", ".join(BENCHMARKS))
    parser.add_argument(
        "--driver", type=Path, default=Path(__file__).resolve().parents[1] / "build" / "thermocontact"
    )
    parser.add_argument("--list", action="store_true", help="name every benchmark")
    parser.add_argument("--figure", type=Path, metavar="FILE.png", help="draw the curves instead")
    arguments = parser.parse_args()
    for name in arguments.names:
        if name not in BENCHMARKS:
            parser.error(f"no benchmark {name}; there are {', '.join(BENCHMARKS)}")
    if arguments.figure and arguments.figure.suffix != ".png":
        parser.error("--figure needs a name that ends in .png")
    return arguments


def title(name: str) -> str:
    """What the scene says it is."""
    return str(tomllib.loads((SCENES / f"{name}.toml").read_text(encoding="utf-8"))["title"])


def check(driver: Driver, name: str) -> int:
    """Print the rows of one benchmark; the number of failures."""
    print(f"\n{name}\n{table.HEADER}")
    try:
        rows = BENCHMARKS[name](driver)
    except RuntimeError as failure:
        print(f"FAILED: {failure}", flush=True)
        return 1
    for row in rows:
        print(table.text(row))
    sys.stdout.flush()
    return sum(not row.passes for row in rows)


def main() -> int:
    """List, draw or check."""
    arguments = parse()
    if arguments.list:
        print("\n".join(f"{name:<18} {title(name)}" for name in BENCHMARKS))
        return 0
    with tempfile.TemporaryDirectory() as folder:
        driver = Driver(arguments.driver.resolve(), Path(folder))
        if arguments.figure:
            from known_answers_parts import picture  # matplotlib takes a second, which checks do without

            picture.draw(driver, arguments.figure)
            return 0
        failures = sum(check(driver, name) for name in arguments.names or BENCHMARKS)
    print(f"\n{failures} quantities beyond tolerance" if failures else "\nall within tolerance")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
