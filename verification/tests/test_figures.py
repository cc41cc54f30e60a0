"""figures.py draws bodies in the plane and in space, of every cell and degree, from one process or several.

Run from verification/: python3 -m unittest tests.test_figures (THERMOCONTACT_DRIVER names the driver)
"""

import contextlib
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np
from PIL import Image

import animate
import figures
from plotting import surface
from plotting.results import Results
from under_test import DRIVER, patience

SCENES = Path(__file__).resolve().parents[2] / "scenes"
BODY = {"deformed.png", "temperature.png", "von-mises.png", "contact-history.png"}


class Figures(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_scene(self, name: str, *settings: str, processes: int = 1) -> Path:
        results = self.folder / f"{name}-{len(list(self.folder.iterdir()))}"
        words = [word for setting in ("time.steps=1", *settings) for word in ("--set", setting)]
        program: list[str | Path] = [
            DRIVER,
            "run",
            SCENES / f"{name}.toml",
            "--quiet",
            "--output",
            results,
            *words,
        ]
        start = [] if processes == 1 else ["mpirun", "-n", str(processes)]
        subprocess.run([*start, *program], check=True, timeout=patience(120))
        return results

    def draw(self, *folders: Path) -> set[str]:
        output = folders[0] / "pictures"
        with contextlib.redirect_stdout(None):
            code = figures.main([*map(str, folders), "--output", str(output), "--small"])
        self.assertEqual(code, 0)
        return {path.name for path in output.iterdir()}

    def test_a_moving_picture(self) -> None:
        results = self.run_scene("impact", "time.steps=4", "mesh.cells=[4,4]", processes=2)
        film = results / "film.gif"
        with contextlib.redirect_stdout(None):
            self.assertEqual(animate.main([str(results), "--output", str(film), "--frames", "3"]), 0)
            with contextlib.redirect_stderr(None):
                no_field = ["--output", str(film), "--field", "velocity"]
                bare = self.run_scene("impact", "mesh.cells=[2,2]", 'output.fields=["temperature"]')
                self.assertEqual(animate.main([str(bare), *no_field]), 2)
        with Image.open(film) as image:
            self.assertEqual(getattr(image, "n_frames", 1), 3)

    def test_foundation_is_where_the_scene_says(self) -> None:
        # at first nothing has moved, and the gap of the scene is what lies between the lower side and the foundation
        results = Results(self.run_scene("impact", "mesh.cells=[4,4]", processes=2))
        film = animate.Film(results, "temperature", 2, 1.0)
        contact = film.contacts[0]
        assert contact is not None
        ground = animate.foundation(film.bodies[0], film.moved(0), contact)
        x = contact.points[contact.cells][:, :, 0]
        np.testing.assert_allclose(ground[:, :, 0], x, atol=1e-15)
        np.testing.assert_allclose(ground[:, :, 1], -(0.2 + 0.02 * (2 * x - 1) ** 2), rtol=1e-14)

    def test_a_solid_of_tetrahedra(self) -> None:
        self.assertEqual(self.draw(self.run_scene("brake-pad")), BODY | {"contact-disc-final.png"})

    def test_two_solids_side_by_side(self) -> None:
        folders = [self.run_scene("socket"), self.run_scene("socket", "space.degree=2", "mesh.cells=[2,2,2]")]
        self.assertEqual(self.draw(*folders), BODY | {"contact-bottom-final.png", "contact-right-final.png"})

    def test_a_section_of_quadrilaterals(self) -> None:
        of_the_bore = {"contact-bore-final.png", "contact-bore-maps.png"}
        self.assertEqual(self.draw(self.run_scene("press-fit")), BODY | of_the_bore)

    def test_pieces_of_several_processes(self) -> None:
        self.assertEqual(
            self.draw(self.run_scene("brake-pad", processes=2)), BODY | {"contact-disc-final.png"}
        )

    def test_what_is_seen_of_a_box(self) -> None:
        """Three of its faces, whole: their projected areas, and nodes of degree 2 midway between corners."""
        for cell in ("simplex", "tensor"):
            for degree in (1, 2):
                with self.subTest(f"{cell}, {degree}"):
                    results = self.run_scene("box", f'mesh.cell="{cell}"', f"space.degree={degree}")
                    body = Results(results).body
                    view = surface.view_of(body, None)
                    seen = surface.surface(body, view, body.points)
                    triangles, owners = seen.triangles()
                    a, b, c = (view.project(body.points)[triangles[:, corner]] for corner in range(3))
                    area = 0.5 * np.abs(np.cross(b - a, c - a)).sum()
                    extent = np.ptp(body.points, axis=0)
                    sides = extent[[1, 2, 0]] * extent[[2, 0, 1]]
                    self.assertAlmostEqual(area, float(sides @ np.abs(view.axes[2])), delta=1e-12)
                    self.assertTrue(np.isin(triangles, body.cells[owners]).all())
                    for row in surface.EDGES[seen.cell_type]:
                        ends = body.points[seen.cells[:, [row[0], row[-1]]]].mean(axis=1)
                        middle = body.points[seen.cells[:, row[1]]] if len(row) == 3 else ends
                        np.testing.assert_allclose(middle, ends, atol=1e-12)

    def test_a_body_with_a_low_contact_boundary_is_seen_from_below(self) -> None:
        results = Results(self.run_scene("socket"))
        self.assertLess(surface.view_of(results.body, results.contact_grids[-1]).axes[2, 1], 0.0)
        self.assertGreater(surface.view_of(results.body, None).axes[2, 1], 0.0)


if __name__ == "__main__":
    unittest.main()
