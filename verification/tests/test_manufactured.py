"""Manufactured solutions: the arithmetic of the orders, derivatives in time, what the cases promise, their scenes.

Run from verification/: python3 -m unittest tests.test_manufactured
"""

import math
import tomllib
import unittest
from itertools import product
from typing import Any

import ufl

from manufactured_parts import cases, compiled, report, scenes
from manufactured_parts.expression import Printer
from manufactured_parts.scenes import CELLS, Cell, Resolution
from manufactured_parts.study import Curve

NAMES = {"sin": math.sin, "cos": math.cos, "exp": math.exp}


def value(text: str, x: float, y: float, t: float, z: float = 0.0) -> float:
    """Of a scene's expression."""
    return float(
        eval(text.replace("^", "**"), {"__builtins__": {}}, NAMES | {"x": x, "y": y, "z": z, "t": t})
    )


def curve(errors: list[float], theory: int) -> Curve:
    return Curve("space", "heat", "triangle", 1, "backward-euler", "temperature", (4, 8, 16), errors, theory)


class OrderTest(unittest.TestCase):
    def test_orders(self) -> None:
        self.assertEqual(curve([1.0, 0.25, 0.0625], 2).orders, [2.0, 2.0])
        self.assertTrue(curve([1.0, 0.25, 0.0625], 2).passes)

    def test_one_order_off_fails(self) -> None:
        self.assertFalse(curve([1.0, 0.25, 0.0625], 3).passes)
        self.assertFalse(curve([1.0, 0.25, 0.07], 2).passes)

    def test_summary(self) -> None:
        table = report.summary([curve([1.0, 0.25, 0.0625], 2), curve([1.0, 0.26, 0.0625], 2)])
        self.assertIn("| triangle | h, degree 1 | 1.94 – 2.06 |", table)

    def test_no_error_at_all_fails(self) -> None:
        self.assertFalse(curve([1.0, 0.25, 0.0], 2).passes)


class PrinterTest(unittest.TestCase):
    def test_value(self) -> None:
        printer = Printer("triangle", 2)
        x, t = printer.x, printer.t
        field = (0.5 - ufl.sin(t) * x[1] ** 2) / (2 + ufl.exp(-x[0])) - 3 * t
        exact = (0.5 - math.sin(0.7) * 0.09) / (2 + math.exp(-0.2)) - 2.1
        self.assertAlmostEqual(value(printer.text(field), 0.2, 0.3, 0.7), exact, delta=1e-15)

    def test_rate(self) -> None:
        printer = Printer("triangle", 2)
        for study in cases.STUDIES:
            u = cases.displacement(study, printer.x, printer.t, 2)
            first, second = printer.rate(u), printer.rate(printer.rate(u))
            d = 1e-4
            for place, slope, curvature in zip(*map(printer.components, (u, first, second))):
                before, now, after = (value(place, 0.3, 0.6, t) for t in (0.5 - d, 0.5, 0.5 + d))
                self.assertAlmostEqual(value(slope, 0.3, 0.6, 0.5), (after - before) / (2 * d), delta=1e-8)
                exact = (after - 2 * now + before) / d**2
                self.assertAlmostEqual(value(curvature, 0.3, 0.6, 0.5), exact, delta=1e-6)

    def test_what_a_scene_cannot_say(self) -> None:
        printer = Printer("triangle", 2)
        with self.assertRaises(TypeError):
            printer.text(ufl.conditional(ufl.gt(printer.t, 0), printer.t, 0))


