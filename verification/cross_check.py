"""Run one scene with the driver and with the oracle, and compare every field at every output step.

    cross_check.py SCENE.toml [--set KEY=VALUE]... [--ranks N]... [--processes P]... [--driver PROGRAM] [--tolerance T]

The driver runs alone, with the strategy that the scene asks for, and by strategy "newton-krylov" on each number P of
processes (1 is without mpirun), the oracle on each number N of ranks (1 if none is given). Each run of the driver is
compared with each of the oracle, and those on P processes also with the driver alone.

Exits 0 if all agree, 1 if not, 2 if a program could not run. The tolerance of 1e-9 is that of the project: both
solve each step to a relative residual of 1e-12, and the steepest law (friction at slip speeds near its
regularisation) multiplies an error in the velocity by at most a few hundred.
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile
from collections.abc import Sequence

import compare
import oracle_results

HERE = pathlib.Path(__file__).resolve().parent
KRYLOV = ["--set", 'solver.strategy="newton-krylov"']


class Failed(Exception):
    """A program did not run to its end."""


def parse() -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("scene")
    parser.add_argument("--set", action="append", default=[], dest="overrides", metavar="KEY=VALUE")
    parser.add_argument("--ranks", action="append", type=int, metavar="N")
    parser.add_argument("--processes", action="append", default=[], type=int, metavar="P")
    parser.add_argument("--driver", default=str(HERE.parent / "build" / "thermocontact"))
    parser.add_argument("--tolerance", default="1e-9")
    return parser.parse_args()


def on(count: int, program: Sequence[str]) -> list[str]:
    """The command that starts the program on so many processes; one needs no mpirun."""
    return [*program] if count == 1 else ["mpirun", "-n", str(count), *program]


def run(command: Sequence[str]) -> None:
    code = subprocess.run(command).returncode
    if code != 0:
        raise Failed(f"exit {code}: {' '.join(command)}")


class Check:
    """The runs in one folder, and the worst outcome of comparing them."""

    def __init__(self, arguments: argparse.Namespace, folder: pathlib.Path) -> None:
        self.arguments, self.folder, self.worst = arguments, folder, 0
        overrides = [word for setting in arguments.overrides for word in ("--set", setting)]
        self.scene = [arguments.scene, "--quiet", *overrides]

    def driver(self, processes: int | None) -> pathlib.Path:
        """On several processes, or alone; None: alone and as the scene says."""
        results = self.folder / f"driver-{processes or 'alone'}"
        strategy = KRYLOV if processes else []
        program = [self.arguments.driver, "run", *self.scene, *strategy, "--output", str(results)]
        run(on(processes or 1, program))
        return results

    def oracle(self, ranks: int, followed: pathlib.Path) -> pathlib.Path:
        """In the steps of the driver's results, where these are adapted."""
        results = self.folder / f"oracle-{ranks}"
        kept = (pathlib.Path(self.arguments.scene), results, self.arguments.overrides, ranks, followed)
        if not oracle_results.fetch(*kept):
            program = [sys.executable, str(HERE / "oracle.py"), *self.scene, "--output", str(results)]
            run(on(ranks, [*program, "--follow", str(followed)]))
            oracle_results.keep(*kept)
        return results

    def compare(self, a: pathlib.Path, b: pathlib.Path) -> None:
        print(f"{a.name} against {b.name}", flush=True)
        code = compare.main([str(a), str(b), "--tolerance", self.arguments.tolerance])
        self.worst = max(self.worst, code)


def main() -> int:
    """Run everything once and compare each time."""
    arguments = parse()
    with tempfile.TemporaryDirectory() as folder:
        check = Check(arguments, pathlib.Path(folder))
        try:
            alone = check.driver(None)
            several = [check.driver(processes) for processes in arguments.processes]
            oracles = [check.oracle(ranks, alone) for ranks in arguments.ranks or [1]]
        except Failed as failure:
            print(f"cross_check: {failure}", file=sys.stderr)
            return 2
        for results in several:
            check.compare(alone, results)
        for results in (alone, *several):
            for oracle in oracles:
                check.compare(results, oracle)
    return check.worst


if __name__ == "__main__":
    sys.exit(main())
