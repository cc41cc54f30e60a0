"""What plans are judged by: references made coarser, outcomes, and what a plan says.

Run from verification/: python3 -m unittest tests.test_plan.
"""

import unittest

from plan_check import foreseen_by, outcome_of
from plan_parts.calls import Settings
from plan_parts.references import REFERENCES, SIDES, TIGHTER, Fine, Judged, finer_than

TOLD = """asked     accuracy 0.01, of norms (strain) at T/8, T/4, ..., T
chosen    error 0.006 in 2.2 min: 8500 unknowns of degree 2, backward-euler, 140352 steps
cheaper   error 0.019 in 11 s: 590 unknowns of degree 2, backward-euler, 49216 steps
"""


class OutcomeTest(unittest.TestCase):
    def test_of_an_error_and_what_the_reference_leaves_open(self) -> None:
        for error, bound, expected in (
            (0.06, 0.01, "surely met"),
            (0.06, 0.05, "met"),
            (0.09, 0.02, "met"),
            (0.12, 0.03, "met"),
            (0.12, 0.01, "missed"),
            (0.02, 0.005, "accurate"),
            (0.02, 0.02, "met"),
        ):
            judged = Judged(error, error - bound, error + bound)
            self.assertEqual(outcome_of(judged, 0.1 / 3, 0.1), expected, (error, bound))

    def test_bound_is_the_larger_side(self) -> None:
        self.assertAlmostEqual(Judged(0.05, 0.04, 0.08).bound, 0.03)

    def test_what_a_plan_chooses(self) -> None:
        self.assertEqual(foreseen_by(TOLD), (0.006, 132.0))
        self.assertIsNone(foreseen_by("refused   an error of 0.001 cannot be promised"))


class ReferenceTest(unittest.TestCase):
    def test_coarser_ones_are_nested_and_have_all_instants(self) -> None:
        for name, fine in REFERENCES.items():
            for by in (2, 4):
                coarse = fine.coarser_in_space(by)
                self.assertEqual(tuple(by * count for count in coarse.cells), fine.cells, name)
                self.assertEqual(coarse.grading, fine.grading)
            for level in (0, 1, 2):
                self.assertEqual(fine.coarser_in_time(level).steps % 8, 0, name)
            self.assertIn(len(fine.grading), (0, 2 * len(fine.cells)), name)

    def test_of_another_scene_it_is_finer_than_the_run(self) -> None:
        words = ["mesh.cells=[1,12]", "space.degree=1", 'time.scheme="backward-euler"', "time.step=0.25"]
        fine = finer_than(Settings(words, 8), 4)
        self.assertEqual((fine.cells, fine.scheme, fine.steps, fine.end), ((1, 48), "bdf2", 32, 2.0))
        self.assertIn("time.step=0.0625", fine.settings().words)
        words = ["mesh.cells=[8,8]", *(f"mesh.grading.{side}=4" for side in SIDES[:4])]
        words += ['time.scheme="generalized-alpha"', "time.tolerance=0.064", "time.steps=16"]
        fine = finer_than(Settings(words, 16), 2)
        self.assertEqual(fine.grading, (4.0, 4.0, 4.0, 4.0))
        self.assertAlmostEqual(fine.tolerance or 0.0, 0.001)
        self.assertAlmostEqual((fine.coarser_in_time(1).tolerance or 0.0) / (fine.tolerance or 1.0), TIGHTER)
        self.assertIn('mesh.cell="tensor"', fine.settings().words)

    def test_an_axis_with_one_cell_keeps_it(self) -> None:
        self.assertEqual(Fine((1, 64), "bdf2", 8).coarser_in_space(2).cells, (1, 32))


if __name__ == "__main__":
    unittest.main()
