"""The meshes of the scenes: made again from their geometry, read from every format of Gmsh, refused where damaged.

Run from verification/: python3 -m unittest tests.test_meshes (THERMOCONTACT_DRIVER names the driver)
"""

import contextlib
import runpy
import subprocess
import tempfile
import unittest
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import gmsh

import compare
from under_test import DRIVER, patience

SCENES = Path(__file__).resolve().parents[2] / "scenes"
MAKE = runpy.run_path(str(SCENES / "meshes" / "make.py"))
MADE_WITH = "4.8.4"
FORMATS = [(version, binary) for version in (2.2, 4.1) for binary in (0, 1)]


@contextlib.contextmanager
def opened(path: Path) -> Iterator[Any]:
    """Gmsh's model of a file."""
    gmsh.initialize(readConfigFiles=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.open(str(path))
        yield gmsh.model
    finally:
        gmsh.finalize()


def content(path: Path) -> Counter[tuple[str, int]]:
    """Elements of each named group by kind."""
    found: Counter[tuple[str, int]] = Counter()
    with opened(path) as model:
        for dimension, tag in model.getPhysicalGroups():
            name = model.getPhysicalName(dimension, tag)
            for entity in model.getEntitiesForPhysicalGroup(dimension, tag):
                kinds, elements, _ = model.mesh.getElements(dimension, entity)
                found.update({(name, kind): len(of_kind) for kind, of_kind in zip(kinds, elements)})
    return found


class Meshes(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_scene(self, name: str, mesh: Path, results: Path) -> "subprocess.CompletedProcess[str]":
        settings = [f'mesh.file="{mesh}"', "time.steps=1"]
        words = [word for setting in settings for word in ("--set", setting)]
        command: list[str | Path] = [
            DRIVER,
            "run",
            SCENES / f"{name}.toml",
            "--quiet",
            "--output",
            results,
            *words,
        ]
        return subprocess.run(command, capture_output=True, text=True, timeout=patience(120))

    def written(self, mesh: Path, version: float, binary: int) -> Path:
        path = self.folder / f"{mesh.stem}-{version}-{binary}.msh"
        with opened(mesh):
            gmsh.option.setNumber("Mesh.MshFileVersion", version)
            gmsh.option.setNumber("Mesh.Binary", binary)
            gmsh.write(str(path))
        return path

    def test_made_again(self) -> None:
        with opened(SCENES / "meshes" / "press-fit.msh"):
            same_gmsh = gmsh.option.getString("General.Version") == MADE_WITH
        for name in MAKE["MESHES"]:
            with self.subTest(name):
                made, committed = MAKE["make"](name, self.folder), SCENES / "meshes" / f"{name}.msh"
                if same_gmsh:
                    self.assertEqual(made.read_bytes(), committed.read_bytes())
                else:  # another mesh generator: the same groups, about as many elements
                    ours, theirs = content(committed), content(made)
                    self.assertEqual(set(ours), set(theirs))
                    for key, count in ours.items():
                        self.assertAlmostEqual(theirs[key], count, delta=0.3 * count, msg=str(key))

    def test_every_format_gives_the_same_numbers(self) -> None:
        for name in MAKE["MESHES"]:
            mesh, reference = SCENES / "meshes" / f"{name}.msh", self.folder / name
            self.assertEqual(self.run_scene(name, mesh, reference).returncode, 0)
            for version, binary in FORMATS:
                with self.subTest(f"{name}, {version}, binary {binary}"):
                    results = self.folder / f"{name}-{version}-{binary}"
                    result = self.run_scene(name, self.written(mesh, version, binary), results)
                    self.assertEqual(result.returncode, 0, result.stderr)
                    with contextlib.redirect_stdout(None):
                        self.assertEqual(compare.main([str(reference), str(results)]), 0)

    def test_truncated(self) -> None:
        mesh = SCENES / "meshes" / "press-fit.msh"
        for version, binary in FORMATS:
            whole = self.written(mesh, version, binary)
            data = whole.read_bytes()
            for share in (0.05, 0.3, 0.6, 0.9, 0.99):
                with self.subTest(f"{version}, binary {binary}, {share}"):
                    whole.write_bytes(data[: int(share * len(data))])
                    result = self.run_scene("press-fit", whole, self.folder / "none")
                    self.assertEqual(result.returncode, 2, result.stderr)
                    self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
                    self.assertIn(str(whole), result.stderr)
                    self.assertFalse((self.folder / "none").exists(), "nothing is written")


if __name__ == "__main__":
    unittest.main()
