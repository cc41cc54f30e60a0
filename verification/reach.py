"""Reach: the error that the paper's scheme makes at h = k = 1/64 and 1/128, in how small a part of its time?

    python3 verification/reach.py [--output DIR] [--rounds R] [--small] [--small-pictures] [--driver PROGRAM]

The scene is paper-isotropic with theta_F = 10; epsilon and all data of the model are the scene's in every run. Errors
are the three norms of E_hk (MODEL.md, 2) of the difference to one reference, norms over the body, by a Gauss rule in each
of its cells (lattice_errors.py), each norm's largest over 64 equally spaced times. The first is 1/64, the earliest
that the coarser of the paper's runs has; the error peaks there or shortly after, as loads and theta_F begin suddenly.
Earlier states exist in the paper's run at 1/128 alone and are not counted for or against anyone; what E_hk is with
them is printed. All runs step through all of these times: nothing is interpolated.

The reference (degree 2, graded toward all sides, adaptive bdf2) is bounded in each norm: its mesh is coarsened by 2
and by 4, and, on the mesh coarser by 2, its tolerance loosened by 10 and by 100; tradeoff_parts/bounds.py says what the
bound is. A configuration reaches the paper's error if none of its three norms is larger, and surely does if that holds
even where the reference's error adds to the one and takes from the other.

Times are those of setup, factorisations and steps without output of fields, one thread, medians of R rounds in which
all configurations run in turn. In DIR: reach.csv, reach.md, reach.png. Exit codes: 0 done, whatever was reached; 1 a
run failed.
"""

import argparse
import sys
from pathlib import Path

from reach_parts.configurations import plan, small_plan
from reach_parts.measure import Driver, RunFailed, measured, timed
from reach_parts.report import draw, markdown, verdicts, write

ROOT = Path(__file__).resolve().parent.parent


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="The paper's errors in how small a part of its time.")
    parser.add_argument("--output", type=Path, default=Path("reach"), metavar="DIR")
    parser.add_argument("--rounds", type=int, default=5, metavar="R")
    parser.add_argument("--small", action="store_true", help="coarse runs: the machinery alone")
    parser.add_argument("--small-pictures", action="store_true", help="one PNG for a page")
    parser.add_argument("--driver", type=Path, default=ROOT / "build" / "thermocontact")
    return parser.parse_args()


def main() -> int:
    arguments = parse()
    driver = Driver(arguments.driver.resolve(), ROOT / "scenes" / "paper-isotropic.toml")
    try:
        of = small_plan() if arguments.small else plan()
        errors = measured(driver, of, lambda text: print(text, flush=True))
        print(f"times, {arguments.rounds} rounds", flush=True)
        found = timed(driver, of, errors, arguments.rounds)
        write(found, arguments.output)
        draw(found, arguments.output, arguments.small_pictures)
    except (RunFailed, OSError, ValueError) as failure:
        print(f"reach: {failure}", file=sys.stderr)
        return 1
    print(markdown(found))
    print("\n".join(verdicts(found)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
