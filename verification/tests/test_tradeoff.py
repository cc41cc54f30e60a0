"""The trade study: bounds, front and prices on points whose answer is known; a small study whose parts must fit together.

Run from verification/: python3 -m unittest tests.test_tradeoff. Where the driver (THERMOCONTACT_DRIVER names it) is
built, small studies are run.
"""

import contextlib
import csv
import dataclasses
import io
import tempfile
import unittest
from pathlib import Path
from typing import Any

import tradeoff
from tradeoff_parts.bounds import LEAST, bound
from tradeoff_parts.choice import SOURCES, Coupling, Quadrature, Regularisation, Time
from tradeoff_parts.facts import Facts, absent, hindrances
from tradeoff_parts.measure import Error, Point, chain
from tradeoff_parts.plan import EXACT, Configuration, Knob, Plan, as_it_is, knobs
from tradeoff_parts.prices import below_theory, front, prices
from tradeoff_parts.runs import Seconds
from tradeoff_parts.tables import price_line
from under_test import DRIVER, ROOT


FACTS = Facts(
    name="synthetic",
    dimension=2,
    cells=(8, 8),
    degree=1,
    scheme="backward-euler",
    steps=8,
    end=1.0,
    outputs=8,
    states_step=False,
    regularisation={"bottom": 1e-3},
    exact=False,
    may_be_exact=True,
    contacts=("bottom",),
    fields=("displacement", "velocity", "temperature"),
    coupled=True,
    iterated=None,
    solver_tolerance=1e-12,
    strategy="auto",
    factor="auto",
    schemes=("backward-euler", "bdf2", "midpoint"),
    graded=True,
)


def point(
    error: float, seconds: float, margin: float = 10.0, knob: str = "mesh", value: float = 1.0
) -> Point:
    """Its own error of space is half of it, of w a quarter."""
    of = Configuration(knob, value, as_it_is(FACTS))
    parts = {"space": Error((error / 4, error / 2, error / 2))}
    return Point(of, Error((error / 2, error, error)), parts, Seconds(0.0, 0.0, seconds, 3), margin)


class BoundTest(unittest.TestCase):
    """Errors C s^q, at s = 1, r, r^2 from the reference on: the distances, and what is left of the error at s = 1."""

    def bound(self, order: float, theory: float, *ratios: float) -> tuple[float, float, bool]:
        left = 0.01
        errors = [left * ratio**order for ratio in (1.0, *ratios)]
        found = bound("space", ratios, theory, [b - a for a, b in zip(errors, errors[1:])])
        return found.value, left, found.sure

    def test_is_exact_for_a_power(self) -> None:
        for order, *ratios in (
            (1.0, 2.0, 4.0),
            (0.7, 2.0, 4.0),
            (0.5, 10.0, 100.0),
            (2.0, 2.0, 4.0),
            (1.3, 1.5, 3.0),
        ):
            value, left, sure = self.bound(order, 2.0, *ratios)
            self.assertAlmostEqual(value, left, delta=1e-12)
            self.assertTrue(sure)

    def test_order_beyond_theory_is_not_trusted(self) -> None:
        value, left, _ = self.bound(3.0, 2.0, 2.0, 4.0)
        self.assertAlmostEqual(value / left, 7 / 3, delta=1e-12)

    def test_theory_where_there_is_one_distance(self) -> None:
        self.assertAlmostEqual(bound("quadrature", [5 / 3], 1.0, [0.02]).value, 0.03)

    def test_differences_that_do_not_fall_are_said(self) -> None:
        found = bound("time", [2.0, 4.0], 2.0, [1e-3, 1e-3])
        self.assertFalse(found.sure)
        self.assertAlmostEqual(found.value, 1e-3 / (2**LEAST - 1))
        self.assertIn("hardly fall", found.text())

    def test_round_off_is_its_own_bound(self) -> None:
        self.assertEqual(bound("solver", [100.0], 1.0, [1e-13]).value, 1e-13)


