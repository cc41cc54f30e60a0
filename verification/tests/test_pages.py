"""Pages in headless Chromium: `view` shows the numbers of the files, and pages fit a phone and a desk, light and dark.

Run from verification/: python3 -m unittest tests.test_pages. THERMOCONTACT_DRIVER names the driver.
"""

import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np
from browser import CHROMIUM, DESKTOP, PHONE, Seen, look
from oracle_parts import vtu
from under_test import DRIVER, ROOT, patience

SCENES = ROOT / "scenes"
# what is cut into triangles: 4 x 4 squares, their halves, quadrilaterals of degree 2 in eight; boxes of 2 x 2 x 2 show
# 6 x 4 squares, their halves (of degree 2 in four) or eight triangles each
BODIES: dict[str, tuple[str, list[str], int, int]] = {
    "triangles": ("isothermal", ["mesh.cells=[4,4]"], 1, 32),
    "squares": ("isothermal", ["mesh.cells=[4,4]", 'mesh.cell="tensor"', "space.degree=2"], 1, 16 * 8),
    "two pieces": ("isothermal", ["mesh.cells=[4,4]"], 2, 32),
    "tetrahedra": ("box", ["mesh.cells=[2,2,2]", "space.degree=2"], 1, 24 * 2 * 4),
    "tetrahedra in pieces": ("box", ["mesh.cells=[2,2,2]"], 2, 24 * 2),
    "hexahedra": ("box", ["mesh.cells=[2,2,2]", 'mesh.cell="tensor"', "space.degree=2"], 1, 24 * 8),
}


def made(folder: Path, scene: str, overrides: list[str], processes: int = 1) -> Path:
    """The page of a run of two steps."""
    settings = [word for setting in [*overrides, "time.steps=2"] for word in ("--set", setting)]
    launch = ["mpirun", "-n", str(processes)] if processes > 1 else []
    run = [str(DRIVER), "run", str(SCENES / f"{scene}.toml"), "--output", str(folder), "--quiet", *settings]
    subprocess.run([*launch, *run], check=True, timeout=patience(60))
    view = [str(DRIVER), "view", str(folder), "--no-open"]
    said = subprocess.run(view, check=True, capture_output=True, text=True, timeout=patience(60)).stdout
    assert said == f"{folder / 'view.html'}\n", said
    return folder / "view.html"


def extremes_of(folder: Path, step: int, field: str) -> tuple[float, float]:
    pieces = [vtu.read_grid(file) for file in sorted((folder / "fields").glob(f"body_{step:06d}*.vtu"))]
    values = np.concatenate([piece.point_data[field].ravel() for piece in pieces])
    return float(values.min()), float(values.max())


@unittest.skipIf(CHROMIUM is None, "no chromium")
class ViewTest(unittest.TestCase):
    def setUp(self) -> None:
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name) / "results"

    def clean(self, seen: Seen) -> None:
        self.assertEqual(seen.errors, [])
        self.assertEqual(seen.broken_images, [])
        self.assertLessEqual(seen.wider_by, 0)
        self.assertEqual(seen.data["state"], "ready")

    def test_every_kind_of_cell(self) -> None:
        for name, (scene, overrides, processes, triangles) in BODIES.items():
            with self.subTest(name):
                folder = self.folder.with_name(name.replace(" ", "-"))
                seen = look(
                    made(folder, scene, overrides, processes), fragment="#time=1&of=displacement y (m)"
                )
                self.clean(seen)
                self.assertEqual(int(seen.data["triangles"]), triangles)
                if scene == "isothermal":
                    grids = sorted((folder / "fields").glob("body_000001*.vtu"))
                    values = np.concatenate(
                        [vtu.read_grid(f).point_data["displacement"][:, 1] for f in grids]
                    )
                    self.assertEqual(float(seen.data["low"]), values.min())
                    self.assertEqual(float(seen.data["high"]), values.max())

    def test_numbers_and_windows(self) -> None:
        page = made(self.folder, "paper", ["mesh.cells=[8,8]"])
        for window in (PHONE, DESKTOP):
            for dark in (False, True):
                seen = look(page, window, dark, "#time=1&of=temperature (K)")
                self.clean(seen)
                self.assertEqual(float(seen.data["time"]), 0.5)
                low, high = extremes_of(self.folder, 1, "temperature")
                self.assertEqual((float(seen.data["low"]), float(seen.data["high"])), (low, high))
                self.assertEqual(seen.background, "rgb(22, 25, 29)" if dark else "rgb(255, 255, 255)")

    def test_contact_sides_in_space(self) -> None:
        page = made(self.folder, "box", ["mesh.cells=[2,2,2]"])
        text = page.read_text()
        chosen = text.replace('<option value="contact">', '<option selected value="contact">')
        self.assertNotEqual(chosen, text)
        page.write_text(chosen)
        seen = look(page, fragment="#of=pressure (Pa)")
        self.clean(seen)
        grid = vtu.read_grid(self.folder / "fields" / "contact_000002.vtu")
        self.assertEqual(int(seen.data["triangles"]), len(grid.cells))
        self.assertEqual(float(seen.data["high"]), grid.point_data["pressure"].max())

    def test_would_notice(self) -> None:
        page = made(self.folder, "isothermal", ["mesh.cells=[4,4]"])
        self.assertGreater(look(page, PHONE, style="main { min-width: 900px }").wider_by, 0)
        text = page.read_text()
        broken = self.folder / "broken.html"
        for old, new in (
            ('data-file="history.csv"', 'data-file="other.csv"'),
            ("<Piece NumberOfPoints", "<Part NumberOfPoints"),
        ):
            self.assertIn(old, text)
            broken.write_text(text.replace(old, new))
            self.assertTrue(look(broken).data["state"].startswith("failed: "), new)
        broken.write_text(text.replace("</main>", '<img alt="gone" src="gone.png"></main>'))
        self.assertEqual(look(broken).broken_images, ["gone"])

    def test_title_that_ends_a_script(self) -> None:
        page = made(self.folder, "isothermal", ["mesh.cells=[4,4]", "title='</script><b id=x>a'"])
        self.clean(look(page))


if __name__ == "__main__":
    unittest.main()
