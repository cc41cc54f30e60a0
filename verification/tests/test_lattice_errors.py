"""Norms of differences over the body: planted differences, unequal lattices, the other implementation, the driver's own.

Run from verification/: python3 -m unittest tests.test_lattice_errors
"""

import json
import math
import subprocess
import tempfile
import unittest
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from convergence_parts import lattice
from lattice_errors import NORMS, Array, Body, Mesh, Solution, kind_of, read
from under_test import DRIVER, ROOT

UNEQUAL = ([0.0, 0.1, 0.35, 1.0], [-1.0, -0.2, 0.0])
REFINED = ([0.0, 0.05, 0.1, 0.2, 0.35, 0.5, 1.0], [-1.0, -0.7, -0.2, -0.1, 0.0])


def triangles(lines: Sequence[Sequence[float]], left: bool = False) -> Mesh:
    x, y = np.meshgrid(*lines, indexing="ij")
    points = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
    index = np.arange(x.size).reshape(x.shape)
    a, b, c, d = index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]
    halves = ((a, b, d), (b, c, d)) if left else ((a, b, c), (a, c, d))
    cells = np.concatenate([np.stack([part.ravel() for part in half], axis=1) for half in halves])
    return Mesh(points, cells, 5)


def quadratic(mesh: Mesh) -> Mesh:
    """The same triangles with nodes in the middle of their edges."""
    points, cells = list(map(tuple, mesh.points)), []
    number = {point: at for at, point in enumerate(points)}
    for cell in mesh.cells:
        corners = [mesh.points[vertex] for vertex in cell]
        middle = [tuple((corners[i] + corners[j]) / 2) for i, j in ((0, 1), (1, 2), (2, 0))]
        for point in middle:
            if point not in number:
                number[point] = len(points)
                points.append(point)
        cells.append([*cell, *(number[point] for point in middle)])
    flat = np.array(points)
    return Mesh(np.hstack([flat, np.zeros((len(flat), 1))]), np.array(cells), 22)


def solution(
    mesh: Mesh, temperature: Callable[..., Array], displacement: Callable[..., list[Array]]
) -> Solution:
    x, y = mesh.points.T
    u = np.stack([*displacement(x, y), 0 * x], axis=1)
    return Solution(mesh, [0.5], [{"temperature": temperature(x, y), "displacement": u, "velocity": 2 * u}])


class PlantedTest(unittest.TestCase):
    """0 <= x <= 1, -1 <= y <= 0."""

    def norms(self, coarse: Mesh, fine: Mesh) -> Array:
        # planted: theta off by 3 x, u off by (0.2 y, 0.4 x), w by twice that
        one = solution(coarse, lambda x, y: 5 * x + y, lambda x, y: [x + 0.2 * y, y + 0.4 * x])
        two = solution(fine, lambda x, y: 2 * x + y, lambda x, y: [x, y])
        return Body(fine).norms(one, two)[0]

    def test_planted_difference(self) -> None:
        exact = [2 * math.sqrt((0.2**2 + 0.4**2) / 3), math.sqrt(2) * 0.3, 3 / math.sqrt(3)]
        meshes = {
            "nested": (triangles(UNEQUAL), triangles(REFINED)),
            "crossing": (triangles(UNEQUAL), triangles(REFINED, left=True)),
            "coarser": (triangles(REFINED), triangles(UNEQUAL)),
            "degree 2": (triangles(UNEQUAL), quadratic(triangles(REFINED))),
            "of degree 2": (quadratic(triangles(UNEQUAL)), triangles(REFINED)),
            "same": (triangles(UNEQUAL), triangles(UNEQUAL)),
        }
        for name, (coarse, fine) in meshes.items():
            with self.subTest(name):
                np.testing.assert_allclose(self.norms(coarse, fine), exact, rtol=1e-12)

    def test_quadratic_function_is_that_of_its_nodes(self) -> None:
        """x^2 of degree 2 against 0: the integral of x^4 is 1/5, of |eps(x^2, 0)|^2 = 4 x^2 it is 4/3."""
        mesh = quadratic(triangles(UNEQUAL))
        one = solution(mesh, lambda x, y: x**2, lambda x, y: [x**2, 0 * y])
        zero = solution(triangles(REFINED), lambda x, y: 0 * x, lambda x, y: [0 * x, 0 * y])
        own = Body(mesh).norms(one, zero)[0]
        np.testing.assert_allclose(
            own, [2 * math.sqrt(1 / 5), math.sqrt(4 / 3), math.sqrt(1 / 5)], rtol=1e-12
        )

    def test_kinks_inside_of_cells(self) -> None:
        """Of a smooth function's interpolants on a uniform and on a graded lattice, beside rules in 64 parts a cell."""
        line = np.arange(17) / 16
        line = line - np.sin(2 * np.pi * line) / 8  # the largest cells are 8 times the smallest
        parts = np.unique([line[:-1] + np.diff(line) * part / 8 for part in range(9)])
        resolved = Body(triangles([parts.tolist()] * 2))
        graded = triangles([line.tolist()] * 2)
        for fine in (graded, quadratic(graded)):
            for cells in (16, 8):
                coarse = triangles([[i / cells for i in range(cells + 1)]] * 2)
                one, two = (
                    solution(
                        mesh, lambda x, y: np.sin(3 * x + y), lambda x, y: [np.sin(3 * x), np.cos(x + 2 * y)]
                    )
                    for mesh in (coarse, fine)
                )
                apart = Body(fine).norms(one, two)[0] / resolved.norms(one, two)[0] - 1
                self.assertLess(float(np.abs(apart).max()), 0.04)
                self.assertGreater(float(np.abs(apart).max()), 1e-4)  # so that the kinks are there

    def test_agrees_with_the_error_curves_own_norms(self) -> None:
        """Written apart from these, for nested squares: the same numbers for any nodal values."""
        random = np.random.default_rng(3)
        coarse, fine = (triangles([[i / n for i in range(n + 1)]] * 2) for n in (3, 12))
        values = [random.standard_normal((5, n + 1, n + 1)) for n in (3, 12)]
        frames = []
        for fields in values:  # rows along y there, along x here
            u, v, x, y, theta = (part.T.ravel() for part in fields)
            frames.append(
                {"velocity": np.stack([u, v, 0 * u], 1), "displacement": np.stack([x, y, 0 * x], 1)}
            )
            frames[-1]["temperature"] = theta
        difference = lattice.prolong(values[0], 12) - values[1]
        exact = [
            sum(lattice.integral_of_square(part).sum() for part in difference[:2]),
            lattice.integral_of_strain_square(difference[2:4]).sum(),
            lattice.integral_of_square(difference[4]).sum(),
        ]
        found = Body(fine).norms(Solution(coarse, [0.0], frames[:1]), Solution(fine, [0.0], frames[1:]))
        np.testing.assert_allclose(found[0] ** 2, exact, rtol=1e-12)


