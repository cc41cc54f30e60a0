"""The matrix's own rules: what it demands of the table of variations, its pairs, its measure of change.

Run from verification/: python3 -m unittest tests.test_matrix
"""

import tempfile
import tomllib
import unittest
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np

from matrix_parts import coverage, pairs
from matrix_parts.cases import Variation, vary
from matrix_parts.change import change
from matrix_parts.refusals import refusals
from matrix_parts.scenes import ABSENT, BASES, changed, write
from oracle_parts import vtu


def entry(key: str, kind: str, **others: Any) -> dict[str, Any]:
    """One key as the driver's schema lists it, with a default so that it need not be absent."""
    common = {"default": 1, "range": None, "choices": None, "required": False, "instead": None}
    return {"key": key, "type": kind, "excludes": [], "needs": [], "example": 1, **common, **others}


def table(variations: dict[str, list[Variation]], shape: str = "rectangle", **alike: str) -> coverage.Table:
    """`alike`: keys without their dots."""
    return coverage.Table(shape, variations, {key.replace("_", "."): reason for key, reason in alike.items()})


def gaps(schema: dict[str, Any], *variations: Variation) -> list[str]:
    """Without the name of the table at the end of each."""
    found = coverage.gaps([schema], [table({str(schema["key"]): list(variations)})], [])
    return [gap.removesuffix(" in the table of the rectangle") for gap in found]


class WhatIsDemanded(unittest.TestCase):
    def test_a_new_key_without_a_variation_is_named(self) -> None:
        found = coverage.gaps([entry("heat.new", "number")], [table({})], [])
        self.assertEqual(
            found, ["heat.new: in the schema, but no variation of it in the table of the rectangle"]
        )

    def test_each_shape_has_its_table(self) -> None:
        plane = table({"heat.new": vary("heat", "heat.new", 2.0)})
        schema = [entry("heat.new", "number")]
        self.assertEqual(coverage.gaps(schema, [plane], []), [])
        found = coverage.gaps(schema, [plane, table({}, "box")], [])
        self.assertEqual(found, ["heat.new: in the schema, but no variation of it in the table of the box"])
        self.assertEqual(coverage.gaps(schema, [plane, table({}, "box", heat_new="reason")], []), [])

    def test_a_key_that_is_alike_in_space_must_be_there_and_have_no_variation(self) -> None:
        found = coverage.gaps([], [table({}, "box", heat_old="reason")], [])
        self.assertEqual(found, ["heat.old: in the table of the box, but not in the schema"])
        both = table({"heat.new": vary("box heat", "heat.new", 2.0)}, "box", heat_new="reason")
        found = coverage.gaps([entry("heat.new", "number")], [both], [])
        self.assertEqual(found, ["heat.new: alike, but has variations in the table of the box"])

    def test_expressions_in_space_have_z(self) -> None:
        in_plane = table({"heat.source": vary("box heat", "heat.source", 1.0, "x*y*t")}, "box")
        found = coverage.gaps([entry("heat.source", "expression")], [in_plane], [])
        self.assertEqual(found, ["heat.source: no expression with z in it in the table of the box"])

    def test_a_variation_of_a_key_that_is_gone_is_named(self) -> None:
        found = coverage.gaps([], [table({"heat.old": vary("heat", "heat.old", 1.0)})], [])
        self.assertEqual(found, ["heat.old: in the table of the rectangle, but not in the schema"])

    def test_every_choice(self) -> None:
        cell = entry("mesh.cell", "choice", choices=["simplex", "tensor"], default="simplex")
        found = gaps(cell, *vary("heat", "mesh.cell", "simplex"))
        self.assertEqual(found, ["mesh.cell: no case with the value 'tensor'"])
        self.assertEqual(gaps(cell, *vary("heat", "mesh.cell", "simplex", "tensor")), [])

    def test_every_integer_of_a_small_range_and_the_low_end_of_a_large_one(self) -> None:
        limits = {"low": 1.0, "high": 3.0, "low_open": False, "high_open": False}
        degree = entry("space.degree", "integer", range=limits)
        found = gaps(degree, *vary("heat", "space.degree", 1, 2))
        self.assertEqual(found, ["space.degree: no case with the value 3"])
        steps = entry("time.steps", "integer", range={**limits, "high": 1e9})
        found = gaps(steps, *vary("heat", "time.steps", 2))
        self.assertEqual(found, ["time.steps: no case with the lower end of its range, 1"])

    def test_every_form_of_a_value_and_every_variable(self) -> None:
        source = entry("heat.source", "expression")
        found = gaps(source, *vary("heat", "heat.source", 1.0, "x*t"))
        self.assertEqual(found, ["heat.source: no expression with y in it"])
        tensor = entry("heat.conductivity", "symmetric tensor")
        found = gaps(tensor, *vary("heat", "heat.conductivity", 1.0))
        self.assertEqual(found, ["heat.conductivity: no case with a matrix that is not isotropic"])

    def test_a_type_that_nobody_thought_of_is_named(self) -> None:
        found = gaps(entry("heat.colour", "colour"), *vary("heat", "heat.colour", 1))
        self.assertEqual(len(found), 1)
        self.assertIn("'colour', whose forms coverage.py does not know", found[0])

    def test_what_may_be_absent_has_to_come_or_go(self) -> None:
        limit = entry("heat.capacity", "number", default=None)
        found = gaps(limit, *vary("heat", "heat.capacity", 3.0))
        self.assertEqual(len(found), 1)
        self.assertEqual(gaps(limit, *vary("heat", "heat.capacity", 3.0, ABSENT)), [])

    def test_every_side_of_every_shape(self) -> None:
        shape = entry("mesh.shape", "choice", choices=["rectangle", "box", "torus"])
        flux = entry("boundary.NAME.heat_flux", "number")
        tables, cases = [], []
        for name, base in (("rectangle", "contact left"), ("box", "box contact left")):
            fluxes = vary(base, "boundary.right.heat_flux", 1.0)
            tables.append(table({flux["key"]: fluxes, "mesh.shape": vary(base, "mesh.shape", name)}, name))
            cases += [variation.case(flux["key"]) for variation in fluxes]
        found = coverage.gaps([shape, flux], tables, cases)
        self.assertIn("mesh.shape: no table of the shape torus", found)
        self.assertIn("boundary.NAME.heat_flux: no case on the side top of a rectangle", found)
        self.assertIn("boundary.NAME.heat_flux: no case on the side back of a box", found)
        missing = [gap for gap in found if "side right" in gap or "side bottom" in gap]
        self.assertEqual(missing, [], "the bases load the bottom")


