"""The documents: every link leads somewhere, and every key, field and code of the program is in the reference.

Run from tests/documents/: python3 -m unittest test_reference
"""

import json
import re
import subprocess
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path

from build_under_test import BUILD, DRIVER, ROOT, declarations

DOCS = BUILD / "docs"
LINK = re.compile(r"(?<!`)!?\[[^\]]*\]\(([^)\s]+)\)")


def without_code(text: str) -> str:
    """What is left of a page without its blocks and spans of code, whose brackets are no links."""
    lines = [line for line in text.splitlines() if not line.startswith("    ")]
    return re.sub(r"`[^`\n]*`", "", "\n".join(lines))


def anchors(page: Path) -> set[str]:
    """Of the headings, as web pages of repositories make them."""
    heads = re.findall(r"^#+ (.*)$", page.read_text(), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", head.lower()).replace(" ", "-") for head in heads}


def broken(page: Path) -> list[str]:
    """Links of a page in Markdown that lead nowhere."""
    result = []
    for target in LINK.findall(without_code(page.read_text())):
        if re.match(r"[a-z]+:", target):
            continue
        file, _, anchor = target.partition("#")
        place = page.parent / file if file else page
        if not place.exists() or (anchor and anchor not in anchors(place)):
            result.append(f"{page.name}: {target}")
    return result


class Links(HTMLParser):
    """What a page in HTML refers to."""

    def __init__(self) -> None:
        super().__init__()
        self.targets: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Collects links and images."""
        self.targets += [value for name, value in attrs if name in ("href", "src") and value]


class Reference(unittest.TestCase):
    """What the folder of documents must have."""

    def test_links_of_the_repository(self) -> None:
        """Pages that are written by hand lead to files that are there, or to pages of the reference."""
        for page in [ROOT / "README.md", *(ROOT / "docs").glob("*.md")]:
            left = [link for link in broken(page) if not (DOCS / link.split(": ")[1].split("#")[0]).is_file()]
            self.assertEqual(left, [])

    def test_links_of_the_reference(self) -> None:
        """In the folder that is installed nothing leads out of it, or nowhere."""
        pages = list(DOCS.glob("*.md"))
        self.assertGreaterEqual(len(pages), 8)
        for page in pages:
            self.assertEqual(broken(page), [])
            self.assertNotIn("](../", page.read_text())

    def test_html(self) -> None:
        """A page each, whose links lead to HTML."""
        for page in DOCS.glob("*.md"):
            html = page.with_suffix(".html")
            self.assertTrue(html.exists(), html)
            links = Links()
            links.feed(html.read_text())
            for target in links.targets:
                if not re.match(r"[a-z]+:|#", target):
                    self.assertFalse(target.endswith(".md"), target)
                    self.assertTrue((DOCS / target.partition("#")[0]).exists(), f"{html.name}: {target}")

    def test_every_page_is_in_the_index(self) -> None:
        """By its title."""
        index = (DOCS / "index.md").read_text()
        for page in DOCS.glob("*.md"):
            if page.name != "index.md":
                title = page.read_text().splitlines()[0].removeprefix("# ")
                self.assertIn(f"[{title}]({page.name})", index)

    def test_every_key(self) -> None:
        """As the program that is tested prints them."""
        schema = subprocess.run([DRIVER, "schema", "--format", "json"], check=True, capture_output=True)
        page = (DOCS / "scene-keys.md").read_text()
        table = ""
        documented = set()
        for line in page.splitlines():
            if line.startswith("## `["):
                table = line[5:-2] + "."
            elif line.startswith("| `"):
                documented.add(table + line[3:].partition("`")[0])
        self.assertEqual(documented, {key["key"] for key in json.loads(schema.stdout)})

    def test_every_column_field_and_entry(self) -> None:
        """As runs write them: one adaptive, one planned."""
        page = (DOCS / "results.md").read_text()
        with tempfile.TemporaryDirectory() as folder:
            for name, words in {
                "adaptive": ["paper-isotropic", "--set", "time.tolerance=1e-2"],
                "planned": ["heat-only", "--accuracy", "0.3"],
            }.items():
                scene, *options = words
                sizes = ["--set", "mesh.cells=[4,4]", "--set", "time.steps=2", "--set", "output.every=1"]
                command = [
                    str(DRIVER),
                    "run",
                    str(ROOT / f"scenes/{scene}.toml"),
                    *sizes,
                    *options,
                    "--quiet",
                ]
                results = Path(folder) / name
                subprocess.run([*command, "--output", str(results)], check=True)
                for quantity in sorted(written(results)):
                    self.assertIn(f"| `{quantity}` |", page)

    def test_every_exit_code(self) -> None:
        """Those of the interface."""
        codes = [
            int(code)
            for code in re.findall(r"^\| (\d+) \|", (DOCS / "exit-codes.md").read_text(), re.MULTILINE)
        ]
        self.assertEqual(codes, [0, 1, 2, 3, 130, 143])

    def test_every_option(self) -> None:
        """As the help of each command has them."""
        page = (DOCS / "command-line.md").read_text()
        for command in declarations()["commands"]:
            words = [command["name"]] if command["name"] else []
            text = subprocess.run(
                [DRIVER, *words, "--help"], check=True, capture_output=True, text=True
            ).stdout
            section = page.split(f"## `{' '.join(['thermocontact', *words])}`\n")[1].split("\n## ")[0]
            for option in re.findall(r"^  (-\S+)", text, re.MULTILINE):
                for name in option.split(","):
                    self.assertIn(f"`{name}`", section)


def leaves(value: object, name: str = "") -> set[str]:
    """Dotted names of a summary's entries, with the placeholders of the reference."""
    if not isinstance(value, dict) or not value:
        return {name} if value != {} else set()
    result = set()
    for key, entry in value.items():
        key = {
            "final.contact": "NAME",
            "conditioning": "BALANCE",
            "solver.factors": "BALANCE",
        }.get(name, key)
        result |= (
            {"scene"} if (name, key) == ("", "scene") else leaves(entry, f"{name}.{key}" if name else key)
        )
    return result


def written(results: Path) -> set[str]:
    """Names of all that a folder of results has."""
    names = leaves(json.loads((results / "summary.json").read_text()))
    for file in results.glob("*.csv"):
        names |= set(file.read_text().splitlines()[0].split(","))
    for file in results.glob("fields/*.vtu"):
        names |= set(re.findall(r'Name="(\w+)"', file.read_bytes().decode("latin-1")))
    return names - {"Points", "connectivity", "offsets", "types"}  # VTK's own
