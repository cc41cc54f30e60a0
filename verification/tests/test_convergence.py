"""Norms and prolongation of the error curve against closed forms, and the arithmetic of the orders.

Run from verification/: python3 -m unittest tests.test_convergence
"""

import math
import tempfile
import tomllib
import unittest
from pathlib import Path

import numpy as np

from benchmarking.process import RunFailed
from convergence_parts import errors, lattice, runs, study
from convergence_parts.lattice import Array
from oracle_parts import vtu
from under_test import DRIVER, ROOT


def vertices(cells: int) -> tuple[Array, Array]:
    along = np.arange(cells + 1) / cells
    y, x = np.meshgrid(along, along, indexing="ij")
    return x, y


def strain_norm(displacement: Array) -> float:
    return math.sqrt(lattice.integral_of_strain_square(displacement).sum())


class NormTest(unittest.TestCase):
    def test_linear_functions_are_integrated_exactly(self) -> None:
        x, y = vertices(5)
        exact = 4 / 3 + 9 / 3 + 1 - 2 * 6 / 4 + 4 / 2 - 6 / 2  # of (2 x - 3 y + 1)^2
        self.assertAlmostEqual(lattice.integral_of_square(2 * x - 3 * y + 1).sum(), exact, delta=1e-14)

    def test_interpolant_of_a_quadratic(self) -> None:
        """x^2 is interpolated by x^2 + s (h - s) on each square, s the distance from its left side."""
        n, h = 4, 1 / 4
        x, _ = vertices(n)
        exact = sum(  # Simpson's rule is exact for the square of a linear function
            h / 6 * (a**4 + 4 * ((a**2 + b**2) / 2) ** 2 + b**4)
            for a, b in ((i * h, (i + 1) * h) for i in range(n))
        )
        self.assertAlmostEqual(lattice.integral_of_square(x**2).sum(), exact, delta=1e-14)

    def test_mass_of_one_triangle(self) -> None:
        """Hat functions: 1/12 of the area on the diagonal is 1/6 of it, 1/12 beside the diagonal."""
        values = np.array([[1.0, 0.0], [0.0, 0.0]])
        np.testing.assert_allclose(lattice.integral_of_square(values).ravel(), [1 / 12, 1 / 12])
        values = np.array([[0.0, 1.0], [0.0, 0.0]])
        np.testing.assert_allclose(lattice.integral_of_square(values).ravel(), [1 / 12, 0.0])

    def test_strain(self) -> None:
        x, y = vertices(6)
        self.assertAlmostEqual(strain_norm(np.stack([-y, x])), 0.0, delta=1e-14)
        self.assertAlmostEqual(strain_norm(np.stack([y, x])), math.sqrt(2), delta=1e-13)
        exact = math.sqrt(2**2 + 5**2 + (3 + 7) ** 2 / 2)
        self.assertAlmostEqual(strain_norm(np.stack([2 * x + 3 * y, 7 * x + 5 * y])), exact, delta=1e-13)

    def test_strain_of_interpolated_quadratics(self) -> None:
        """The interpolant of x^2 has the slope a + b between a and b."""
        n = 8
        x, y = vertices(n)
        exact = math.sqrt(sum((2 * i + 1) ** 2 for i in range(n)) / n**3)
        self.assertAlmostEqual(strain_norm(np.stack([x**2, 0 * x])), exact, delta=1e-13)
        self.assertAlmostEqual(strain_norm(np.stack([0 * x, y**2])), exact, delta=1e-13)
        self.assertAlmostEqual(strain_norm(np.stack([y**2, 0 * x])), exact / math.sqrt(2), delta=1e-13)


class ProlongationTest(unittest.TestCase):
    def setUp(self) -> None:
        self.coarse = np.random.default_rng(1).standard_normal((2, 5, 5))

    def test_norms_are_kept(self) -> None:
        for cells in (4, 8, 12, 32):
            fine = lattice.prolong(self.coarse, cells)
            for own, other in zip(self.coarse, fine):
                squares = [lattice.integral_of_square(values).sum() for values in (own, other)]
                self.assertAlmostEqual(squares[0], squares[1], delta=1e-13)
            self.assertAlmostEqual(strain_norm(self.coarse), strain_norm(fine), delta=1e-12)

    def test_gradient_is_that_of_the_coarse_triangle(self) -> None:
        """Also across the diagonal: each fine triangle lies in one coarse triangle."""
        ratio = 3
        x, y = lattice.centroids(4 * ratio)
        column, row = (4 * x).astype(int), (4 * y).astype(int)
        above = (4 * y - row > 4 * x - column).astype(int)
        fine = lattice.prolong(self.coarse[0], 4 * ratio)
        for coarse, other in zip(lattice.gradient(self.coarse[0]), lattice.gradient(fine)):
            np.testing.assert_allclose(other, coarse[above, row, column], atol=1e-12)

    def test_vertices_are_kept(self) -> None:
        kept = lattice.prolong(self.coarse, 12)[..., ::3, ::3]
        np.testing.assert_allclose(kept, self.coarse, atol=1e-14)

    def test_not_nested(self) -> None:
        with self.assertRaises(ValueError):
            lattice.prolong(self.coarse, 10)


