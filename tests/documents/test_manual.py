"""The manual pages: clean to man and mandoc, and complete.

Run from tests/documents/: python3 -m unittest test_manual
"""

import os
import re
import shutil
import subprocess
import unittest
from pathlib import Path

from build_under_test import BUILD, declarations

PAGES = (BUILD / "man/thermocontact.1", BUILD / "man/thermocontact-scene.5")


def shown(page: Path) -> subprocess.CompletedProcess[str]:
    """The page as man formats it."""
    environment = os.environ | {"LC_ALL": "C.UTF-8", "MANWIDTH": "80"}
    command = ["man", "--warnings=all", "-E", "UTF-8", "-Tutf8", "-l", str(page)]
    return subprocess.run(command, capture_output=True, text=True, check=True, env=environment)


def plain(text: str) -> str:
    """The words of a page, with what marks them, in one line."""
    return " ".join(text.replace("\\-", "-").replace("\\e", "\\").split())


class Manual(unittest.TestCase):
    """What readers and their programs see."""

    @unittest.skipUnless(shutil.which("man"), "no man")
    def test_man_has_nothing_to_say(self) -> None:
        """Not a warning."""
        for page in PAGES:
            done = shown(page)
            self.assertEqual(done.stderr, "")
            self.assertIn("SEE ALSO", re.sub(".\b|\x1b\\[[0-9;]*m", "", done.stdout))

    @unittest.skipUnless(shutil.which("mandoc"), "no mandoc")
    def test_mandoc_has_nothing_to_say(self) -> None:
        """Nor mandoc, but for its wish for a date, which would differ from build to build."""
        for page in PAGES:
            found = subprocess.run(
                ["mandoc", "-T", "lint", "-W", "style", page], capture_output=True, text=True
            )
            lines = [line for line in found.stdout.splitlines() if "missing date" not in line]
            self.assertEqual(lines, [])

    def test_all_is_there(self) -> None:
        """Commands, options with their help, exit codes, keys."""
        program, scene = (plain(page.read_text()) for page in PAGES)
        known = declarations()
        for command in known["commands"]:
            self.assertTrue(not command["name"] or f".SS {command['name']} " in program)
            for option in command["options"]:
                if option["name"].startswith("-"):
                    self.assertIn(f"\\fB{option['name'].split(',')[-1]}\\fR", program)
                    self.assertIn(option["help"], program)
        for code in known["exit_codes"]:
            self.assertIn(f"\\fB{code['code']}\\fR {code['meaning']}", program)
        for key in known["keys"]:
            self.assertIn(f".TP \\fB{key['key']}\\fR ", scene)
            self.assertIn(key["description"], scene)
