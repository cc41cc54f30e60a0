"""Strategy newton-krylov at size, and what the summary says of time and memory. THERMOCONTACT_DRIVER: the program."""

import json
import re
import subprocess
import tempfile
import unittest
from pathlib import Path
from typing import Any

from under_test import DRIVER, ROOT

ITERATIONS = re.compile(r"(momentum|heat)_ solve converged due to \S+ iterations (\d+)")


def run(scene: str, *settings: str, petsc: tuple[str, ...] = ()) -> tuple[dict[str, Any], str]:
    with tempfile.TemporaryDirectory() as folder:
        command = [str(DRIVER), "run", str(ROOT / "scenes" / f"{scene}.toml"), "--output", folder]
        for setting in settings:
            command += ["--set", setting]
        if petsc:
            command += ["--", *petsc]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        return json.loads((Path(folder) / "summary.json").read_text()), done.stdout + done.stderr


def iterations_a_solve(cells: int) -> float:
    """Of the momentum balance of a body in frictional contact."""
    _, output = run(
        "box",
        f"mesh.cells=[{cells},{cells},{cells}]",
        "time.steps=2",
        "output.fields=[]",
        'solver.strategy="newton-krylov"',
        petsc=("-momentum_ksp_converged_reason",),
    )
    counts = [int(count) for _, count in ITERATIONS.findall(output)]
    return sum(counts) / len(counts)


class Multigrid(unittest.TestCase):
    def test_iterations_hardly_grow_with_the_body(self) -> None:
        """Eight times the cells: an optimal method needs no more iterations, one level about twice as many."""
        small, large = iterations_a_solve(8), iterations_a_solve(16)
        self.assertLess(large, 1.5 * small)

    def test_without_coarse_levels_they_would(self) -> None:
        """The same bound notices a preconditioner of one level."""
        counts = {}
        for cells in (8, 16):
            _, output = run(
                "box",
                f"mesh.cells=[{cells},{cells},{cells}]",
                "time.steps=1",
                "output.fields=[]",
                'solver.strategy="newton-krylov"',
                petsc=("-momentum_ksp_converged_reason", "-momentum_pc_type", "jacobi"),
            )
            found = [int(count) for _, count in ITERATIONS.findall(output)]
            counts[cells] = sum(found) / len(found)
        self.assertGreater(counts[16], 1.5 * counts[8])


class Summary(unittest.TestCase):
    def check_sum(self, seconds: dict[str, Any]) -> None:
        """Nothing but the header and a few assignments lies between the parts, which are measured by one clock."""
        parts = sum(seconds[name] for name in ("start", "setup", "factor", "steps", "output"))
        self.assertLessEqual(parts, seconds["total"] + 1e-9)
        self.assertGreaterEqual(parts, 0.95 * seconds["total"])

    def test_seconds_add_up(self) -> None:
        for strategy in ("condensed", "newton-krylov"):
            summary, _ = run("box", "mesh.cells=[8,8,8]", f'solver.strategy="{strategy}"')
            self.check_sum(summary["seconds"])
            self.assertGreater(summary["seconds"]["start"], 0)

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

    def test_the_log_names_stages_and_events(self) -> None:
        _, output = run("box", "output.fields=[]", 'solver.strategy="newton-krylov"', petsc=("-log_view",))
        for name in (
            "mesh",
            "assembly",
            "steps",
            "output",
            "TCContact",
            "TCProduct",
            "TCHierarchy",
            "TCLinearSolve",
        ):
            self.assertIn(name, output)


if __name__ == "__main__":
    unittest.main()
