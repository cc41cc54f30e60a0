"""Exit codes of the program and what it leaves behind, as the interface promises them.

    python3 verification/exit_codes.py [--driver PROGRAM]

| exit | meaning | what must be seen |
| --- | --- | --- |
| 0 | completed | results; a summary that says so |
| 1 | the system failed | one line on stderr; the results of an earlier run are as they were |
| 2 | scene or command line wrong | the file, key or word at fault; nothing written |
| 3 | the numerics failed | step and equation; every completed step on disk, no number that is not finite |

How signals end a run is asked elsewhere (kill_and_restart.py). Exits 0 if all is as promised, 1 if not.
"""

import argparse
import json
import resource
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from exit_code_parts.program_test import (
    BAD_INPUT,
    COMPLETED,
    NUMERICS_FAILED,
    SCENE,
    SMALL,
    SYSTEM_FAILED,
    TERMINATED,
    ProgramTest,
    main,
)
from oracle_parts import vtu

WAITING = 120.0  # s: a run that has not begun or ended by then hangs

NONLINEAR = ("--set", "boundary.bottom.contact.compliance.exponent=2")

# A load that is not finite from the third of four steps on, and a body that nothing holds
BREAKS = ("--set", 'load.body_force=["0", "t < 0.6 ? -1 : 1/(t - t)"]')
LOOSE = """mesh.cells = [2, 2]
time = {end = 1.0, steps = 2}
material.elasticity = {young = 2.0, poisson = 0.1}
load.body_force = [0.0, -1.0]
"""
IN_SPACE = LOOSE.replace("[2, 2]", "[2, 2, 2]\nmesh.shape = 'box'").replace("[0.0, -1.0]", "[0.0, -1.0, 0.0]")
# A body that its load begins to turn in the third of four steps: so stiff that rounding the displacement is worth forces
TURNED = """mesh.cells = [2, 2]
time = {end = 0.01, steps = 4}
material = {density = 1.0, elasticity = {young = 1e15, poisson = 0.3}}
load.body_force = ["t < 0.006 ? 0 : -1e3*(y - 0.5)", "t < 0.006 ? 0 : 1e3*(x - 0.5)"]
output.checkpoint_every = 1
"""
# Coulomb's law itself: no friction at no slip, which is what a body that sticks has as well
ABOVE_A_TABLE = """boundary.bottom.contact.gap = 1.0
boundary.bottom.contact.compliance.stiffness = 10
boundary.bottom.contact.friction = {coefficient = 0.5, regularisation = 0}
"""
ON_A_TABLE = "boundary.bottom.contact.compliance.stiffness = 10\n"
OPENING = (
    ON_A_TABLE
    + """boundary.left.displacement = [0.0, "free"]
boundary.bottom.contact.gap = "t < 0.6 ? 0 : 1"
"""
)
HEATED = """mesh.cells = [2, 2]
time = {end = 1.0, steps = 2}
heat = {conductivity = 1.0, source = 1.0}
"""


