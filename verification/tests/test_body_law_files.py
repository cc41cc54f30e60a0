"""Law files of the body: elasticity and viscosity, heat source and body force. What they must be, and what they do.

Run from verification/: python3 -m unittest tests.test_body_law_files (THERMOCONTACT_DRIVER names the driver)
"""

import json
import re
import unittest
from pathlib import Path

import compare

from tests.with_law_files import SCENES, WithLawFiles

SCENE = """
[forms]
{forms}
[mesh]
cells = [4, 3]
[time]
end = 0.2
steps = 2
[material]
density = 1.0
{elasticity}
{viscosity}
[heat]
capacity = 1.0
conductivity = 1.0
thermal_stress = 0.5
{source}
[load]
{force}
[boundary.top]
displacement = ["0.1*t", "-0.2*t"]
temperature = 1.0
[boundary.bottom.contact]
compliance = {{stiffness = 100.0}}
friction = {{coefficient = 0.3, regularisation = 1e-2}}
"""
TABLES = {
    "elasticity": "elasticity = {young = 10.0, poisson = 0.2}",
    "viscosity": "viscosity = {trace = 0.5, shear = 0.7}",
    "source": "source = 2.0",
    "force": "body_force = [0.5, -1.0]",
}
HEAD = "from law import parameter\nfrom ufl import *\n"
E = 'E = parameter("modulus", unit="Pa", example=2.0, meaning="E")\n'
STIFF = HEAD + E + "def stress(strain, x):\n    return E * (1 + x[1]) * strain\n"
OF_BODY = {
    "elasticity": 'young = 7e10\npoisson = 0.33\nplane = "strain"\nfibres = 5e10\nangle = 20.0',
    "viscosity": "shear = 2e9\ngrowth = 1e13\nstart = 0.02",
    "source": "power = 1e3, radius = 0.01, depth = 0.01, surface = 0.03, speed = 0.02",
}
# Both solve for the same operators but for round-off of their entries; the matrices' condition numbers are below 1e3
ROUND_OFF = "1e-11"