class FrontTest(unittest.TestCase):
    def test_front(self) -> None:
        a, b, c = point(1e-1, 1.0), point(1e-2, 2.0), point(1e-3, 8.0)
        beaten = [point(2e-1, 1.5), point(1e-2, 2.5), point(5e-3, 9.0)]
        near = point(1e-4, 3.0, margin=0.9)
        self.assertEqual(front([c, *beaten, near, a, b]), [a, b, c])

    def test_of_two_as_fast_the_better_one(self) -> None:
        worse, better = point(1e-1, 1.0), point(5e-2, 1.0)
        self.assertEqual(front([worse, better]), [better])


class PriceTest(unittest.TestCase):
    def test_order_and_price_of_a_power(self) -> None:
        """Errors h^2, time h^-3: a digit is a factor sqrt(10) in h, 10^(3/2) in time."""
        points = [point(h**2, h**-3, value=h) for h in (1.0, 0.5, 0.25, 0.125)]
        (found,) = prices(points, {"mesh": Knob("space", (3.0, 2.0, 2.0))}, {"space": 1e-9})
        self.assertEqual(found.points, 3)
        for order in found.orders:
            self.assertIsNotNone(order)
            self.assertAlmostEqual(order or 0.0, 2.0)
        self.assertAlmostEqual(found.factor or 0.0, 10**1.5)
        self.assertEqual(below_theory(found, Knob("space", (3.0, 2.0, 2.0))), ["w"])

    def test_what_moves_nothing_buys_nothing(self) -> None:
        points = [point(1e-2, 1.0, value=1.0), point(0.99e-2, 5.0, value=0.5)]
        (found,) = prices(points, {"mesh": Knob("space")}, {})
        self.assertIsNone(found.factor)

    def test_errors_near_the_references_own_are_left_out(self) -> None:
        points = [point(h**2, h**-3, value=h) for h in (1.0, 0.5, 0.25, 0.125)]
        self.assertEqual(prices(points, {"mesh": Knob("space")}, {"space": 0.2}), [])

    def test_two_ways_to_one_solution_have_a_price_in_time(self) -> None:
        ways = Knob("solver", ways=("double", "single"))
        points = [point(1e-2, seconds, value=value) for seconds, value in ((3.0, 2.0), (4.0, 1.0))]
        (found,) = prices(points, {"mesh": ways}, {})
        self.assertEqual((found.factor, found.seconds), (None, (4.0, 3.0)))
        self.assertIn("single takes 0.75 times the time of double", price_line(found, ways))
        self.assertEqual(prices(points[:1], {"mesh": ways}, {}), [])


