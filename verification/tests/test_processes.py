"""Several processes: an error that meets one of them ends all, with one message and the program's exit code.

Run from verification/: python3 -m unittest tests.test_processes (THERMOCONTACT_DRIVER names the driver). The faults are
real ones: files that cannot be written, expressions that are infinite in one place, memory that one process does not
get.
"""

import contextlib
import csv
import json
import shutil
import subprocess
import tempfile
import unittest
from collections.abc import Sequence
from pathlib import Path

import compare
import under_test

DRIVER = str(under_test.DRIVER)
SCENE = str(under_test.ROOT / "scenes" / "isothermal.toml")
SMALL = ["--set", "mesh.cells=[6,6]", "--set", "time.steps=3"]
SLIDING = """mesh.cells = [6, 6]
time = {end = 1.0, steps = 1}
material.elasticity = {young = 2.0, poisson = 0.1}
load.body_force = [0.1, -1.0]
boundary.bottom.contact.compliance.stiffness = 10
"""
TIMEOUT = under_test.patience(120.0)  # seconds; a run takes two, a hang for ever


def mpirun(*programs: Sequence[str]) -> "subprocess.CompletedProcess[str]":
    """One process for each command line."""
    words = ["mpirun"]
    for number, program in enumerate(programs):
        words += [":"] * (number > 0) + ["-n", "1", *program]
    return subprocess.run(words, capture_output=True, text=True, timeout=TIMEOUT)