class BodyLawFiles(WithLawFiles):
    def scene(self, kind: str, text: str, table: str, **tables: str) -> Path:
        (self.folder / "mine.py").write_text(text)
        path = self.folder / "scene.toml"
        place = {"body_force": "force"}.get(kind, kind)
        values = {**TABLES, place: f"{kind} = {{{table}}}", **tables}
        path.write_text(SCENE.format(forms=f'{kind} = "mine.py"', **values))
        return path

    def law(self, body: str, numbers: str = "modulus = 2.0") -> Path:
        return self.scene("elasticity", HEAD + E + body, numbers)

    def refused_on_mesh(self, scene: Path, *expected: str) -> None:
        """Once the folder of the results is claimed: it stays, and has no results in it."""
        code, _, errors = self.call("run", scene, "--output", self.folder / "claimed")
        self.assertEqual(code, 2, errors)
        for words in expected:
            self.assertIn(words, errors)
        for name in ("summary.json", "checkpoint.h5", "steps.csv", "fields"):
            self.assertFalse((self.folder / "claimed" / name).exists(), name)

    # What cannot be a law

    def test_what_the_file_says_is_refused_with_its_line(self) -> None:
        where = "scene.toml:3: forms.elasticity: "
        for body, *expected in (
            (
                "def stress(strain):\n    return E * inner(strain, strain) * strain\n",
                "mine.py:4: ",
                "is not linear in strain",
            ),
            (
                "def stress(strain):\n    return conditional(gt(tr(strain), 0), E, 2 * E) * strain\n",
                "mine.py:4: ",
                "not linear",
            ),
            (
                "def stress(strain):\n    return E * (strain + Identity(strain.ufl_shape[0]))\n",
                "mine.py:4: ",
                "is not zero where",
            ),
            (
                "def stress(strain):\n    return E * tr(strain)\n",
                "mine.py:4: ",
                "stress is not",
                "x",
                "it has a scalar",
            ),
            ("def stress(strain):\n    return E * as_matrix([[1, 0], [0, 1]])\n", "mine.py:4: ", "stress"),
            ("def stress(x):\n    return E * x[0]\n", "mine.py:4: ", "stress does not take strain"),
            (
                "def stress(strain, t):\n    return E * t * strain\n",
                "mine.py:4: ",
                "takes 't'; expected some of strain, x",
            ),
            ("def stress(strain):\n    return E * strian\n", "mine.py:5: ", "NameError: name 'strian'"),
            (
                "def strain(strain):\n    return E * strain\n",
                "mine.py: ",
                "defines no function stress(strain, x)",
            ),
            (
                "def stress(strain):\n    N = as_matrix([[0, 1, 0], [0, 0, 0], [0, 0, 0]])\n"
                "    n = strain.ufl_shape[0]\n"
                "    N = as_matrix([[1 if (i, j) == (0, 1) else 0 for j in range(n)] for i in range(n)])\n"
                "    return E * (strain + tr(strain) * N)\n",
                "mine.py:4: ",
                "is no symmetric tensor: stress[1, 0] differs from [0, 1]",
            ),
        ):
            with self.subTest(expected=expected):
                self.refused(self.law(body), where, *expected)

    def test_what_it_is_on_the_mesh_is_refused(self) -> None:
        for body, *expected in (
            (
                "def stress(strain):\n    n = strain.ufl_shape[0]\n"
                "    return E * strain + strain[0, 0] * as_matrix([[0] * n] + [[0, 1] + [0] * (n - 2)] + [[0] * n] * (n - 2))\n",
                "is not symmetric: ",
            ),
            (
                "def stress(strain, x):\n    return E * (0.5 - x[0]) * strain\n",
                "is not positive semidefinite",
                "around (0.",
            ),
            (
                "def stress(strain, x):\n    return E * ln(x[0] - 0.5) * strain\n",
                "is not finite, in the cell around",
            ),
        ):
            with self.subTest(expected=expected):
                scene = self.law(body)
                self.refused_on_mesh(scene, "mine.py:4: stress ", *expected)
                code, _, errors = self.call("check", scene)
                self.assertEqual(code, 2, errors)
                self.assertIn(expected[0], errors)
        self.refused_on_mesh(
            self.law("def stress(strain):\n    return E * strain\n", "modulus = -1.0"),
            "positive semidefinite",
        )

    def test_several_processes_refuse_with_one_message(self) -> None:
        """Only one of them has the cells where the law is wrong."""
        scene = self.law("def stress(strain, x):\n    return E * (0.9 - x[0]) * strain\n")
        words = ["--set", 'solver.strategy="newton-krylov"', "--set", "mesh.cells=[8, 3]"]
        code, _, errors = self.call("run", scene, "--output", self.folder / "none", *words, processes=2)
        self.assertEqual(code, 2, errors)
        self.assertEqual(errors.count("not positive semidefinite"), 1, errors)

    def test_bodies_that_a_law_is_not_of(self) -> None:
        """Plane stress, plane strain with a stress that leaves the plane, space."""
        solid = "def stress(strain):\n    return E * (strain + strain[2, 2] * Identity(3))\n"
        self.refused(self.law(solid), "mine.py:5: ", "(the body: plane stress)")
        self.run_scene(self.law(solid, 'modulus = 2.0, plane = "strain"'), "strain")
        leaves = (
            "def stress(strain, x):\n    a = as_vector([1, 0, 1][:strain.ufl_shape[0]])\n"
            "    return E * (strain + inner(strain, outer(a, a)) * outer(a, a))\n"
        )
        scene = self.law(leaves, 'modulus = 2.0, plane = "strain"')
        self.refused_on_mesh(scene, "mine.py:4: stress has components yz or xz")

    def test_laws_that_nothing_is_made_of(self) -> None:
        for kind, text, place in (
            ("source", HEAD + "def source(x, t):\n    return x[0]\n", "[heat.source]"),
            ("body_force", HEAD + "def force(x, t):\n    return x\n", "[load.body_force]"),
        ):
            scene = self.scene(kind, text, "", **{"source": "", "force": ""})
            self.refused(scene, f"forms.{kind}: the scene has no {place}")
        for text, *expected in (
            (
                "def source(x, theta):\n    return theta\n",
                "mine.py:3: source takes 'theta'; expected some of x, t",
            ),
            ("def source(x, t):\n    return x\n", "source is not scalar: it has"),
            ("def source(x, t):\n    return SpatialCoordinate(triangle)[0]\n", "mine.py:3: source contains"),
        ):
            self.refused(self.scene("source", HEAD + text, ""), "forms.source: ", *expected)
        scene = self.scene("body_force", HEAD + "def force(x, t):\n    return (0, 0, t)\n", "")
        self.refused(scene, "mine.py:3: force is not 2: it has 3 (the body: plane stress)")

    # What its parameters are

    def test_parameters_are_keys_of_the_body_and_of_regions(self) -> None:
        scene = self.scene("elasticity", STIFF, "modulus = 3.0")
        code, output, errors = self.call("schema", "--scene", scene, "--format", "json")
        self.assertEqual(code, 0, errors)
        keys = {entry["key"]: entry for entry in json.loads(output)}
        for gone in ("young", "poisson", "tensor"):
            self.assertNotIn(f"material.elasticity.{gone}", keys)
            self.assertNotIn(f"region.NAME.material.elasticity.{gone}", keys)
        self.assertTrue(keys["material.elasticity.modulus"]["required"])
        self.assertFalse(keys["region.NAME.material.elasticity.modulus"]["required"])
        self.assertIsNone(keys["material.elasticity.plane"]["instead"])
        summary = json.loads((self.run_scene(scene, "results") / "summary.json").read_text())
        self.assertEqual(summary["scene"]["material"]["elasticity"], {"modulus": 3.0, "plane": "stress"})
        self.assertIn("elasticity", summary["physics"])
        self.refused(
            self.scene("elasticity", STIFF, ""), "material.elasticity.modulus: missing; add modulus = 2.0"
        )
        self.refused(self.scene("elasticity", STIFF, "young = 1.0"), "material.elasticity.young: unknown key")
        taken = STIFF.replace('"modulus"', '"plane"')
        self.refused(self.scene("elasticity", taken, ""), "the parameter plane has the name of a key")

    # What it does

    def test_a_copy_of_a_built_in_law_changes_nothing(self) -> None:
        for kind in ("elasticity", "viscosity"):
            code, text, _ = self.call("forms", kind)
            self.assertEqual(code, 0)
            for plane in ("stress", "strain"):
                numbers = {name: line.partition("{")[2][:-1] for name, line in TABLES.items()}
                elasticity = f'{numbers["elasticity"]}, plane = "{plane}"'
                own = {"elasticity": elasticity, "viscosity": numbers["viscosity"]}
                tables = {"elasticity": f"elasticity = {{{elasticity}}}"} if kind == "viscosity" else {}
                self.started.write_text("")
                plain = self.run_scene(self.scene(kind, text, own[kind], **tables), f"{kind} {plane} copied")
                self.assertEqual(self.starts(), 0, "the built-in law itself needs no Python")
                scene = self.scene(kind, text + "# my own\n", own[kind], **tables)
                changed = self.run_scene(scene, f"{kind} {plane} own")
                self.assertGreater(self.starts(), 0)
                self.assert_close(plain, changed, ROUND_OFF)

    def test_loads_that_the_space_holds_are_those_of_expressions(self) -> None:
        """Linear in the place: interpolated in the space they are themselves, and both rules are exact."""
        laws = {
            "source": ("def source(x, t):\n    return (1 + x[0] - 2 * x[1]) * (3 + 5 * t * t)\n", "source"),
            "body_force": ("def force(x, t):\n    return (x[1] * t * t, -2 + x[0] * t)\n", "force"),
        }
        keys = {
            "source": 'source = "(1 + x - 2*y)*(3 + 5*t*t)"',
            "force": 'body_force = ["y*t*t", "-2 + x*t"]',
        }
        for scheme in ("backward-euler", "bdf2", "midpoint", "generalized-alpha"):
            for kind, (law, place) in laws.items():
                for degree in (1, 2):
                    words = ["--set", f'time.scheme="{scheme}"', "--set", f"space.degree={degree}"]
                    own = self.run_scene(
                        self.scene(kind, HEAD + law, ""), f"{kind} {scheme} {degree}", *words
                    )
                    plain = self.folder / "plain.toml"
                    plain.write_text(SCENE.format(forms="", **{**TABLES, place: keys[place]}))
                    key = self.run_scene(plain, f"key {kind} {scheme} {degree}", *words)
                    self.assert_close(own, key, ROUND_OFF)

    def test_a_source_that_is_not_finite(self) -> None:
        scene = self.scene("source", HEAD + "def source(x, t):\n    return ln(0.15 - t)\n", "")
        code, _, errors = self.call("run", scene, "--output", self.folder / "results")
        self.assertEqual(code, 3, errors)
        self.assertIn("mine.py:3: no finite number at t = ", errors)
        code, output, errors = self.call("check", scene)
        self.assertEqual(code, 0, errors)
        self.assertRegex(output, r"FAILS +\(H6 i\).*mine\.py:3: no finite number at t = ")

    def test_the_hypotheses_are_judged_at_the_points(self) -> None:
        """E (1 + y) e has the eigenvalue E (1 + y), y between the outermost points of the rule in [0, 1]."""
        code, output, errors = self.call("check", self.scene("elasticity", STIFF, "modulus = 2.0"))
        self.assertEqual(code, 0, errors)
        found = re.search(r"holds +\(H2 i\).*m_a = (\S+)", output)
        largest = re.search(r"\(H2 ii\).*M_a = (\S+)", output)
        assert found and largest
        self.assertTrue(2.0 < float(found[1]) < 2.0 + 2.0 / 3 / 4, output)
        self.assertTrue(4.0 - 2.0 / 3 / 4 < float(largest[1]) < 4.0, output)
        self.assertIn("elasticity of a law file symmetric and linear", output)
        source = self.scene("source", HEAD + "def source(x, t):\n    return -7 * t\n", "")
        self.assertRegex(self.call("check", source)[1], r"\(H6 i\).*max \|q0\| = 1\.4\b")

    def test_a_restart_goes_on_with_the_same_law_only(self) -> None:
        scene = self.scene("source", HEAD + "def source(x, t):\n    return 3 * t * x[0]\n", "")
        half = ["--set", "time.end=0.1", "--set", "time.steps=1"]
        checkpoint = self.run_scene(scene, "half", *half) / "checkpoint.h5"
        longer = self.run_scene(scene, "longer", "--restart", checkpoint)
        whole = self.run_scene(scene, "whole")
        last = [max((path / "fields").glob("body_*.vtu")).read_bytes() for path in (longer, whole)]
        self.assertEqual(*last)
        (self.folder / "mine.py").write_text(HEAD + "def source(x, t):\n    return 4 * t * x[0]\n")
        code, _, errors = self.call("run", scene, "--restart", checkpoint, "--output", self.folder / "none")
        self.assertEqual(code, 2, errors)
        self.assertIn("forms.source", errors)

    def test_regions_have_numbers_of_their_own(self) -> None:
        """Each of them over the body's: the oracle agrees, and no result is that of one material."""
        laws = {"elasticity": "fibres", "viscosity": "absorber", "source": "laser-spot"}
        files = "".join(f'{kind} = "{SCENES}/laws/{file}.py"\n' for kind, file in laws.items())
        text = (SCENES / "press-fit.toml").read_text()
        for old, new in (
            ("[mesh]", f"[forms]\n{files}[mesh]"),
            ("meshes/", f"{SCENES}/meshes/"),
            ('young = 7e10\npoisson = 0.33\nplane = "strain"', OF_BODY["elasticity"]),
            ("trace = 1e9\nshear = 2e9", OF_BODY["viscosity"]),
            ("source = 0.0", f'source = {{{OF_BODY["source"]}}}'),
            (
                'elasticity = {young = 1.1e11, poisson = 0.34, plane = "strain"}',
                "elasticity = {fibres = 9e10}",
            ),
            ("[region.bush.heat]", "viscosity = {shear = 1e9}\n[region.bush.heat]"),
            ("source = 1e5", "source = {power = 3e3}"),
        ):
            self.assertEqual(text.count(old), 1, old)
            text = text.replace(old, new)
        scene = self.folder / "scene.toml"
        scene.write_text(text)
        few = ["--set", "time.steps=2"]
        found = self.run_scene(scene, "found", *few)
        self.assert_close(found, self.oracle(scene, "oracle", *few), "1e-9")
        for key in (
            "material.elasticity.fibres=5e10",
            "material.viscosity.shear=2e9",
            "heat.source.power=1e3",
        ):
            other = self.run_scene(scene, f"other {key}", *few, "--set", f"region.bush.{key}")
            self.assertEqual(compare.main([str(found), str(other), "--tolerance", "1e-6"]), 1, key)

    def test_the_oracle_notices_a_wrong_law(self) -> None:
        """A factor, an axis, a power and a time, each turned in what the driver reads only."""
        laws = self.folder / "laws"
        laws.mkdir()
        for scene, law, good, bad in (
            ("own-material", "fibres", "(top - x[1])", "(top - 1.000001 * x[1])"),
            ("own-material", "absorber", "positive_part(x[0] - x_0) ** 2", "positive_part(x[0] - x_0)"),
            (
                "own-material",
                "spin",
                "conditional(lt(t, T), t / T, 1)",
                "conditional(lt(t, T), t / T, t / T)",
            ),
            ("own-source", "laser-spot", "- speed * t)", "- speed * (t + 1e-6))"),
        ):
            with self.subTest(law=law):
                few = ["--set", "time.steps=3", "--set", "mesh.cells=[6, 3]"]
                for path in (SCENES / "laws").glob("*.py"):
                    (laws / path.name).write_text(path.read_text())
                copy = self.folder / f"{scene}.toml"
                copy.write_text((SCENES / f"{scene}.toml").read_text())
                oracle = self.oracle(copy, f"oracle {law}", *few)
                self.assert_close(self.run_scene(copy, f"right {law}", *few), oracle, "1e-9")
                text = (laws / f"{law}.py").read_text()
                self.assertEqual(text.count(good), 1)
                (laws / f"{law}.py").write_text(text.replace(good, bad))
                wrong = self.run_scene(copy, f"wrong {law}", *few)
                self.assertEqual(compare.main([str(wrong), str(oracle), "--tolerance", "1e-9"]), 1)


if __name__ == "__main__":
    unittest.main()
