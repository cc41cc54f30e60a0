"""What `cmake --install` leaves: programs that run, and a library that another program is built with.

Run from tests/install/: python3 -m unittest test_install
"""

import csv
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("THERMOCONTACT_BUILD", ROOT / "build"))
SMALL = ["mesh.cells=[8,8]", "time.steps=8"]
COMPILERS = [f"-DCMAKE_CXX_COMPILER_LAUNCHER={os.environ.get('CMAKE_CXX_COMPILER_LAUNCHER', '')}"]


def run(*words: str | Path, **options: object) -> subprocess.CompletedProcess[str]:
    """A command, with what it prints."""
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, **options)  # type: ignore


class Installed(unittest.TestCase):
    """A tree of its own below a temporary folder, and the example built against it."""

    folder: tempfile.TemporaryDirectory[str]
    prefix: Path
    example: Path

    @classmethod
    def setUpClass(cls) -> None:
        """Installs, copies the example away from the sources, and builds it."""
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.prefix = Path(cls.folder.name) / "prefix"
        done = run("cmake", "--install", BUILD, "--prefix", cls.prefix)
        assert done.returncode == 0, done.stderr
        build = Path(cls.folder.name) / "example"
        source = cls.prefix / "share/doc/thermocontact/examples/step_by_step"
        done = run("cmake", "-S", source, "-B", build, f"-DCMAKE_PREFIX_PATH={cls.prefix}", *COMPILERS)
        assert done.returncode == 0, done.stdout + done.stderr
        done = run("cmake", "--build", build)
        assert done.returncode == 0, done.stdout + done.stderr
        cls.example = build / "step_by_step"

    def scene(self, name: str) -> Path:
        """An installed scene."""
        return self.prefix / f"share/thermocontact/scenes/{name}.toml"

    def test_the_tree(self) -> None:
        """Everything has its place."""
        for file in (
            "bin/thermocontact",
            "bin/thermocontact-petsc",
            "include/thermocontact/embed/scene_run.h",
            "include/thermocontact/error.h",
            "share/man/man1/thermocontact.1",
            "share/man/man5/thermocontact-scene.5",
            "share/bash-completion/completions/thermocontact",
            "share/zsh/site-functions/_thermocontact",
            "share/fish/vendor_completions.d/thermocontact.fish",
            "share/doc/thermocontact/index.md",
            "share/doc/thermocontact/audits.md",
            "share/thermocontact/scenes/meshes/brake-pad.msh",
        ):
            self.assertTrue((self.prefix / file).is_file(), file)

    def test_it_knows_nothing_of_where_it_was_built(self) -> None:
        """The package may be moved, and the sources removed."""
        for file in self.prefix.glob("lib/**/*.cmake"):
            self.assertNotIn(str(BUILD), file.read_text(), file)
            self.assertNotIn(str(ROOT), file.read_text(), file)

    def test_programs(self) -> None:
        """Both run: the second takes over for several processes."""
        settings = [word for setting in SMALL for word in ("--set", setting)]
        krylov = ["--set", 'solver.strategy="newton-krylov"']
        for name, words in (("alone", list[str]()), ("petsc", krylov)):
            results = Path(self.folder.name) / name
            command = [
                "run",
                str(self.scene("paper")),
                *settings,
                *words,
                "--quiet",
                "--output",
                str(results),
            ]
            done = run(self.prefix / "bin/thermocontact", *command)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertTrue((results / "summary.json").exists())

    def test_example_is_short(self) -> None:
        """Forty lines are enough."""
        lines = (ROOT / "examples/step_by_step/step_by_step.cpp").read_text().splitlines()
        self.assertLessEqual(len(lines), 40)

    def test_example_stops_where_the_history_says(self) -> None:
        """At the first step whose contact force is that large; the history has it with its own sign, in y."""
        settings = [word for setting in SMALL for word in ("--set", setting)]
        results = Path(self.folder.name) / "history"
        run(
            self.prefix / "bin/thermocontact",
            "run",
            self.scene("paper"),
            *settings,
            "--output",
            results,
            check=True,
        )
        with (results / "history.csv").open() as file:
            forces = [-float(row["contact_force_y"]) for row in csv.DictReader(file)]
        enough = sorted(forces)[len(forces) // 2]
        step = next(i for i, force in enumerate(forces, 1) if force >= enough * (1 - 1e-12))
        done = run(
            self.example, self.scene("paper"), "bottom", repr(enough * (1 - 1e-12)), *SMALL, check=True
        )
        *rows, last = done.stdout.splitlines()
        self.assertEqual(last, f"reached after step {step}")
        self.assertEqual(len(rows), step)
        for row, force in zip(rows, forces, strict=False):
            self.assertAlmostEqual(
                float(row.split("contact force ")[1].split(",")[0]), force, delta=1e-5 * abs(force)
            )

    def test_example_at_the_end(self) -> None:
        """A force that is never reached; a scene without heat."""
        done = run(self.example, self.scene("isothermal"), "bottom", "1e9", *SMALL, check=True)
        self.assertEqual(done.stdout.splitlines()[-1], "ended after step 8")
        self.assertNotIn(" K", done.stdout)

    def test_example_catches_what_the_library_throws(self) -> None:
        """A wrong key."""
        done = run(self.example, self.scene("paper"), "bottom", "1", "mesh.cels=[8,8]")
        self.assertEqual(done.returncode, 2)
        self.assertIn('did you mean "cells"', done.stderr)

    def test_versions(self) -> None:
        """One that is not installed is not found."""
        source = Path(self.folder.name) / "versions"
        source.mkdir()
        for version, found in {"0.1": True, "0.2": False, "1.0": False}.items():
            (source / "CMakeLists.txt").write_text(
                "cmake_minimum_required(VERSION 3.25)\nproject(versions LANGUAGES CXX)\n"
                f"find_package(thermocontact {version} REQUIRED)\n"
            )
            done = run("cmake", "-S", source, "-B", source / version, f"-DCMAKE_PREFIX_PATH={self.prefix}")
            self.assertEqual(done.returncode == 0, found, done.stderr)