class CasesTest(unittest.TestCase):
    def test_nothing_moves_that_is_lagged(self) -> None:
        """The study in space: R : eps(w) = 0, and theta rests."""
        for d, cell in ((2, "triangle"), (3, "tetrahedron")):
            printer = Printer(cell, d)
            w = printer.components(printer.rate(cases.displacement("space", printer.x, printer.t, 1)))
            R, h, at = cases.STRAIN_HEATING(d), 1e-5, [0.3, 0.6, 0.2]
            total = 0.0
            for i in range(d):
                for j in range(d):
                    points = [[p + s * h * (j == k) for k, p in enumerate(at)] for s in (1, -1)]
                    ends = [value(w[i], x, y, 0.4, z) for x, y, z in points]
                    total += R[i][j] * (ends[0] - ends[1]) / (2 * h)
            self.assertAlmostEqual(total, 0.0, delta=1e-9)
            theta = cases.temperature("space", cases.CASES["coupled"], printer.x, printer.t, 1)
            self.assertNotIn("t", printer.text(theta).replace("sin", ""))

    def test_closed_and_slipping(self) -> None:
        for name in ("slipping", "rubbing"):
            self.check_closed_and_slipping(cases.CASES[name].contact)

    def check_closed_and_slipping(self, contact: cases.Contact | None) -> None:
        assert contact is not None
        grid = [i / 10 for i in range(11)]
        for cell, d in (("triangle", 2), ("tetrahedron", 3)):
            printer = Printer(cell, d)
            for study, degree in product(cases.STUDIES, (1, 2)):
                u = cases.displacement(study, printer.x, printer.t, degree)
                r = printer.text(-u[1] - cases.gap(contact, u, printer.t))
                belt = contact.velocity(printer.x, printer.t)[0] if contact.velocity else 0.0
                slip = printer.text(printer.rate(u)[0] - belt)
                for x, t, z in product(grid, grid, grid if d == 3 else [0.0]):
                    self.assertGreater(value(r, x, 0.0, t, z), contact.onset)
                    self.assertGreater(abs(value(slip, x, 0.0, t, z)), 3 * contact.regularisation)

    def test_opening_is_uniform(self) -> None:
        """-u_y - g is the given penetration on y = 0 wherever one looks."""
        contact = cases.CASES["opening"].contact
        assert contact is not None and contact.penetration is not None
        for cell, d in (("triangle", 2), ("tetrahedron", 3)):
            printer = Printer(cell, d)
            u = cases.displacement("space", printer.x, printer.t, 1)
            r = printer.text(-u[1] - cases.gap(contact, u, printer.t))
            for x, t, z in ((0.1, 0.2, 0.9), (0.8, 0.7, 0.3)):
                self.assertAlmostEqual(value(r, x, 0.0, t, z), contact.penetration(t), delta=1e-14)

    def test_every_case_has_a_body(self) -> None:
        bodies = {name: case.body for name, case in cases.CASES.items()}
        self.assertEqual(
            bodies,
            {**{n: n for n in bodies}, "slipping": "coupled", "opening": "coupled", "rubbing": "rated"},
        )

    def test_opens(self) -> None:
        contact = cases.CASES["opening"].contact
        assert contact is not None and contact.penetration is not None
        self.assertGreater(contact.penetration(0.0), 0)
        self.assertLess(contact.penetration(cases.END), 0)


class SceneTest(unittest.TestCase):
    def scene(self, cell: Cell, name: str) -> dict[str, Any]:
        return tomllib.loads(scenes.scene("space", name, Resolution(cell, 1, 4, 8, "backward-euler")))

    def test_physics(self) -> None:
        heat = self.scene(CELLS["triangle"], "heat")
        self.assertNotIn("material", heat)
        self.assertNotIn("thermal_stress", heat["heat"])
        self.assertNotIn("heat", self.scene(CELLS["triangle"], "mechanics"))
        laws = self.scene(CELLS["triangle"], "slipping")["boundary"]["bottom"]["contact"]
        self.assertEqual(laws["compliance"]["stiffness"], 20.0)

    def test_three_dimensions(self) -> None:
        solid = self.scene(CELLS["tetrahedron"], "opening")
        self.assertEqual(len(solid["initial"]["displacement"]), 3)
        self.assertIn("z", solid["initial"]["temperature"])
        self.assertEqual(solid["boundary"]["left"]["displacement"][1:], ["free", "free"])
        self.assertEqual(solid["boundary"]["front"]["displacement"][:2], ["free", "free"])
        self.assertNotIn("temperature", solid["boundary"]["front"])
        self.assertNotIn("front", self.scene(CELLS["quadrilateral"], "opening")["boundary"])
        self.assertEqual(self.scene(CELLS["hexahedron"], "opening")["mesh"]["cell"], "tensor")
        self.assertNotIn("plane", solid["material"]["elasticity"])


class CompiledTest(unittest.TestCase):
    def test_every_dimension_has_every_form(self) -> None:
        found = [self.forms(cell, d) for cell, d in ((ufl.triangle, 2), (ufl.tetrahedron, 3))]
        self.assertEqual(found[0], found[1])
        self.assertIn("opening_contact_traction", found[0])
        self.assertNotIn("coupled_contact_traction", found[0])
        self.assertEqual(sum(name.endswith("error_strain") for name in found[0]), 3)

    def forms(self, cell: Any, d: int) -> list[str]:
        try:
            element = ufl.VectorElement("Lagrange", cell, 1)
            scalar = ufl.FiniteElement("Lagrange", cell, 1)
        except AttributeError:
            self.skipTest("elements are named otherwise in this UFL")
        mesh = ufl.Mesh(element)
        V, Q = ufl.FunctionSpace(mesh, element), ufl.FunctionSpace(mesh, scalar)
        fields = [ufl.Coefficient(space) for space in (V, V, Q)]
        return sorted(compiled.forms("space", V, Q, mesh, ufl.Constant(mesh), *fields))


if __name__ == "__main__":
    unittest.main()
