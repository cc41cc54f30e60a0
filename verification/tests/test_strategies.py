"""Strategy newton-krylov at size, and what the summary says of time and memory. THERMOCONTACT_DRIVER: the program."""

import csv
import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from typing import Any

from under_test import DRIVER, ROOT

PARTS = ("start", "setup", "factor", "steps", "output")
CLOCK_TICK = 0.02  # s, to which Linux tells when a process has started
TIMER = """
import subprocess, sys, time
start = time.perf_counter()
code = subprocess.call(sys.argv[1:])
print(f"wall {time.perf_counter() - start}", flush=True)
sys.exit(code)
"""
ITERATIONS = re.compile(r"(momentum|heat)_ solve converged due to \S+ iterations (\d+)")


def run(
    scene: str, *settings: str, petsc: tuple[str, ...] = (), processes: int = 1
) -> tuple[dict[str, Any], str]:
    with tempfile.TemporaryDirectory() as folder:
        launcher = [] if processes == 1 else ["mpirun", "-n", str(processes)]
        command = [*launcher, str(DRIVER), "run", str(ROOT / "scenes" / f"{scene}.toml"), "--output", folder]
        for setting in settings:
            command += ["--set", setting]
        if petsc:
            command += ["--", *petsc]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        summary = json.loads((Path(folder) / "summary.json").read_text())
        with (Path(folder) / "history.csv").open() as history:
            summary["momentum_solves"] = sum(int(row["newton_iterations"]) for row in csv.DictReader(history))
        return summary, done.stdout + done.stderr


def iterations_a_solve(cells: int, steps: int = 2, petsc: tuple[str, ...] = ()) -> float:
    """Of the momentum balance of a body in frictional contact."""
    summary, output = run(
        "box",
        f"mesh.cells=[{cells},{cells},{cells}]",
        f"time.steps={steps}",
        "output.fields=[]",
        'solver.strategy="newton-krylov"',
        petsc=("-momentum_ksp_converged_reason", *petsc),
    )
    # those after the steps estimate the condition, to other tolerances
    counts = [int(count) for _, count in ITERATIONS.findall(output)][: summary["momentum_solves"]]
    return sum(counts) / len(counts)


class Multigrid(unittest.TestCase):
    def test_iterations_hardly_grow_with_the_body(self) -> None:
        """Eight times the cells: an optimal method needs no more iterations, one level about twice as many."""
        small, large = iterations_a_solve(8), iterations_a_solve(16)
        self.assertLess(large, 1.5 * small)

    def test_without_coarse_levels_they_would(self) -> None:
        """The same bound notices a preconditioner of one level."""
        jacobi = ("-momentum_pc_type", "jacobi")
        small, large = (iterations_a_solve(cells, 1, jacobi) for cells in (8, 16))
        self.assertGreater(large, 1.5 * small)


class WhereTheTimeGoes(unittest.TestCase):
    def seconds(self, strategy: str, processes: int) -> tuple[float, dict[str, float]]:
        """From the first process's start to its end, by another clock; and what its summary says."""
        with tempfile.TemporaryDirectory() as folder:
            timed = [
                sys.executable,
                "-c",
                TIMER,
                str(DRIVER),
                "run",
                str(ROOT / "scenes" / "box.toml"),
                "--quiet",
            ]
            timed += ["--output", folder, "--set", "mesh.cells=[16,16,12]", "--set", "time.steps=96"]
            timed += ["--set", f'solver.strategy="{strategy}"']
            launcher = [] if processes == 1 else ["mpirun", "-n", str(processes)]
            done = subprocess.run([*launcher, *timed], capture_output=True, text=True, check=True)
            walls = [float(line.split()[1]) for line in done.stdout.splitlines() if line.startswith("wall")]
            self.assertEqual(len(walls), processes)
            return max(walls), json.loads((Path(folder) / "summary.json").read_text())["seconds"]

    def test_the_parts_are_the_wall_time(self) -> None:
        """Within 5 %: between them are a few assignments, behind them MPI's end, a tenth of a second, for which runs
        of several seconds have room. Another program may need the cores just then: one of three is enough."""
        for strategy, processes in (("condensed", 1), ("newton-krylov", 1), ("newton-krylov", 2)):
            shares: list[float] = []
            while len(shares) < 3 and (not shares or shares[-1] < 0.95):
                wall, seconds = self.seconds(strategy, processes)
                parts = sum(seconds[name] for name in PARTS)
                self.assertGreater(min(seconds[name] for name in PARTS), 0, seconds)
                self.assertLessEqual(parts, seconds["total"] + 1e-9)
                self.assertGreaterEqual(parts, 0.95 * seconds["total"], "one clock measures both")
                self.assertLessEqual(seconds["total"], wall + CLOCK_TICK)
                shares.append(parts / wall)
            self.assertGreaterEqual(shares[-1], 0.95, f"{strategy} on {processes}: {shares}")

    def test_the_log_names_stages_and_events(self) -> None:
        stages = ("mesh", "assembly", "steps", "output")
        events = ("TCContact", "TCProduct", "TCHierarchy", "TCLinearSolve")
        for strategy, processes, names in (
            ("condensed", 1, stages),
            ("newton-krylov", 1, stages + events),
            ("newton-krylov", 2, stages + events),
        ):
            settings = ("output.fields=[]", f'solver.strategy="{strategy}"')
            _, output = run("box", *settings, petsc=("-log_view",), processes=processes)
            self.assertRegex(output, rf"with {processes} processors?, by")
            for name in names:
                self.assertRegex(output, rf"(?m)^ *(\d+: +)?{name}\b", f"{strategy} on {processes}")


class Summary(unittest.TestCase):
    def test_auto_says_why(self) -> None:
        summary, output = run("box", "output.fields=[]")
        self.assertEqual(summary["solver"]["strategy"], "condensed")
        self.assertRegex(
            summary["solver"]["why"], r"foreseen: condensed .* GiB, .* s, newton-krylov .* GiB, .* s"
        )
        self.assertIn(summary["solver"]["why"], output)

    def test_auto_goes_over_to_newton_krylov(self) -> None:
        """26 cells a side: the forecast of condensing is above that of newton-krylov, on any machine."""
        summary, _ = run("box", "mesh.cells=[26,26,26]", "time.steps=1", "output.fields=[]")
        self.assertEqual(summary["solver"]["strategy"], "newton-krylov")
        self.assertIn("foreseen", summary["solver"]["why"])


if __name__ == "__main__":
    unittest.main()
