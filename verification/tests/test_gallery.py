"""docs/gallery.md and the pictures of gallery.py: every scene of the gallery has its section, picture and command.

Run from verification/: python3 -m unittest tests.test_gallery (THERMOCONTACT_DRIVER names the driver)
"""

import contextlib
import io
import re
import subprocess
import tempfile
import tomllib
import unittest
from pathlib import Path

from PIL import Image

import gallery
from gallery_parts.entries import ENTRIES, Entry, Film, Run
from under_test import DRIVER, patience

ROOT = Path(__file__).resolve().parents[2]
IMAGES = ROOT / "docs" / "images"
LARGEST = 300_000  # bytes of a picture
LEAST_WORDS = 40  # of a paragraph that says what happens and what to look at
# the scenes that the gallery is to have, and those of which a still says too little
WANTED = {"paper", "paper-isotropic", "impact", "stick-slip", "disc-brake", "press-fit", "sphere", "seal"}
MOVE = {"impact", "stick-slip", "seal"}


def sections() -> dict[str, str]:
    """Text below each heading that is the name of a scene."""
    text = (ROOT / "docs" / "gallery.md").read_text(encoding="utf-8")
    parts = re.split(r"^## .*\(`([\w-]+)`\)$", text, flags=re.MULTILINE)
    return dict(zip(parts[1::2], parts[2::2]))


def paragraphs(section: str) -> str:
    """Without pictures and commands."""
    kept = [line for line in section.splitlines() if not line.startswith(("    ", "|", "!["))]
    return " ".join(kept)


class Gallery(unittest.TestCase):
    def test_every_scene_is_there(self) -> None:
        self.assertEqual({entry.scene for entry in ENTRIES}, WANTED)
        self.assertEqual(set(sections()), WANTED)
        self.assertLessEqual(MOVE, {entry.scene for entry in ENTRIES if entry.moves})

    def test_each_section_has_its_pictures_and_says_something(self) -> None:
        for entry in ENTRIES:
            with self.subTest(scene=entry.scene):
                section = sections()[entry.scene]
                shown = re.findall(r"\]\(images/([^)]+)\)", section)
                self.assertEqual(sorted(shown), sorted(picture.image for picture in entry.pictures))
                self.assertGreaterEqual(len(paragraphs(section).split()), LEAST_WORDS)
                self.assertRegex(paragraphs(section), r"\d", "no number in it")
                self.assertIn(f"    python3 verification/gallery.py {entry.scene}\n", section)

    def test_pictures_exist_and_are_small(self) -> None:
        for entry in ENTRIES:
            for picture in entry.pictures:
                with self.subTest(picture=picture.image), Image.open(IMAGES / picture.image) as image:
                    self.assertLess((IMAGES / picture.image).stat().st_size, LARGEST)
                    frames = getattr(image, "n_frames", 1)
                    self.assertEqual(frames > 1, isinstance(picture, Film))

    def test_readme_points_to_it(self) -> None:
        readme = (ROOT / "README.md").read_text(encoding="utf-8")
        self.assertIn("(docs/gallery.md)", readme)

    def test_scenes_are_accepted_with_their_settings(self) -> None:
        for entry in ENTRIES:
            for run in entry.runs.values():
                words = [word for setting in run.settings for word in ("--set", setting)]
                scene = ROOT / f"scenes/{run.scene}.toml"
                done = subprocess.run(
                    [DRIVER, "check", scene, *words], capture_output=True, timeout=patience(120), check=False
                )
                self.assertEqual(done.returncode, 0, done.stderr)


class Drawing(unittest.TestCase):
    """Small runs of what gallery.py does with all of them."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_springs_and_belt_in_a_moving_picture(self) -> None:
        entry = next(entry for entry in ENTRIES if entry.scene == "stick-slip")
        film = next(picture for picture in entry.pictures if isinstance(picture, Film))
        still = next(picture for picture in entry.pictures if not isinstance(picture, Film))
        run = Run("stick-slip", ("mesh.cells=[4,2]", "time.end=0.02", "time.steps=4", "output.every=1"))
        small = Entry(
            "stick-slip",
            {"stick-slip": run},
            (Film(film.image, "stick-slip", ("--field", "velocity", "--frames", "3")), still),
        )
        with contextlib.redirect_stdout(io.StringIO()):
            gallery.make(small, Path(DRIVER), self.folder / "work", self.folder)
        with Image.open(self.folder / film.image) as image:
            self.assertEqual(getattr(image, "n_frames", 1), 3)
        self.assertTrue((self.folder / still.image).is_file())

    def test_a_run_that_fails_is_told(self) -> None:
        wrong = Entry("impact", {"impact": Run("impact", ("mesh.cells=[0,4]",))})
        with self.assertRaises(gallery.Unmade), contextlib.redirect_stderr(io.StringIO()):
            gallery.make(wrong, Path(DRIVER), self.folder, self.folder)

    def test_zigzag_ends_where_it_should(self) -> None:
        import numpy as np

        import animate
        from plotting import surroundings
        from plotting.results import Results

        results = self.folder / "run"
        scene = ROOT / "scenes" / "benchmarks" / "drawn-block.toml"
        words = ["--set", "time.end=0.2", "--set", "time.steps=2"]
        words += ["--set", 'output.fields=["displacement","velocity","contact"]']
        command: list[str | Path] = [DRIVER, "run", scene, "--quiet", "--output", results, *words]
        subprocess.run(command, check=True, timeout=patience(120))
        film = animate.Film(Results(results), "velocity", 3, 1.0)
        upper = tomllib.loads(scene.read_text(encoding="utf-8"))["mesh"]["upper"]
        for i, time in enumerate(film.times):
            lines = film.spring_lines(i)
            self.assertEqual(len(lines), surroundings.SPRINGS)
            for line in lines:
                # the far end moves with 0.5 m/s, from a spring's length beside the body
                self.assertAlmostEqual(
                    line[-1, 0], (1 + surroundings.LENGTH) * upper[0] + 0.5 * time, places=12
                )
                near = np.linalg.norm(film.moved(i)[:, :2] - line[0], axis=1).min()
                self.assertLess(near, 1e-12)


if __name__ == "__main__":
    unittest.main()