def small_files() -> None:
    """Write errors as on a full disk: no file of the child grows beyond 2 KiB."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (2048, 2048))


class ExitCodes(ProgramTest):
    def test_completed(self) -> None:
        self.assertEqual(self.run_small(COMPLETED), "", "--quiet prints errors only")
        self.assertEqual(self.summary()["status"], "completed")
        self.assertEqual(self.summary()["steps"], 4)
        self.call(COMPLETED, "check", SCENE, "--set", "mesh.cells=[4,4]")
        for words in (("schema",), ("--version",), ("--help",)):
            self.assertNotEqual(self.call(COMPLETED, *words).stdout, "")

    def test_planned(self) -> None:
        stdout = self.call(
            COMPLETED,
            "run",
            SCENE,
            "--output",
            self.results,
            "--accuracy",
            "0.3",
            "--set",
            "output.fields=[]",
        ).stdout
        for word in ("asked ", "chosen ", "achieved ", "time "):
            self.assertIn("\n" + word, "\n" + stdout)
        plan = self.summary()["plan"]
        assert isinstance(plan, dict)
        self.assertLessEqual(plan["predicted"]["error"], 0.3)
        self.assertGreater(plan["achieved"]["error"], 0.0)
        self.assertEqual(self.summary()["steps"], plan["predicted"]["steps"])
        self.assertIn(f"time.steps={plan['predicted']['steps']}", plan["settings"])

    def test_plan_that_cannot_be_met(self) -> None:
        """The literal data converge too slowly for that; nothing is written."""
        asked = ("--accuracy", "1e-6", "--output", self.results)
        message = self.call(NUMERICS_FAILED, "run", SCENE, *asked, "--budget", "2s").stderr
        self.assert_says(message, "cannot be promised", "nothing was run")
        self.assertFalse(self.results.exists())
        for words in (("--accuracy", "0"), ("--budget", "-3s"), ("--of", "norms")):
            self.assert_says(self.call(BAD_INPUT, "plan", SCENE, *words).stderr, words[0])

    def test_where_results_go(self) -> None:
        self.call(COMPLETED, "run", SCENE, *SMALL)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["paper-isotropic-results"])

    def test_wrong_scene(self) -> None:
        text = SCENE.read_text(encoding="utf-8").replace("friction", "fricton")
        wrong = self.folder / "wrong.toml"
        wrong.write_text(text, encoding="utf-8")
        line = next(number for number, row in enumerate(text.splitlines(), 1) if "fricton" in row)
        commands: list[list[str | Path]] = [["run", wrong, "--output", self.results], ["check", wrong]]
        for command in commands:
            message = self.call(BAD_INPUT, *command).stderr
            self.assert_says(message, f"wrong.toml:{line}: ", "fricton", 'did you mean "friction"?')
        self.assertFalse(self.results.exists())

    def test_wrong_value(self) -> None:
        self.assert_says(self.run_small(BAD_INPUT, "--set", "material.density=0"), "material.density", "> 0")
        self.assertFalse(self.results.exists())

    def test_no_scene(self) -> None:
        message = self.call(BAD_INPUT, "run", "absent.toml", "--output", self.results).stderr
        self.assert_says(message, "absent.toml")
        self.assertFalse(self.results.exists())

    def test_wrong_command_line(self) -> None:
        for words, told in (
            ((), "run"),
            (("rum", str(SCENE)), 'did you mean "run"?'),
            (("run",), "no scene file"),
            (("run", str(SCENE), "--outptu", "x"), 'did you mean "--output"?'),
            (("run", str(SCENE), "--set", "mesh.cells"), "KEY=VALUE"),
            (("schema", "--format", "xml"), "markdown"),
        ):
            with self.subTest(words=words):
                self.assert_says(self.call(BAD_INPUT, *words).stderr, told)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_folder_that_cannot_be_made(self) -> None:
        self.results.write_text("a file", encoding="utf-8")
        command = ("run", SCENE, *SMALL, "--output", self.results / "below")
        self.assert_says(self.call(SYSTEM_FAILED, *command).stderr, "output folder", "below")
        self.assertEqual(self.results.read_text(encoding="utf-8"), "a file")

    def test_folder_is_met_before_the_work(self) -> None:
        """A system that cannot be factored (exit 3) is not found where the folder cannot be made (exit 1)."""
        (self.folder / "loose.toml").write_text(LOOSE, encoding="utf-8")
        self.results.write_text("a file", encoding="utf-8")
        command = ("run", "loose.toml", "--quiet", "--output", self.results)
        self.assert_says(self.call(SYSTEM_FAILED, *command).stderr, "output folder")

    def test_full_disk(self) -> None:
        message = self.run_small(SYSTEM_FAILED, before=small_files)
        self.assert_says(message, "cannot write", str(self.results))
        self.assertFalse((self.results / "summary.json").exists(), "says that a run completed")
        self.assertEqual(list(self.results.rglob("*.part")), [])

    def start_long(self) -> "subprocess.Popen[str]":
        """A run into self.results that has begun and would take minutes."""
        command = [
            self.driver,
            "run",
            SCENE,
            "--quiet",
            "--output",
            self.results,
            "--set",
            "time.steps=1000000",
            "--set",
            "output.checkpoint_every=1000000",
            "--set",
            "output.fields=[]",
        ]
        run = subprocess.Popen([str(word) for word in command], stderr=subprocess.PIPE, text=True)
        self.addCleanup(run.kill)
        deadline = time.monotonic() + WAITING
        while not (self.results / "history.csv").exists() and time.monotonic() < deadline:
            self.assertIsNone(run.poll())
            time.sleep(0.01)
        return run

    def test_two_runs_into_one_folder(self) -> None:
        """The second is refused at once; the first ends as if it had been alone."""
        first = self.start_long()
        message = self.run_small(SYSTEM_FAILED)
        self.assert_says(message, "another run", str(self.results), "--output")
        first.send_signal(signal.SIGTERM)
        first.communicate(timeout=WAITING)
        self.assertEqual(first.returncode, TERMINATED)
        self.assertEqual(self.summary()["status"], "interrupted")
        self.run_small(COMPLETED)

    def test_folder_removed_during_the_run(self) -> None:
        run = self.start_long()
        self.results.rename(self.folder / "elsewhere")
        _, message = run.communicate(timeout=WAITING)
        self.assertEqual(run.returncode, SYSTEM_FAILED, message)
        self.assert_says(message, "removed", str(self.results))
        self.assertFalse(self.results.exists())

    def test_files_of_others_stay(self) -> None:
        self.results.mkdir()
        (self.results / "notes.txt").write_text("mine", encoding="utf-8")
        self.run_small(COMPLETED)
        self.run_small(COMPLETED)
        self.assertEqual((self.results / "notes.txt").read_text(encoding="utf-8"), "mine")

    def test_numerics_failed_in_a_step(self) -> None:
        message = self.run_small(NUMERICS_FAILED, *BREAKS)
        self.assert_says(message, "step 3", "t = 0.75", "finite")
        summary = self.summary()
        self.assertEqual((summary["status"], summary["steps"]), ("failed", 2))
        self.assertIn("step 3", str(summary["reason"]))
        times = {entry.time for entry in vtu.read_collection(self.results / "fields.pvd")}
        self.assertEqual(times, {0.0, 0.25, 0.5})
        for file in self.results.glob("fields/*.vtu"):
            grid = vtu.read_grid(file)
            for values in (*grid.point_data.values(), *grid.cell_data.values()):
                self.assertTrue(np.isfinite(values).all(), file)
        history: Any = np.genfromtxt(self.results / "history.csv", delimiter=",", names=True)
        self.assertEqual(list(history["step"]), [1, 2])
        self.assertTrue(all(np.isfinite(history[name]).all() for name in history.dtype.names or ()))

    def test_newton_failed(self) -> None:
        message = self.run_small(NUMERICS_FAILED, *NONLINEAR, "--set", "solver.max_iterations=1")
        self.assert_says(
            message, "step 1", "momentum balance", "Newton", "time.steps", "solver.max_iterations"
        )
        self.assertEqual((self.summary()["status"], self.summary()["steps"]), ("failed", 0))

    def test_unkept_balance(self) -> None:
        """Without contact nothing but the balance tells; the checkpoint has the step before, and goes on where less is asked."""
        (self.folder / "turned.toml").write_text(TURNED, encoding="utf-8")
        for strategy in ("condensed", "newton-krylov"):
            with self.subTest(strategy=strategy):
                words = ("--quiet", "--output", self.results, "--set", f"solver.strategy='{strategy}'")
                message = self.call(NUMERICS_FAILED, "run", "turned.toml", *words).stderr
                self.assert_says(
                    message, "step 3, t = 0.0075: momentum balance: ", "keeps the balance of", "digits", "try"
                )
                summary: dict[str, Any] = self.summary()
                self.assertEqual((summary["status"], summary["steps"]), ("failed", 2))
                self.assertLessEqual(max(summary["audit"].values()), 1e-8)
                looser = ("--set", "solver.tolerance=1e-6", "--restart", self.results / "checkpoint.h5")
                self.call(COMPLETED, "run", "turned.toml", *words, *looser)
                self.assertEqual((self.summary()["status"], self.summary()["steps"]), ("completed", 4))

    def test_goes_on_after_numerics_failed(self) -> None:
        """A run that failed goes on from its checkpoint, with settings that let it, like one that never failed."""
        self.run_small(COMPLETED, *NONLINEAR)
        unbroken = self.summary()["final"]
        self.run_small(NUMERICS_FAILED, *NONLINEAR, "--set", "solver.max_iterations=1")
        message = self.run_small(COMPLETED, *NONLINEAR, "--restart", str(self.results / "checkpoint.h5"))
        self.assertEqual(message, "")
        self.assertEqual((self.summary()["status"], self.summary()["steps"]), ("completed", 4))
        self.assertEqual(self.summary()["final"], unbroken)

    def test_restart_of_a_folder(self) -> None:
        """The results' folder for the checkpoint in it is refused, by name, and stays as it was."""
        self.run_small(COMPLETED)
        before = {path: path.stat().st_mtime_ns for path in self.results.rglob("*")}
        message = self.run_small(BAD_INPUT, "--restart", str(self.results))
        file = self.results / "checkpoint.h5"
        self.assert_says(message, f"--restart {self.results}: expected a checkpoint", f"did you mean {file}?")
        self.assertEqual({path: path.stat().st_mtime_ns for path in self.results.rglob("*")}, before)
        message = self.run_small(BAD_INPUT, "--restart", str(self.folder))
        self.assert_says(message, "without a checkpoint.h5")

    def test_singular_system(self) -> None:
        """It also takes away what an earlier run left, which would stand beside the word `failed`."""
        (self.folder / "loose.toml").write_text(LOOSE, encoding="utf-8")
        self.run_small(COMPLETED)
        command = ("run", "loose.toml", "--quiet", "--output", self.results)
        self.assert_says(self.call(NUMERICS_FAILED, *command).stderr, "momentum balance", "singular")
        self.assertEqual((self.summary()["status"], self.summary()["steps"]), ("failed", 0))
        self.assertFalse((self.results / "history.csv").exists())
        self.assertEqual(list(self.results.glob("fields/*.vtu")), [])

    def test_what_is_free_to_move(self) -> None:
        """By name, with the reason and what to change, before the first step where no contact can hold it."""
        nothing, closed = "there is no contact", "contact does not resist it as it is closed"
        along_x = (
            "the body is free to move along x, for there is no inertia, no displacement is prescribed that"
        )
        for scene, told in (
            (LOOSE, ("to move along x, to move along y and to turn about (0.5, 0.5)", nothing)),
            (IN_SPACE, ("to turn about the axis along y through (0.5, 0.5, 0.5)", nothing)),
            (LOOSE + ON_A_TABLE, (along_x, closed, "friction")),
            (IN_SPACE + ON_A_TABLE, ("to move along x, to move along z and to turn about the axis along y",)),
            (LOOSE + "boundary.top.displacement = ['free', 0.0]\n", (along_x, nothing)),
            (HEATED, ("the temperature of the body is free to change alike everywhere", "heat.capacity")),
        ):
            for strategy in ("condensed", "newton-krylov"):
                with self.subTest(scene=scene, strategy=strategy):
                    (self.folder / "loose.toml").write_text(scene, encoding="utf-8")
                    words = ("--quiet", "--output", self.results, "--set", f"solver.strategy='{strategy}'")
                    message = self.call(NUMERICS_FAILED, "run", "loose.toml", *words).stderr
                    self.assert_says(message, "balance: the system is singular: ", *told, "prescribe it")
                    self.assertEqual((self.summary()["status"], self.summary()["steps"]), ("failed", 0))

    def test_contact_that_opens_leaves_a_body_free(self) -> None:
        for strategy in ("condensed", "newton-krylov"):
            with self.subTest(strategy=strategy):
                (self.folder / "opening.toml").write_text(LOOSE + OPENING, encoding="utf-8")
                words = ("--quiet", "--output", self.results, "--set", f"solver.strategy='{strategy}'")
                message = self.call(NUMERICS_FAILED, "run", "opening.toml", *words).stderr
                self.assert_says(
                    message, "step 2, t = 1: momentum balance: ", "free to move along y,", "contact is open"
                )
                self.assertEqual((self.summary()["status"], self.summary()["steps"]), ("failed", 1))

    def test_open_contact_holds_nothing(self) -> None:
        scene = LOOSE.replace("[0.0, -1.0]", "[0.0, 1.0]") + ABOVE_A_TABLE
        (self.folder / "open.toml").write_text(scene, encoding="utf-8")
        for strategy in ("condensed", "newton-krylov"):
            with self.subTest(strategy=strategy):
                words = ("--quiet", "--output", self.results, "--set", f"solver.strategy='{strategy}'")
                message = self.call(NUMERICS_FAILED, "run", "open.toml", *words).stderr
                free = "the body is free to move along x, to move along y and to turn about (0.5, 0.5)"
                self.assert_says(message, "the system is singular: ", free, "contact is open")

    def test_fewer_steps_leave_no_older_fields(self) -> None:
        self.run_small(COMPLETED)
        self.run_small(COMPLETED, "--set", "time.steps=2")
        steps = {file.stem.split("_")[-1] for file in self.results.glob("fields/*.vtu")}
        self.assertEqual(steps, {"000000", "000001", "000002"})


if __name__ == "__main__":
    sys.exit(main(__doc__))