class Processes(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.results = self.folder / "results"

    def program(self, *settings: str) -> list[str]:
        words = [word for setting in settings for word in ("--set", setting)]
        return [DRIVER, "run", SCENE, "--quiet", "--output", str(self.results), *SMALL, *words]

    def run_all(self, count: int, *settings: str) -> "subprocess.CompletedProcess[str]":
        return mpirun(*[self.program(*settings)] * count)

    def expect(self, result: "subprocess.CompletedProcess[str]", code: int, *parts: str) -> None:
        """That exit code, and one message of the program, with these parts."""
        messages = [line for line in result.stderr.splitlines() if line.startswith("thermocontact: ")]
        self.assertEqual(len(messages), 1, result.stderr)
        for part in parts:
            self.assertIn(part, messages[0])
        self.assertEqual(result.returncode, code, result.stderr)

    def steps_in_history(self) -> list[int]:
        with (self.results / "history.csv").open(newline="") as file:
            return [int(float(row["step"])) for row in csv.DictReader(file)]

    def summary(self) -> dict[str, object]:
        result: dict[str, object] = json.loads((self.results / "summary.json").read_text())
        return result

    def test_success(self) -> None:
        result = self.run_all(3)
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))
        self.assertEqual(self.steps_in_history(), [1, 2, 3])
        self.assertEqual(self.summary()["status"], "completed")
        pieces = sorted(path.name for path in (self.results / "fields").glob("body_000003*"))
        self.assertEqual(pieces, ["body_000003.pvtu", *(f"body_000003_p{rank}.vtu" for rank in range(3))])

    def test_history_and_summary_have_the_shape_of_one_process(self) -> None:
        self.assertEqual(self.run_all(2).returncode, 0)
        several, header = self.summary(), (self.results / "history.csv").read_text().splitlines()[0]
        self.assertEqual(subprocess.run(self.program()).returncode, 0)
        self.assertEqual((self.results / "history.csv").read_text().splitlines()[0], header)
        alone = self.summary()
        self.assertEqual(list(alone), list(several))
        for table in ("mesh", "physics", "steps"):
            self.assertEqual(alone[table], several[table], table)
        self.assertFalse(list((self.results / "fields").glob("*_p*.vtu")), "pieces of the run before")

    def test_unknowns_of_contact_are_those_of_the_whole_body(self) -> None:
        """Two at each of the 7 nodes below, also where several processes have a node, or one process none."""
        program = self.program('solver.strategy="newton-krylov"')
        for count in (1, 2, 3):
            with self.subTest(count):
                self.assertEqual(mpirun(*[program] * count).returncode, 0)
                solver = self.summary()["solver"]
                assert isinstance(solver, dict)
                self.assertEqual(solver["processes"], count)
                self.assertEqual(solver["contact_unknowns"], 14)

    def test_what_is_free_to_move_is_told_alike(self) -> None:
        """Without inertia, on frictionless contact: one message, the same as of one process."""
        scene = self.folder / "sliding.toml"
        scene.write_text(SLIDING, encoding="utf-8")
        program = [DRIVER, "run", str(scene), "--quiet", "--output", str(self.results)]
        alone = subprocess.run(program, capture_output=True, text=True)
        self.assertEqual(alone.returncode, 3, alone.stderr)
        self.assertIn("the body is free to move along x, for", alone.stderr)
        for count in (2, 3):
            with self.subTest(count):
                self.expect(mpirun(*[program] * count), 3, alone.stderr.strip())

    def test_more_processes_than_cells(self) -> None:
        reference = self.folder / "alone"
        sets = ["mesh.cells=[1,1]"]
        alone = [str(reference) if word == str(self.results) else word for word in self.program(*sets)]
        self.assertEqual(subprocess.run(alone).returncode, 0)
        self.assertEqual(self.run_all(4, *sets).returncode, 0)
        with contextlib.redirect_stdout(None):
            self.assertEqual(compare.main([str(reference), str(self.results)]), 0)

    def test_a_piece_that_cannot_be_written(self) -> None:
        for rank in (0, 1, 2):
            with self.subTest(rank):
                self.results = self.folder / f"results-{rank}"
                piece = self.results / f"fields/body_000002_p{rank}.vtu"
                (piece / "a folder in its place").mkdir(parents=True)
                self.expect(self.run_all(3), 1, f"cannot write {piece}: ")
                self.assertEqual(self.steps_in_history(), [1, 2])

    def test_a_file_that_cannot_be_opened(self) -> None:
        for name in ("fields/contact_000001_p1.vtu", "fields/body_000000.pvtu", "summary.json"):
            with self.subTest(name):
                in_place = self.results / f"{name}.part"
                (in_place / "a folder").mkdir(parents=True)
                self.expect(self.run_all(2), 1, f"cannot write {self.results}/{name}: Is a directory")
                shutil.rmtree(in_place)

    def test_a_results_folder_that_cannot_be_made(self) -> None:
        self.results.write_text("a file")
        self.expect(self.run_all(2), 1, "cannot make the output folder")

    def test_numbers_that_are_infinite_on_one_process(self) -> None:
        pole = "1/max(0, x + y - 0.1)"  # infinite at one corner from some time on
        for key, before in (
            ("load.body_force", 1),
            ("boundary.bottom.contact.gap", 1),
            ("initial.velocity", 0),
        ):
            with self.subTest(key):
                late = f"t < 0.5 ? 0 : {pole}" if before else pole
                value = f'"{late}"' if key.endswith("gap") else f'["{late}", 0.0]'
                self.expect(self.run_all(3, f"{key}={value}"), 3, "is inf at x = (0, 0, 0)")
                self.assertEqual(self.summary()["status"], "failed")
                if before:
                    self.assertEqual(self.steps_in_history(), [1])

    def test_a_scene_that_only_one_process_cannot_read(self) -> None:
        result = mpirun(self.program(), self.program("mesh.cells=[0,6]"))
        self.expect(result, 2, "mesh.cells")

    def test_a_wrong_scene_is_told_once(self) -> None:
        self.expect(self.run_all(3, "mesh.cells=[0,6]"), 2, "mesh.cells")
        self.assertFalse(self.results.exists())

    @unittest.skipIf(under_test.reserves_addresses(), "built to end, not to throw, where memory ends")
    def test_memory_that_one_process_does_not_get(self) -> None:
        large = self.program("mesh.cells=[300,300]")
        limited = ["sh", "-c", 'ulimit -v 600000; exec "$@"', "sh", *large]  # KiB: a small mesh needs 550000
        self.expect(mpirun(large, limited), 1, "out of memory")

    def test_what_is_printed_is_printed_once(self) -> None:
        for words in (["--version"], ["check", SCENE], ["schema", "--format", "json"]):
            alone = subprocess.run([DRIVER, *words], capture_output=True, text=True)
            self.assertEqual(mpirun([DRIVER, *words], [DRIVER, *words]).stdout, alone.stdout)


if __name__ == "__main__":
    unittest.main()
