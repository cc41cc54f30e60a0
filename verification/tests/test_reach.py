"""Reach: what is judged from errors, at which times, and that a planted error is noticed.

Run from verification/: python3 -m unittest tests.test_reach
"""

import tempfile
import unittest
from pathlib import Path

import numpy as np

from lattice_errors import Array, Body, Solution
from reach_parts import report
from reach_parts.configurations import CORNERS, Configuration, graded, halved, looser, paper, plan, small_plan
from reach_parts.measure import (
    AtEnd,
    Errors,
    Point,
    Seconds,
    Study,
    at_times_of,
    best,
    bounds_of,
    reaches,
    thinned,
)
from tests.test_lattice_errors import REFINED, UNEQUAL, solution, triangles
from tradeoff_parts.bounds import bound


def point(name: str, norms: list[float], seconds: float) -> Point:
    """The second norm peaks earlier than the others."""
    errors = np.array([[0, 0, 0], [0, norms[1], 0], [norms[0], 0, norms[2]]])
    return Point(Configuration(name, {}, 64), errors, Seconds(seconds, seconds / 2, 2 * seconds))


def study(others: list[Point], resolved: float = 0.0) -> Study:
    of = small_plan()
    end = AtEnd(of.interactive[0], np.full(3, 0.02), np.full(3, 0.005), Seconds(0.1, 0.01, 0.2))
    names = ("velocity_l2", "displacement_strain_l2", "temperature_l2")
    bounds = {
        name: [bound(source, (2, 4), 1, (1e-3, 2e-3)) for source in ("space", "time")] for name in names
    }
    papers = {64: point("paper", [3.0, 2.0, 1.0], 4.0)}
    errors = Errors({64: 5.0}, [], [], np.ones(3), bounds, np.full(3, resolved))
    return Study(of, errors, papers, others, [end])


def moving(scale: float, times: list[float]) -> Solution:
    """theta = (2 + t) x + scale t."""
    mesh = triangles(UNEQUAL)
    frames = [
        {"temperature": (2 + t) * mesh.points[:, 0] + scale * t, "velocity": np.zeros((len(mesh.points), 3))}
        for t in times
    ]
    return Solution(mesh, times, frames)


class JudgedTest(unittest.TestCase):
    def test_all_three_norms_count(self) -> None:
        the_paper, none = point("paper", [3.0, 2.0, 1.0], 4.0), np.zeros(3)
        self.assertTrue(reaches(point("same", [3.0, 2.0, 1.0], 1.0), the_paper, none))
        for worse in ([3.1, 0, 0], [0, 2.1, 0], [0, 0, 1.1]):
            self.assertFalse(reaches(point("worse", worse, 1.0), the_paper, none))

    def test_the_fastest_of_those_that_reach_it(self) -> None:
        slow, fast, rough = (
            point("slow", [1, 1, 0.5], 2.0),
            point("fast", [1, 1, 0.9], 0.2),
            point("rough", [9, 1, 1], 0.1),
        )
        self.assertIs(best(study([slow, fast, rough]), 64), fast)
        self.assertIs(best(study([slow, fast, rough], 0.1), 64, sure=True), slow)  # 0.9 + 0.1 > 1 - 0.1
        self.assertIsNone(best(study([rough]), 64))

    def test_said_as_it_is(self) -> None:
        said = "\n".join(report.verdicts(study([point("fast", [1, 1, 0.5], 0.25)])))
        self.assertIn("1/64: fast: 16.0 times faster; 20 times not reached", said)
        said = "\n".join(report.verdicts(study([point("faster", [1, 1, 0.5], 0.2)])))
        self.assertIn("1/64: faster: 20.0 times faster; 20 times reached", said)
        self.assertIn("error to 1% at T: none of those tried", said)
        self.assertIn("norms to 1% at T: Q2 8 x 6", said)

    def test_written_and_drawn(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            found = study([point("fast", [1, 1, 0.5], 0.25)], 1e-3)
            report.write(found, Path(name))
            report.draw(found, Path(name), small=True)
            rows = (Path(name) / "reach.csv").read_text(encoding="ascii").splitlines()
            self.assertEqual(len(rows), 3)
            self.assertIn("16.0", (Path(name) / "reach.md").read_text(encoding="utf-8"))
            self.assertTrue((Path(name) / "reach.png").is_file())


class ErrorsTest(unittest.TestCase):
    """The body of UNEQUAL has width and height 1."""

    def test_planted_error_is_found_at_its_time(self) -> None:
        whole = moving(0.0, [0.0, 0.25, 0.5, 0.75, 1.0])
        planted = moving(3.0, [0.0, 0.5, 1.0])
        found = Body(whole.mesh).norms(planted, at_times_of(whole, planted))
        np.testing.assert_allclose(found[:, 2], [0.0, 1.5, 3.0], rtol=1e-12)
        np.testing.assert_array_equal(found[:, :2], 0.0)

    def test_times_that_the_reference_lacks(self) -> None:
        with self.assertRaisesRegex(ValueError, "does not have"):
            at_times_of(moving(0.0, [0.0, 0.5, 1.0]), moving(0.0, [0.0, 0.4, 1.0]))

    def test_common_times(self) -> None:
        self.assertEqual(thinned(moving(0.0, [0.0, 0.25, 0.5, 0.75, 1.0]), 2).times, [0.0, 0.5, 1.0])

    def test_bound_holds_for_errors_of_known_order(self) -> None:
        """theta off by 3 s^2, s = 1, 2, 4: differences 9 and 36 times s^2, order 2, taken as 1: D1 / (2 - 1)."""
        links = [
            solution(triangles(lines), lambda x, y, s=s: 0 * x + 3 * s**2, lambda x, y: [0 * x, 0 * y])
            for s, lines in ((1, REFINED), (2, UNEQUAL), (4, UNEQUAL))
        ]
        found: Array = np.array([of.value for of in bounds_of(Body(links[0].mesh), links, "space", 2.0, 1.0)])
        np.testing.assert_allclose(found[2], 9.0, rtol=1e-12)
        self.assertGreaterEqual(found[2], 3.0)  # what the finest is off


class PlanTest(unittest.TestCase):
    def test_the_model_is_the_scenes(self) -> None:
        for of in (plan(), small_plan()):
            single = [of.reference, *of.others, *of.interactive, *of.paper.values()]
            for configuration in [*single, *of.coarser_in_space, *of.coarser_in_time]:
                for key in configuration.settings:
                    self.assertIn(key.split(".")[0], ("mesh", "space", "time", "solver"), configuration.name)

    def test_all_step_through_the_common_times(self) -> None:
        for of in (plan(), small_plan()):
            for configuration in [of.reference, *of.others, *of.paper.values()]:
                self.assertEqual(configuration.steps % of.outputs, 0, configuration.name)
            self.assertEqual(min(of.paper), of.outputs)

    def test_the_papers_is_the_papers(self) -> None:
        self.assertEqual((paper(128).settings, paper(128).steps), ({"mesh.cells": [128, 128]}, 128))

    def test_coarser_ones_differ_in_one_thing(self) -> None:
        fine = graded((16, 12), CORNERS, 32, scheme="bdf2", tolerance=1e-3)
        mesh, time = halved(fine, 2).settings, looser(fine, 10).settings
        self.assertEqual({**mesh, "mesh.cells": [16, 12]}, fine.settings)
        self.assertEqual({**time, "time.tolerance": 1e-3}, fine.settings)


if __name__ == "__main__":
    unittest.main()
