"""What tests of the whole program share: it is run in an empty folder, and its exit code must be the one expected."""

import argparse
import json
import subprocess
import sys
import tempfile
import unittest
from collections.abc import Callable
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SCENE = ROOT / "scenes" / "paper-isotropic.toml"
SMALL = ("--quiet", "--set", "mesh.cells=[4,4]", "--set", "time.steps=4")
COMPLETED, SYSTEM_FAILED, BAD_INPUT, NUMERICS_FAILED, TERMINATED = 0, 1, 2, 3, 143


class ProgramTest(unittest.TestCase):
    """Runs the program in an empty folder of its own."""

    driver = ROOT / "build" / "thermocontact"

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.results = self.folder / "results"

    def call(
        self, code: int, *words: str | Path, before: Callable[[], None] | None = None
    ) -> "subprocess.CompletedProcess[str]":
        """Run the program in the empty folder; its exit code must be that."""
        command = [str(word) for word in (self.driver, *words)]
        done = subprocess.run(
            command, capture_output=True, text=True, cwd=self.folder, preexec_fn=before, check=False
        )
        self.assertEqual(done.returncode, code, f"{' '.join(command)}\n{done.stdout}{done.stderr}")
        return done

    def run_small(self, code: int, *words: str, before: Callable[[], None] | None = None) -> str:
        """The message of a small run of the scene into self.results."""
        command: list[str | Path] = ["run", SCENE, *SMALL, "--output", self.results, *words]
        return self.call(code, *command, before=before).stderr

    def summary(self) -> dict[str, object]:
        found: dict[str, object] = json.loads((self.results / "summary.json").read_text(encoding="utf-8"))
        return found

    def assert_says(self, message: str, *words: str) -> None:
        """One line that begins with the program's name and holds these words."""
        self.assertRegex(message, r"\Athermocontact: [^\n]+\n\Z")
        for word in words:
            self.assertIn(word, message)


def main(prose: str | None) -> int:
    """The program's tests with --driver; 0 if all pass."""
    parser = argparse.ArgumentParser(description=prose, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--driver", type=Path, default=ProgramTest.driver)
    options, rest = parser.parse_known_args()
    ProgramTest.driver = options.driver.resolve()
    result = unittest.main(argv=[sys.argv[0], *rest], exit=False).result
    return 0 if result.wasSuccessful() else 1