class RefusedTest(unittest.TestCase):
    def test_other_times(self) -> None:
        mesh = triangles(UNEQUAL)
        one = solution(mesh, lambda x, y: x, lambda x, y: [x, y])
        with self.assertRaisesRegex(ValueError, "times that differ"):
            Body(mesh).norms(one, Solution(mesh, [0.6], one.frames))

    def test_no_lattice(self) -> None:
        random = np.random.default_rng(4)
        x = np.sort(random.random(12))
        points = np.stack([np.append(x, 0.5), np.append(random.random(12), 2.0), np.zeros(13)], axis=1)
        fan = Mesh(points, np.array([[i, i + 1, 12] for i in range(11)]), 5)
        mesh = triangles(UNEQUAL)
        one = solution(fan, lambda x, y: x, lambda x, y: [x, y])
        with self.assertRaisesRegex(ValueError, "no lattice"):
            Body(mesh).norms(one, solution(mesh, lambda x, y: x, lambda x, y: [x, y]))

    def test_another_body(self) -> None:
        small, large = triangles(UNEQUAL), triangles(([0.0, 2.0], [-1.0, 0.0]))
        functions = lambda x, y: x, lambda x, y: [x, y]  # noqa: E731
        with self.assertRaisesRegex(ValueError, "no cell at"):
            Body(large).norms(solution(small, *functions), solution(large, *functions))

    def test_cells_of_another_type(self) -> None:
        with self.assertRaisesRegex(ValueError, "type 3"):
            kind_of(3)


@unittest.skipUnless(DRIVER.is_file(), "the driver is not built")
class DriverTest(unittest.TestCase):
    def results(self, scene: str, *settings: str) -> Path:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        words = [word for setting in settings for word in ("--set", setting)]
        path = ROOT / "scenes" / f"{scene}.toml"
        subprocess.run([DRIVER, "run", path, "--quiet", "--output", folder.name, *words], check=True)
        return Path(folder.name)

    def test_norms_are_those_of_the_summary(self) -> None:
        small = ("mesh.cells=[3,4]", "time.steps=2")
        for scene, settings in (
            ("paper-isotropic", [*small, 'mesh.diagonal="crossed"', "space.degree=2"]),
            ("paper-isotropic", [*small, 'mesh.cell="tensor"', "space.degree=2"]),
            ("box", ["time.steps=1"]),
            ("box", ["time.steps=1", "space.degree=2"]),
            ("box", ["time.steps=1", 'mesh.cell="tensor"', "space.degree=2"]),
            ("press-fit", ["time.steps=1"]),
        ):
            with self.subTest(scene, settings=settings):
                folder = self.results(scene, *settings)
                final = json.loads((folder / "summary.json").read_text(encoding="utf-8"))["final"]
                found = read(folder)
                own = Body(found.mesh).norms(found)[-1]
                np.testing.assert_allclose(own, [final.get(name, 0.0) for name in NORMS], rtol=1e-12)

    def test_degrees_on_one_mesh_of_gmsh(self) -> None:
        one, two = (read(self.results("press-fit", "time.steps=1", f"space.degree={p}")) for p in (1, 2))
        apart = Body(two.mesh).norms(one, two)[-1] / Body(two.mesh).norms(two)[-1]
        self.assertTrue(np.all(apart > 1e-5) and np.all(apart < 0.5), apart)


if __name__ == "__main__":
    unittest.main()