class PlanTest(unittest.TestCase):
    def test_chain_ends_at_the_reference_one_source_at_a_time(self) -> None:
        best, own = Plan(FACTS).reference(), as_it_is(FACTS)
        links = chain(own, best)
        self.assertEqual((links[0], links[-1]), (own, best))
        for source, one, two in zip(SOURCES, links, links[1:]):
            self.assertEqual(dataclasses.replace(one, **{source: getattr(two, source)}), two)

    def test_reference_is_finest_in_all(self) -> None:
        plan = Plan(FACTS, grading=(1.0, 1.0, 1.0, 4.0))
        best = plan.reference()
        for of in plan.configurations():
            choice = of.choice
            assert choice.space.cells and best.space.cells
            self.assertLessEqual(choice.space.cells, best.space.cells)
            self.assertLessEqual(2 * choice.time.steps, best.time.steps)
            if of.knob != EXACT:
                self.assertGreaterEqual(choice.regularisation.factor, 10 * best.regularisation.factor)
            self.assertGreaterEqual(choice.solver.tolerance, best.solver.tolerance)

    def test_every_scheme_and_every_count_is_whole_outputs(self) -> None:
        chosen = list(Plan(FACTS).configurations())
        self.assertEqual({of.choice.time.scheme for of in chosen}, set(FACTS.schemes))
        self.assertTrue(all(of.choice.time.steps % FACTS.outputs == 0 for of in chosen))
        self.assertLessEqual({of.knob for of in chosen}, set(knobs(FACTS)))

    def test_settings(self) -> None:
        choice = Plan(FACTS, grading=(1.0, 1.0, 1.0, 4.0)).reference()
        settings = choice.settings(FACTS)
        self.assertEqual(settings["mesh.cells"], [16, 16])
        self.assertEqual(settings["mesh.grading.top"], 4.0)
        self.assertEqual(settings["boundary.bottom.contact.friction.regularisation"], 1e-5)
        stepping = dataclasses.replace(FACTS, states_step=True)
        self.assertEqual(Time("bdf2", 4).settings(stepping), {"time.scheme": "bdf2", "time.step": 0.25})
        bare = dataclasses.replace(FACTS, regularisation={}, contacts=(), coupled=False)
        for chosen in (Coupling(1e-3).settings, Regularisation(0.1).settings, Quadrature(9).settings):
            self.assertEqual(chosen(bare), {})

    def test_knobs_that_are_absent_are_said_and_not_turned(self) -> None:
        bare = dataclasses.replace(
            FACTS, regularisation={}, contacts=(), coupled=False, cells=None, dimension=0
        )
        said = " ".join(absent(bare))
        for what in (
            "mesh: the mesh is a file",
            "no contact",
            "no regularised friction",
            "not both momentum and heat",
        ):
            self.assertIn(what, said)
        turned = {of.knob for of in Plan(bare).configurations()}
        for knob in turned:
            self.assertFalse(knob.startswith(("mesh", "epsilon", "contact", "coupling", "lagged")), knob)
        self.assertNotIn("space", Plan(bare).coarser())
        self.assertEqual(Plan(bare).gradings(), [])
        self.assertEqual(Plan(dataclasses.replace(FACTS, graded=False)).gradings(), [])
        self.assertEqual(Plan(FACTS).gradings()[0], (1.0,) * 4)

    def test_coulombs_law_itself(self) -> None:
        """Has no rule above 4: neither where it is turned on, nor anywhere in a scene that has it."""
        turned = [of.choice for of in Plan(FACTS).configurations() if of.knob == EXACT]
        self.assertEqual([(of.regularisation.factor, of.quadrature.rule) for of in turned], [(0.0, 4)])
        self.assertNotIn(
            EXACT, {of.knob for of in Plan(dataclasses.replace(FACTS, may_be_exact=False)).configurations()}
        )
        plan = Plan(dataclasses.replace(FACTS, exact=True, regularisation={}))
        coarser = [choice for _, _, choices in plan.coarser().values() for choice in choices]
        for choice in [plan.reference(), *coarser, *(of.choice for of in plan.configurations())]:
            self.assertIn(choice.quadrature.rule, (None, 2, 4, "vertex"))

    def test_what_hinders_theory(self) -> None:
        resolved: dict[str, Any] = {
            "load": {"body_force": [0.0, -1.0]},
            "mesh": {"upper": [1, 1]},
            "boundary": {},
        }
        self.assertIn("at once", hindrances(resolved, [0.0])[0])
        smooth: dict[str, Any] = {
            "load": {"body_force": [0.0, "-t"]},
            "mesh": {"upper": [1, 1]},
            "boundary": {},
        }
        self.assertEqual(hindrances(smooth, [0.0, 0.0]), [])
        thrown = {**smooth, "initial": {"velocity": [0, -1]}}
        self.assertTrue(any("impact" in reason for reason in hindrances(thrown, [0.0, 1.0, 0.0])))


