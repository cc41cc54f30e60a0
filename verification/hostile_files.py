"""Hostile files: scenes that are none, and results folders that cannot be written to.

    python3 verification/hostile_files.py [--driver PROGRAM]

Each must end with a clear error of one line and the exit code of the interface, take less than 1 GiB of memory and a
minute, and leave the results of an earlier run as they are, byte for byte. Tests that need a file system of their own
or another user than root are made where the system lets them, and otherwise skipped. How fuzzing does it: tests/fuzz.

Exits 0 if all is so, 1 if not.
"""

import hashlib
import os
import re
import resource
import shutil
import subprocess
import sys
import unittest
from collections.abc import Callable
from pathlib import Path

from exit_code_parts.program_test import BAD_INPUT, COMPLETED, SCENE, SYSTEM_FAILED, ProgramTest, main
from under_test import reserves_addresses

MEMORY = 1 << 20  # KiB, as getrusage counts
SECONDS = 60  # of processor time
DEEP = 200_000
NOBODY = 65534
LONGEST = 10_000  # characters of an expression that is read

NO_SCENES: dict[str, tuple[Callable[[bytes], bytes], str]] = {
    "10 MB of comments": (
        lambda scene: scene + b"# a line of forty characters and no more\n" * 250_000,
        "4 MiB",
    ),
    "10 MB in one string": (
        lambda scene: scene.replace(b'title = "', b'title = "' + b"y" * 10_000_000, 1),
        "4 MiB",
    ),
    "deep arrays": (lambda _: b"a = " + b"[" * DEEP + b"]" * DEEP + b"\n", ":1: "),
    "deep tables": (lambda _: b"a = " + b"{b=" * DEEP + b"1" + b"}" * DEEP + b"\n", ":1: "),
    "deep keys": (lambda _: b".".join([b"a"] * DEEP) + b" = 1\n", ":1: "),
    "NUL in a key": (lambda scene: scene.replace(b"young", b"yo\0ung", 1), "not valid TOML"),
    "NUL in a string": (lambda scene: scene.replace(b'title = "', b'title = "\0', 1), "not valid TOML"),
    "Latin-1": (lambda scene: scene.replace(b'title = "', b'title = "\xe9', 1), "utf-8"),
    "UTF-16": (lambda scene: scene.decode().encode("utf-16"), "not valid TOML"),
    "empty": (lambda _: b"", "mesh"),
}

# as deep as the longest expression allows, and what is to be said of it; None: it is a good one
EXPRESSIONS: tuple[tuple[str, str | None], ...] = (
    ("(" * 4999 + "x" + ")" * 4999, None),
    ("(" * 4999 + "x", 'closing ")"'),
    ("sin(" * 1999 + "x" + ")" * 1999, None),
    ("-" * (LONGEST - 1) + "x", 'unexpected "-"'),
    ("x^" * 4999 + "x", None),
    ("x>0?" * 1600 + "x" + ":x" * 1600, None),
    ("x+" * 4999 + "x", None),
    ("f(f(x))", 'unknown name "f"'),
    ("load.body_force", 'unknown name "load"'),
    ("x" * (LONGEST + 1), "longer than"),
)


