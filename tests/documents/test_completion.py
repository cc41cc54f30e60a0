"""Completion of the command line in bash, zsh and fish.

Run from tests/documents/: python3 -m unittest test_completion
"""

import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from build_under_test import BUILD, ROOT, declarations

FOLDER = BUILD / "completions"
BASH = r"""
source "$1"; shift
COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1))
_thermocontact
printf '%s\n' "${COMPREPLY[@]}"
"""


def in_bash(line: str) -> list[str]:
    """What bash offers at the end of a line, which it cuts into words at blanks and "="."""
    words = [word for part in line.split(" ") for word in re.split("(=)", part) if word or not part]
    words += [""] if line.endswith("=") else []
    if words[-2:] == ["=", ""]:  # right behind "=" it is the current word
        words.pop()
    done = subprocess.run(
        ["bash", "-c", BASH, "bash", str(FOLDER / "thermocontact"), *words],
        capture_output=True,
        text=True,
        check=True,
        cwd=ROOT,
    )
    if done.stderr:
        raise AssertionError(done.stderr)
    return sorted(filter(None, done.stdout.split("\n")))


class Bash(unittest.TestCase):
    """Asked without a terminal."""

    def test_commands(self) -> None:
        """All of them, and those that begin so."""
        names = {command["name"] for command in declarations()["commands"] if command["name"]}
        self.assertLessEqual(names, set(in_bash("thermocontact ")))
        self.assertEqual(in_bash("thermocontact sch"), ["schema"])
        self.assertEqual(in_bash("thermocontact --ver"), ["--version"])

    def test_options(self) -> None:
        """Of each command its own."""
        for command in declarations()["commands"]:
            if command["name"]:
                offered = in_bash(f"thermocontact {command['name']} -")
                names = [name for option in command["options"] for name in option["name"].split(",")]
                self.assertEqual(offered, sorted(name for name in names if name.startswith("-")))

    def test_values_of_options(self) -> None:
        """Formats, quantities, folders; nothing of a number."""
        self.assertEqual(in_bash("thermocontact schema --format m"), ["markdown"])
        self.assertIn("peak_pressure", in_bash("thermocontact run scenes/paper.toml --of "))
        self.assertIn("scenes", in_bash("thermocontact run scenes/paper.toml --output s"))
        self.assertEqual(in_bash("thermocontact run scenes/paper.toml --accuracy "), [])

    def test_scenes(self) -> None:
        """Files in TOML, and folders that may have some."""
        self.assertEqual(
            in_bash("thermocontact run scenes/pap"), ["scenes/paper-isotropic.toml", "scenes/paper.toml"]
        )
        self.assertIn("scenes/", in_bash("thermocontact check "))
        self.assertNotIn("README.md", in_bash("thermocontact check "))

    def test_arguments(self) -> None:
        """Folders of results, laws, the file of a page, the scene whose keys are asked for."""
        self.assertIn("scenes", in_bash("thermocontact view s"))
        self.assertEqual(in_bash("thermocontact forms fr"), ["friction"])
        self.assertEqual(in_bash("thermocontact view results --output READ"), ["README.md"])
        self.assertIn("scenes/paper.toml", in_bash("thermocontact schema --scene scenes/paper"))

    def test_keys(self) -> None:
        """Every key; those of boundaries by the names that the scene has."""
        offered = in_bash("thermocontact run --set ")
        for key in declarations()["keys"]:
            if "NAME" not in key["key"]:
                self.assertIn(key["key"] + "=", offered)
        self.assertEqual(in_bash("thermocontact run --set time.sch"), ["time.scheme="])
        self.assertIn("boundary.front.traction=", offered)
        of_scene = in_bash("thermocontact run scenes/brake-pad.toml --set boundary.")
        names = set(
            re.findall(r"^\[boundary\.(\w+)", (ROOT / "scenes/brake-pad.toml").read_text(), re.MULTILINE)
        )
        self.assertTrue(names)
        self.assertEqual({key.split(".")[1] for key in of_scene}, names)

    def test_values_of_keys(self) -> None:
        """With the quotes that TOML wants, kept from the shell."""
        self.assertEqual(
            in_bash("thermocontact run --set time.scheme=b"), ["'\"backward-euler\"'", "'\"bdf2\"'"]
        )
        self.assertIn("'\"iterated\"'", in_bash("thermocontact run a.toml --set time.coupling="))
        vertex = in_bash("thermocontact run a.toml --set boundary.left.contact.quadrature=")
        self.assertEqual(vertex, ["'\"vertex\"'"])


@unittest.skipUnless(shutil.which("fish"), "no fish")
class Fish(unittest.TestCase):
    """It completes a given line by itself."""

    def offered(self, line: str) -> list[str]:
        """The words, without their descriptions."""
        with tempfile.TemporaryDirectory() as home:
            command = f"source {FOLDER / 'thermocontact.fish'}; complete -C '{line}'"
            done = subprocess.run(
                ["fish", "--no-config", "-c", command],
                capture_output=True,
                text=True,
                check=True,
                cwd=ROOT,
                env={"HOME": home, "PATH": "/usr/bin:/bin"},
            )
        self.assertEqual(done.stderr, "")
        return [word.split("\t")[0] for word in done.stdout.splitlines()]

    def test_it(self) -> None:
        """Commands, options, values, keys, scenes."""
        self.assertEqual(self.offered("thermocontact sch"), ["schema"])
        self.assertIn("--restart", self.offered("thermocontact run --"))
        self.assertEqual(self.offered("thermocontact schema --format m"), ["markdown"])
        self.assertIn('time.scheme="bdf2"', self.offered("thermocontact run --set time.sch"))
        self.assertIn("scenes/paper.toml", self.offered("thermocontact check scenes/pap"))


@unittest.skipUnless(shutil.which("zsh"), "no zsh")
class Zsh(unittest.TestCase):
    """A terminal is played to it."""

    SESSION = r"""
zmodload zsh/zpty
zpty shell zsh -f
feed() { zpty -w shell "$1" }
feed "PROMPT=; fpath=($1 \$fpath); autoload -Uz compinit; compinit -u -d $2/dump; zstyle ':completion:*' list-prompt ''; LISTMAX=0"
feed "print rea''dy"
zpty -r -m shell seen '*ready*'
zpty -w -n shell "$3"$'\t\t'
zpty -r -m shell seen "*$4*" && print found
zpty -d shell
"""

    def offers(self, line: str, word: str) -> bool:
        """Whether the word is on the screen after the line and the key that completes."""
        with tempfile.TemporaryDirectory() as home:
            done = subprocess.run(
                ["zsh", "-f", "-c", self.SESSION, "zsh", str(FOLDER), home, line, word],
                capture_output=True,
                text=True,
                cwd=ROOT,
                env={"HOME": home, "PATH": "/usr/bin:/bin", "TERM": "dumb"},
                timeout=60,
            )
        return "found" in done.stdout

    def test_it(self) -> None:
        """Commands, options, values, keys."""
        for line, word in {
            "thermocontact sch": "schema",
            "thermocontact run --rest": "--restart",
            "thermocontact schema --format m": "markdown",
            "thermocontact run --set time.sp": "time.spectral_radius",
            "thermocontact run --set time.scheme=": "bdf2",
            "thermocontact check scenes/paper-i": "scenes/paper-isotropic.toml",
        }.items():
            self.assertTrue(self.offers(line, word), line)
