"""Each command of README.md, and of the pages that it leads to, does what it should when a new user types it.

Run from tests/documents/: python3 -m unittest test_readme; THERMOCONTACT_LONG=1 runs as they stand those that take minutes.
Commands are run in the order of the pages, in a copy of the repository beside the build under test.
"""

import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from build_under_test import BUILD, ROOT
from readme_commands import COMMANDS, OUTPUT, Command

PAGES = (
    "README.md",
    "docs/theory.md",
    "docs/meshes.md",
    "docs/method.md",
    "docs/accuracy.md",
    "docs/verification.md",
)
LONG = os.environ.get("THERMOCONTACT_LONG", "") == "1"
FIRST_WORDS = (
    "build/thermocontact",
    "python3",
    "sh",
    "cmake",
    "ctest",
    "mpirun",
    "sudo",
    "example/step_by_step",
)
PATIENCE = 300 * float(os.environ.get("THERMOCONTACT_SLOWER", "1")) * (20 if LONG else 1)  # s


def indented(text: str) -> list[str]:
    """Lines of the blocks that stand four columns in, continued ones in one; not those of lists."""
    lines, block = [], False
    previous = ""
    for line in text.replace("\\\n", " ").splitlines():
        block = line.startswith("    ") and (block or not previous.strip())
        if block:
            lines.append(line.strip())
        previous = line
    return lines


def without_comment(line: str) -> str:
    """The command itself, blanks between its words alike; a # within quotes would be its own."""
    return " ".join(re.sub(r"\s+#\s.*$", "", line).split())


def commands(text: str) -> list[str]:
    """Those of a page, in their order. Throws where an indented line is neither a command nor known output."""
    result = []
    for line in indented(text):
        command = without_comment(line)
        if command.split()[0] in FIRST_WORDS:
            result.append(command)
        elif not line.startswith(OUTPUT):
            raise ValueError(f"neither a command nor output: {line}")
    return result


def of_pages() -> list[str]:
    """Those of all pages, each once."""
    return list(dict.fromkeys(one for page in PAGES for one in commands((ROOT / page).read_text())))


class Extraction(unittest.TestCase):
    """What is taken for a command."""

    def test_it(self) -> None:
        """Comments, continued lines, output, prose."""
        text = "a\n\n    sh x.sh   # why\n    build/thermocontact a \\\n        --b 'c # d'\n\n    holds (H1)\nb\n    prose\n"
        self.assertEqual(
            commands(text), ["sh x.sh", "build/thermocontact a --b 'c # d'".replace(" # d'", "")]
        )
        with self.assertRaises(ValueError):
            commands("a\n\n    rm -rf build\n")


class Readme(unittest.TestCase):
    """The README of this repository."""

    folder: tempfile.TemporaryDirectory[str]
    copy: Path
    environment: dict[str, str]

    @classmethod
    def setUpClass(cls) -> None:
        """A copy of what is in the repository, with the build that is tested and the python3 that has dolfinx."""
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.copy = Path(cls.folder.name) / "thermocontact"
        ignored = shutil.ignore_patterns("build*", ".git", "*-results", "__pycache__")
        shutil.copytree(ROOT, cls.copy, ignore=ignored, symlinks=True)
        (cls.copy / "build").symlink_to(BUILD)
        words = Path(cls.folder.name) / "bin"
        words.mkdir()
        (words / "python3").symlink_to(sys.executable)
        compiled = os.environ.get("XDG_CACHE_HOME", str(Path.home() / ".cache"))  # the oracle's forms
        cls.environment = os.environ | {
            "HOME": cls.folder.name,
            "PATH": f"{words}:{os.environ['PATH']}",
            "XDG_CACHE_HOME": compiled,
        }

    def shell(self, command: str) -> None:
        """Runs it to its end."""
        done = subprocess.run(
            command,
            shell=True,
            cwd=self.copy,
            env=self.environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            timeout=PATIENCE,
        )
        self.assertEqual(done.returncode, 0, f"{command}\n{done.stdout[-3000:]}")

    def interrupt(self, command: str) -> None:
        """Runs it until it has results, and presses Ctrl-C."""
        history = self.copy / "results/history.csv"
        history.unlink(missing_ok=True)
        with subprocess.Popen(
            command.split(), cwd=self.copy, env=self.environment, stderr=subprocess.DEVNULL
        ) as process:
            give_up = time.monotonic() + PATIENCE
            while not (history.exists() and history.stat().st_size) and time.monotonic() < give_up:
                time.sleep(0.001)
            process.send_signal(signal.SIGINT)
        self.assertIn(process.returncode, (130, 0))  # 0: it had ended

    def attempt(self, command: Command) -> None:
        """As the table says."""
        if command.interrupted:
            self.interrupt(command.text)
        elif LONG and command.long:
            self.shell(command.text)
        elif not command.reason:
            self.shell(command.instead or command.text)
        elif command.text.startswith("python3 "):
            self.shell(" ".join(command.text.split()[:2]) + " --help")
        elif command.text.startswith("sh "):
            self.shell(f"sh -n {command.text.split()[1]}")
        elif command.text.startswith("cmake --workflow"):
            self.assertIn(command.text.split()[-1], self.presets())

    def presets(self) -> str:
        """The names that CMake knows."""
        done = subprocess.run(
            ["cmake", "--workflow", "--list-presets"],
            cwd=self.copy,
            capture_output=True,
            text=True,
            check=True,
        )
        return done.stdout

    def test_every_command_is_in_the_table(self) -> None:
        """And the table has no other."""
        found = of_pages()
        self.assertEqual(sorted(found), sorted(command.text for command in COMMANDS))

    def test_what_is_not_run_has_a_test(self) -> None:
        """One that ctest knows, where the table names one."""
        known = "".join(path.read_text() for path in BUILD.glob("**/CTestTestfile.cmake"))
        listed = re.findall(r"^\s*add_test\((?:\[=\[)?([\w.-]+)", known, re.MULTILINE)
        for command in COMMANDS:
            if command.test:
                self.assertIn(command.test, listed)

    def test_the_continuous_check_is_the_second_command(self) -> None:
        """So that a test which ran it would run itself."""
        self.assertIn("tests/run.sh", (ROOT / ".ci/run").read_text())

    def test_commands(self) -> None:
        """In the order of the pages."""
        table = {command.text: command for command in COMMANDS}
        for text in of_pages():
            if text in table:
                with self.subTest(text):
                    begin = time.monotonic()
                    self.attempt(table[text])
                    print(f"{time.monotonic() - begin:6.1f} s  {text}", flush=True)