@unittest.skipUnless(DRIVER.is_file(), "the driver is not built")
class StudyTest(unittest.TestCase):
    def run_study(self, scene: str, *words: str) -> tuple[int, str, Path]:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = ROOT / "scenes" / f"{scene}.toml"
        said = io.StringIO()
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            code = tradeoff.main([str(path), "--output", folder.name, "--rounds", "1", "--small", *words])
        return code, said.getvalue(), Path(folder.name)

    def rows(self, folder: Path) -> tuple[list[dict[str, str]], dict[str, str]]:
        with (folder / "tradeoff.csv").open(encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        return [row for row in rows if row["status"] == "completed"], rows[-1]

    def test_small_study(self) -> None:
        words = ["--knob", "the", "--knob", "mesh, degree 1", "--knob", "step, b", "--knob", "epsilon"]
        small = ["--set", "mesh.cells=[8,8]", "--set", "time.steps=8"]
        code, said, folder = self.run_study("paper-isotropic", *words, *small)
        self.assertEqual(code, 0, said)
        points, last = self.rows(folder)
        own = float(last["error"])
        self.assertEqual(last["status"], "bound")
        self.assertGreater(own, 0.0)
        for row in points:
            parts = [float(row[f"own_{source}"]) for source in SOURCES if row[f"own_{source}"]]
            self.assertLessEqual(float(row["error"]), sum(parts) * (1 + 1e-9), row)
            self.assertEqual(row["told_from_reference"] == "True", float(row["error"]) > 3 * own)
        self.assertTrue(any(row["on_front"] == "True" for row in points))
        # the reference is better than all of them: so are the parts of each source than the bound of its own
        for source in ("time", "space", "regularisation"):
            finest = min(float(row[f"own_{source}"]) for row in points)
            self.assertLess(float(last[f"own_{source}"]), finest, source)
        meshes = [float(row["own_space"]) for row in points if row["knob"] == "mesh, degree 1"]
        self.assertEqual(meshes, sorted(meshes, reverse=True))
        self.assertGreater((folder / "tradeoff.png").stat().st_size, 10_000)
        self.assertTrue((folder / "prices.csv").read_text(encoding="utf-8").count("\n") > 3)

    def test_no_contact_and_no_heat(self) -> None:
        short = ("--set", "mesh.cells=[4,4]", "--set", "time.steps=4", "--knob", "the scene")
        code, said, _ = self.run_study("no-contact", *short)
        self.assertEqual(code, 0, said)
        self.assertIn("contact quadrature: the scene has no contact", said)
        code, said, _ = self.run_study("isothermal", *short)
        self.assertEqual(code, 0, said)
        self.assertIn("coupling: the scene has not both", said)

    def test_mesh_of_gmsh(self) -> None:
        code, said, folder = self.run_study("press-fit", "--set", "time.steps=2", "--knob", "step, backward")
        self.assertEqual(code, 0, said)
        self.assertIn("mesh: the mesh is a file", said)
        self.assertIn("space: not bounded", said)
        points, _ = self.rows(folder)
        self.assertTrue(points)

    def test_bad_input(self) -> None:
        for scene, words, expected in (
            ("nowhere", (), "nowhere.toml"),
            ("paper-isotropic", ("--set", "mesh.cells=[0,8]"), "mesh.cells"),
            ("paper-isotropic", ("--knob", "colour", "--set", "mesh.cells=[4,4]"), "expected one of"),
        ):
            with self.subTest(expected):
                code, said, _ = self.run_study(scene, *words)
                self.assertEqual(code, 2, said)
                self.assertIn(expected, said)

    def test_what_takes_too_long_is_said(self) -> None:
        """The first run takes milliseconds, the reference more than a tenth of a second."""
        code, said, _ = self.run_study("paper-isotropic", "--limit", "0.12", "--set", "mesh.cells=[8,8]")
        self.assertIn(code, (1, 2), said)
        self.assertIn("took longer than 0.12 s", said)
        self.assertNotIn("Traceback", said)


if __name__ == "__main__":
    unittest.main()