class Scenes(unittest.TestCase):
    def test_absent_takes_a_whole_table_and_what_is_set_beside_it_stays(self) -> None:
        scene = changed({"a.b.c": 1, "a.bc": 2}, {"a.b": ABSENT, "a.b.d": 3})
        self.assertEqual(scene, {"a.bc": 2, "a.b.d": 3})

    def test_scenes_are_written_as_toml(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "scene.toml"
            write(path, BASES["contact left"])
            scene = tomllib.loads(path.read_text(encoding="utf-8"))
        self.assertEqual(scene["boundary"]["left"]["contact"]["friction"]["regularisation"], 5e-3)
        self.assertEqual(scene["load"]["body_force"], [-1.0, 0.3])


class Pairs(unittest.TestCase):
    def test_every_legal_pair_is_met_and_no_row_is_illegal(self) -> None:
        rows = list(pairs.rows())
        self.assertTrue(all(pairs.legal(row) for row in rows))
        met = {frozenset(pair) for row in rows for pair in combinations(row.items(), 2)}
        self.assertEqual(set(pairs.all_pairs()) - met, set())
        self.assertLess(len(rows), 40)

    def test_the_rows_are_the_same_every_time(self) -> None:
        self.assertEqual(list(pairs.rows()), list(pairs.rows()))


class Refusals(unittest.TestCase):
    def test_vectors_of_the_plane_are_refused_in_space(self) -> None:
        force = entry("load.body_force", "d expressions", example=[0, 1])
        found = {refusal.key: refusal.scene for refusal in refusals([force]) if "space" in refusal.why}
        self.assertEqual(found["load.body_force"]["mesh.shape"], "box")
        self.assertEqual(len(found["load.body_force"]["load.body_force"]), 2)

    def test_a_scene_that_lacks_what_a_key_needs_has_no_other_mistake(self) -> None:
        needy = entry("load.body_force", "2 expressions", needs=["material"], example=[0, 1])
        other = entry("material.density", "number", needs=[])
        scene = next(r.scene for r in refusals([needy, other]) if r.why == "needs material")
        self.assertIn("load.body_force", scene)
        self.assertNotIn("material.density", scene)


class Change(unittest.TestCase):
    def result(self, folder: Path, values: list[float], norm: float, round_off: float = 0.0) -> Path:
        folder.mkdir()
        points = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
        data = {"temperature": np.array(values), "velocity": np.full(3, round_off)}
        vtu.write_grid(folder / "a.vtu", vtu.Grid(points, np.array([[0, 1, 2]]), vtu.TRIANGLE, data, {}))
        vtu.write_collection(folder / "fields.pvd", [vtu.DataSet(0.0, 0, "a.vtu")])
        summary = f'{{"final": {{"time": 1.0, "temperature_l2": {norm}, "contact": {{}}}}}}'
        (folder / "summary.json").write_text(summary, encoding="utf-8")
        return folder

    def test_the_largest_of_fields_and_norms(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            a = self.result(Path(name) / "a", [1.0, 2.0, 4.0], 2.0, round_off=1e-17)
            b = self.result(Path(name) / "b", [1.0, 3.0, 4.0], 2.0, round_off=-1e-17)
            c = self.result(Path(name) / "c", [1.0, 2.0, 4.0], 4.0)
            self.assertEqual(change(a, b), (0.25, "body temperature"))
            self.assertEqual(change(a, c), (0.5, "temperature_l2"))
            self.assertEqual(change(a, a)[0], 0.0)


if __name__ == "__main__":
    unittest.main()
