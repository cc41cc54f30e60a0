"""Run one scene with the driver and with the oracle, and compare every field at every output step.

    cross_check.py SCENE.toml [--set KEY=VALUE]... [--ranks N]... [--driver PROGRAM] [--tolerance T]

Exits 0 if all agree, 1 if not, 2 if a program could not run. The tolerance of 1e-9 is that of the project: both
solve each step to a relative residual of 1e-12, and the steepest law (friction at slip speeds near its
regularisation) multiplies an error in the velocity by at most a few hundred.
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile

import oracle_results

HERE = pathlib.Path(__file__).resolve().parent


def parse() -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("scene")
    parser.add_argument("--set", action="append", default=[], dest="overrides", metavar="KEY=VALUE")
    parser.add_argument("--ranks", action="append", type=int, metavar="N")
    parser.add_argument("--driver", default=str(HERE.parent / "build" / "thermocontact"))
    parser.add_argument("--tolerance", default="1e-9")
    return parser.parse_args()


def main() -> int:
    """Run the driver once, the oracle for each number of ranks, and compare each time."""
    arguments = parse()
    overrides = [word for setting in arguments.overrides for word in ("--set", setting)]
    worst = 0
    with tempfile.TemporaryDirectory() as folder:
        driver = f"{folder}/driver"
        run = [arguments.driver, "run", arguments.scene, "--quiet", "--output", driver, *overrides]
        if subprocess.run(run).returncode != 0:
            return 2
        for ranks in arguments.ranks or [1]:
            oracle = f"{folder}/oracle-{ranks}"
            kept = (pathlib.Path(arguments.scene), pathlib.Path(oracle), arguments.overrides, ranks)
            if not oracle_results.fetch(*kept):
                program = [
                    sys.executable,
                    str(HERE / "oracle.py"),
                    arguments.scene,
                    "--quiet",
                    "--output",
                    oracle,
                    "--follow",
                    driver,
                ]
                if subprocess.run(["mpirun", "-n", str(ranks), *program, *overrides]).returncode != 0:
                    return 2
                oracle_results.keep(*kept)
            print(f"driver against oracle on {ranks} ranks", flush=True)
            compare = [
                sys.executable,
                str(HERE / "compare.py"),
                driver,
                oracle,
                "--tolerance",
                arguments.tolerance,
            ]
            worst = max(worst, subprocess.run(compare).returncode)
    return worst


if __name__ == "__main__":
    sys.exit(main())