class ReadingTest(unittest.TestCase):
    def test_any_order_of_the_vertices(self) -> None:
        x, y = (values.ravel() for values in vertices(3))
        order = np.random.default_rng(2).permutation(16)
        points = np.stack([x, y, 0 * x], axis=1)[order]
        data = {"velocity": points, "displacement": 2 * points, "temperature": points[:, 0] - points[:, 1]}
        read = runs.on_lattice(vtu.Grid(points, np.empty((0, 3)), vtu.TRIANGLE, data, {}), 3)
        x, y = vertices(3)
        np.testing.assert_allclose(read, [x, y, 2 * x, 2 * y, x - y], atol=1e-15)

    def test_another_mesh(self) -> None:
        grid = vtu.Grid(np.zeros((16, 3)), np.empty((0, 3)), vtu.TRIANGLE, {}, {})
        with self.assertRaises(RunFailed):
            runs.on_lattice(grid, 3)


class ComparisonTest(unittest.TestCase):
    def stored(self, cells: int, steps: int, every: int, scale: float) -> runs.Run:
        """w = (1 + scale) t (x, 0), u = t (x, y), theta = t (1 + scale)."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        resolution = runs.Resolution(cells, steps, every)
        x, y = vertices(cells)
        frame = np.stack([(1 + scale) * x, 0 * x, x, y, (1 + scale) + 0 * x])
        path = Path(folder.name) / "fields"
        np.array([float(resolution.time(at)) * frame for at in range(resolution.frames)]).tofile(path)
        return runs.Run(resolution, path)

    def test_known_difference_at_common_times(self) -> None:
        history = errors.compare(self.stored(4, 4, 1, 0.5), self.stored(8, 16, 2, 0.0))
        self.assertEqual(history.times, (0.0, 0.25, 0.5, 0.75, 1.0))
        peak = history.peak()
        self.assertEqual(peak.time, 1.0)
        for norm, exact in zip(errors.NORMS, (0.5 / math.sqrt(3), 0.0, 0.5)):
            self.assertAlmostEqual(peak.parts[norm], exact, delta=1e-14)
        self.assertAlmostEqual(
            history.reference_peak().parts["displacement_strain_l2"], math.sqrt(2), delta=1e-14
        )

    def test_window_and_shares(self) -> None:
        history = errors.compare(self.stored(16, 4, 1, 0.5), self.stored(32, 8, 1, 0.0))
        self.assertEqual(len(history.norms(begin=0.5)), 3)
        shares = history.shares(
            "temperature_l2"
        )  # a constant: the share of the area, pi/256 for a quarter disc
        self.assertAlmostEqual(shares["upper left"], math.pi / 256, delta=1e-3)
        self.assertAlmostEqual(
            shares["diagonal"], history.area_shares("temperature_l2")["diagonal"], delta=1e-14
        )
        self.assertAlmostEqual(shares["diagonal"], 2 * lattice.BAND - lattice.BAND**2, delta=0.02)
        inside = sum(shares[name] for name in lattice.CORNERS)
        outside = history.peak(outside_corners=True).own["temperature_l2"]
        self.assertAlmostEqual(outside**2, 0.25 * (1 - inside), delta=1e-14)

    def test_bands_start_at_the_edges_of_contact(self) -> None:
        cells = 64
        closed = (np.arange(cells + 1) > 16) & (np.arange(cells + 1) < 40)
        bands = lattice.region_masks(cells, closed)[lattice.REGIONS.index("edges")].reshape(2, cells, cells)
        x, y = lattice.centroids(cells)
        inside = (abs(x - y - 16.5 / cells) < lattice.BAND) | (abs(x - y - 39.5 / cells) < lattice.BAND)
        np.testing.assert_array_equal(bands.astype(bool), inside)
        none = lattice.region_masks(cells, np.full(cells + 1, True))[lattice.REGIONS.index("edges")]
        self.assertEqual(none.sum(), 0.0)


class OrderTest(unittest.TestCase):
    def test_orders_of_a_power(self) -> None:
        sizes = [10, 20, 80]
        values = [3.0 * n**-1.5 for n in sizes]
        np.testing.assert_allclose(errors.observed_orders(sizes, values), [math.nan, 1.5, 1.5])
        self.assertAlmostEqual(errors.fitted_order(sizes, values), 1.5)

    def test_no_order_without_error(self) -> None:
        self.assertTrue(math.isnan(errors.fitted_order([1, 2], [1.0, 0.0])))
        self.assertTrue(math.isnan(errors.observed_orders([1, 2], [1.0, 0.0])[1]))


class SceneTest(unittest.TestCase):
    def test_every_load_is_ramped(self) -> None:
        settings = study.ramped(ROOT / "scenes" / "paper.toml", 10.0)
        values = {key: tomllib.loads(f"value = {text}")["value"] for key, text in settings.items()}
        self.assertEqual(values["boundary.left.traction"][0], f"(1.4)*{study.RAMP}")
        self.assertEqual(
            sorted(values),
            [
                study.FOUNDATION,
                "boundary.left.traction",
                "boundary.right.traction",
                "heat.source",
                "load.body_force",
            ],
        )

    @unittest.skipUnless(DRIVER.is_file(), "the driver is not built")
    def test_the_error_falls(self) -> None:
        problem = runs.Problem(DRIVER, ROOT / "scenes" / "paper-isotropic.toml", {})
        for series in study.solve_all(
            problem, study.AS_STATED, study.MODES, [2, 4, 8], 16, lambda text: None
        ):
            found = [series.against_reference[n].peak().error for n in series.sizes]
            self.assertEqual(sorted(found, reverse=True), found, series.mode)
            self.assertEqual(sorted(series.against_doubled), [2, 4, 8])


if __name__ == "__main__":
    unittest.main()