def below(folder: Path) -> dict[str, str]:
    """Digests of all files below the folder."""
    return {
        str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


def as_nobody() -> None:
    """Give up root in the child, whom no permission binds."""
    if os.geteuid() == 0:
        os.setgroups([])
        os.setgid(NOBODY)
        os.setuid(NOBODY)


class HostileFiles(ProgramTest):
    def setUp(self) -> None:
        super().setUp()
        self.addCleanup(self.check_memory)

    def check_memory(self) -> None:
        """Of the largest process so far."""
        if not reserves_addresses():
            self.assertLess(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, MEMORY)

    def refuse(self, code: int, *words: str | Path, before: Callable[[], None] | None = None) -> str:
        """The message of a run or check that ends so, within a minute of processor time, and harms no earlier results."""

        def limited() -> None:
            resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))
            if before is not None:
                before()

        earlier = below(self.results)
        message = self.call(code, *words, before=limited).stderr
        self.assertEqual(below(self.results), earlier, "results of the earlier run")
        return message

    def test_no_scenes(self) -> None:
        self.run_small(COMPLETED)
        scene = SCENE.read_bytes()
        for name, (spoil, told) in NO_SCENES.items():
            with self.subTest(name):
                (self.folder / "no.toml").write_bytes(spoil(scene))
                message = self.refuse(BAD_INPUT, "run", "no.toml", "--output", self.results)
                self.assert_says(message, "no.toml", told)

    def test_expressions(self) -> None:
        self.run_small(COMPLETED)
        text = SCENE.read_text(encoding="utf-8")
        for expression, told in EXPRESSIONS:
            with self.subTest(expression[:40]):
                spoilt = re.sub(r"body_force = .*", f'body_force = ["{expression}", "0"]', text)
                (self.folder / "no.toml").write_text(spoilt, encoding="utf-8")
                if told is None:
                    self.call(COMPLETED, "check", "no.toml")
                else:
                    message = self.refuse(BAD_INPUT, "run", "no.toml", "--output", self.results)
                    self.assert_says(message, "no.toml:", "load.body_force", told)

    def test_special_files(self) -> None:
        self.run_small(COMPLETED)
        for path in (self.folder, Path("/dev/zero")):
            with self.subTest(path):
                self.assert_says(self.refuse(BAD_INPUT, "run", path, "--output", self.results), str(path))

    def unprivileged(self) -> str:
        """The program and an earlier run of it where the user nobody, or this one, may do all; the program's path."""
        program = self.folder / "thermocontact"
        shutil.copy(self.driver, program)
        shutil.copy(SCENE, self.folder / "scene.toml")
        self.folder.chmod(0o755)
        self.results.mkdir()
        if os.geteuid() == 0:
            os.chown(self.results, NOBODY, NOBODY)
        return str(program)

    def test_read_only(self) -> None:
        """The folder, and the folder of the fields; files that are read-only in it are replaced, as POSIX has it."""
        type(self).driver, driver = Path(self.unprivileged()), self.driver
        self.addCleanup(lambda: setattr(type(self), "driver", driver))
        command = ("run", "scene.toml", "--output", self.results, "--quiet", "--set", "mesh.cells=[4,4]")
        self.call(COMPLETED, *command, before=as_nobody)
        for folder in (self.results, self.results / "fields"):
            with self.subTest(folder):
                folder.chmod(0o555)
                self.addCleanup(folder.chmod, 0o755)
                message = self.refuse(SYSTEM_FAILED, *command, before=as_nobody)
                self.assert_says(message, "cannot write", str(folder), "ermission denied")
                folder.chmod(0o755)
        for file in self.results.glob("*.*"):
            file.chmod(0o444)
        self.call(COMPLETED, *command, before=as_nobody)

    def test_full_disk(self) -> None:
        """A file system of 1 MiB that fills up between two runs: the second one takes nothing away."""
        script = (
            'mount -t tmpfs -o size=1m none "$0" || exit 77; '
            '"$1" run "$2" --quiet --set mesh.cells=[4,4] --set time.steps=4 --output "$0/r" || exit 78; '
            'dd if=/dev/zero of="$0/full" bs=4k count=1000 2>"$0/../dd"; '
            'digest() { find "$0/r" -type f -exec sha256sum {} + | sort; }; digest >"$0/../before"; '
            '"$1" run "$2" --quiet --set mesh.cells=[4,4] --set time.steps=4 --output "$0/r"; code=$?; '
            'digest >"$0/../after"; exit $code'
        )
        disk = self.folder / "disk"
        disk.mkdir()
        if shutil.which("unshare") is None or os.geteuid() != 0:
            self.skipTest("takes root to mount a file system")
        command = ["unshare", "--mount", "sh", "-c", script, str(disk), str(self.driver), str(SCENE)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode == 77 or "unshare failed" in done.stderr:
            self.skipTest("no file system may be mounted here")
        self.assertEqual(done.returncode, SYSTEM_FAILED, done.stderr)
        self.assert_says(done.stderr, "cannot write", "No space left on device")
        before = (self.folder / "before").read_text()
        self.assertIn("summary.json", before)
        self.assertEqual((self.folder / "after").read_text(), before)

    def test_disk_that_takes_nothing(self) -> None:
        """A results file that is a link to a full device."""
        self.results.mkdir()
        (self.results / "history.csv.part").symlink_to("/dev/full")
        (self.results / "summary.json.part").symlink_to("/dev/full")
        self.run_small(COMPLETED)
        self.assertFalse((self.results / "summary.json").is_symlink(), "what an earlier run left is removed")

    def test_restart_from_no_checkpoint(self) -> None:
        self.run_small(COMPLETED)
        good = (self.results / "checkpoint.h5").read_bytes()
        for name, content in (
            ("empty", b""),
            ("text", b"step = 3\n"),
            ("cut", good[: len(good) // 2]),
            ("a bit turned", good[:-100] + bytes([good[-100] ^ 1]) + good[-99:]),
        ):
            with self.subTest(name):
                (self.folder / "no.h5").write_bytes(content)
                command = ("run", SCENE, "--output", self.results, "--restart", "no.h5")
                self.assert_says(self.refuse(BAD_INPUT, *command), "no.h5")


if __name__ == "__main__":
    sys.exit(main(__doc__))
