"""What tests of law files need: a folder, a cache of compiled laws, and a Python that counts how often it is started."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import compare
from under_test import DRIVER

ROOT = Path(__file__).resolve().parents[2]
SCENES = ROOT / "scenes"


class WithLawFiles(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.started = self.folder / "started"
        self.started.touch()
        python = self.folder / "python"
        python.write_text(f'#!/bin/sh\necho "$3" >> {self.started}\nexec {sys.executable} "$@"\n')
        python.chmod(0o755)
        self.environment = {
            **os.environ,
            "XDG_CACHE_HOME": str(self.folder / "cache"),
            "THERMOCONTACT_PYTHON": str(python),
            "OMP_NUM_THREADS": "1",
        }

    def start(self, *words: object, processes: int = 1) -> "subprocess.Popen[str]":
        command = [str(DRIVER), *map(str, words)]
        if processes > 1:
            command = ["mpirun", "-n", str(processes), *command]
        return subprocess.Popen(
            command,
            cwd=self.folder,
            env=self.environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )

    def call(self, *words: object, processes: int = 1) -> tuple[int, str, str]:
        program = self.start(*words, processes=processes)
        output, errors = program.communicate()
        return program.returncode, output, errors

    def run_scene(self, scene: Path, results: str, *words: object, processes: int = 1) -> Path:
        found = self.call(
            "run", scene, "--quiet", "--output", self.folder / results, *words, processes=processes
        )
        self.assertEqual(found[0], 0, found[2])
        return self.folder / results

    def assert_same(self, a: Path, b: Path) -> None:
        """To a few last bits: sums depend on where numbers lie in memory."""
        self.assertEqual(compare.main([str(a), str(b), "--tolerance", "1e-14"]), 0)

    def starts(self) -> int:
        return len(self.started.read_text().splitlines())

    def refused(self, scene: Path, *expected: str, code: int = 2) -> None:
        found, _, errors = self.call("run", scene, "--output", self.folder / "none")
        self.assertEqual(found, code, errors)
        for words in expected:
            self.assertIn(words, errors)
        self.assertFalse((self.folder / "none").exists(), "something was written")
        cache = self.folder / "cache" / "thermocontact"
        left = [path.name for path in cache.glob("making-*")] if cache.exists() else []
        self.assertEqual(left, [], "half of something is left in the cache")

    def assert_close(self, a: Path, b: Path, tolerance: str) -> None:
        self.assertEqual(compare.main([str(a), str(b), "--tolerance", tolerance]), 0)

    def oracle(self, scene: Path, results: str, *words: str) -> Path:
        command = [sys.executable, str(ROOT / "verification" / "oracle.py"), str(scene), "--quiet"]
        found = self.folder / results
        subprocess.run([*command, "--output", str(found), *words], check=True, capture_output=True)
        return found
