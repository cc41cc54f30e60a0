"""Laws that a scene names files for: found out about, compiled, kept, refused; and a wrong one is noticed.

Each test has a cache of compiled laws of its own, and a Python that counts how often it is started.
"""

import json
import subprocess
import sys
import unittest
from pathlib import Path

import compare

from tests.with_law_files import ROOT, SCENES, WithLawFiles

SCENE = """
[forms]
{law} = "{file}"
[mesh]
cells = [3, 2]
[time]
end = 0.2
steps = 2
[material]
density = 1.0
[material.elasticity]
young = 10.0
poisson = 0.2
[heat]
conductivity = 1.0
[boundary.top]
displacement = ["0.1*t", "-0.2*t"]
temperature = 1.0
[boundary.bottom.contact]
compliance = {{{compliance}}}
friction = {{{friction}}}
conductance = {{{conductance}}}
"""
CONDUCTOR = """
[forms]
conductance = "my_law.py"
[mesh]
cells = [6, 5]
[time]
end = 0.2
steps = 2
[heat]
conductivity = 1.0
[boundary.top]
temperature = 1.0
[boundary.bottom.contact]
gap = -1.0
conductance = {coefficient = 10.0, onset = 1e-3, foundation_temperature = "9*x - 4", largest_difference = 0.5}
[solver]
max_iterations = 1
"""
NUMBERS = {
    "compliance": "stiffness = 100.0",
    "friction": "coefficient = 0.3, regularisation = 1e-2",
    "conductance": "coefficient = 2.0, onset = 1e-3, foundation_temperature = 5.0",
}
SPRING = '''"""Springs."""
from law import parameter, positive_part
c = parameter("hardness", above=0, meaning="Stiffness.")


def pressure(r):
    return c * positive_part(r)
'''


class LawFiles(WithLawFiles):
    def scene(self, law: str, text: str, numbers: str = "", file: str = "my_law.py") -> Path:
        (self.folder / file).write_text(text)
        path = self.folder / "scene.toml"
        tables = {**NUMBERS, **({law: numbers} if numbers else {})}
        path.write_text(SCENE.format(law=law, file=file, **tables))
        return path

    # What is wrong in a file is shown with its own line

    def test_mistakes_are_shown_with_their_line(self) -> None:
        head = "from law import parameter, positive_part\n"
        hardness = 'c = parameter("hardness", above=0, meaning="c")\n'
        for text, *expected in (
            (head + "def pressure(r:\n    return r\n", "my_law.py:2: '(' was never closed"),
            (head + "c = parameter('hardness')\n", "my_law.py:2: TypeError"),
            (head + "c = paramter('hardness', meaning='')\n", "my_law.py:2: NameError: name 'paramter'"),
            (head + hardness, "my_law.py: defines no function pressure(r)"),
            (head + hardness + "def pressure(x):\n    return c * x\n", "my_law.py:3: pressure takes 'x'"),
            (head + hardness + "def pressure():\n    return c\n", "my_law.py:3: pressure does not take r"),
            (head + hardness + "def pressure(r):\n    return c * s\n", "my_law.py:4: NameError: name 's'"),
            (
                head + hardness + "def pressure(r):\n    return c\n",
                "my_law.py:3: pressure does not depend on r",
            ),
            (
                head
                + "from ufl import as_vector\n"
                + hardness
                + "def pressure(r):\n    return as_vector((r, c))\n",
                "my_law.py:4: pressure is not scalar",
            ),
            (
                head + hardness + "def pressure(r):\n    return c * r**1.5\n",
                "my_law.py:3: pressure is no finite number at r = -0.5",
            ),
            (
                head + hardness + "def pressure(r):\n    return c * positive_part(r)**0.5\n",
                "my_law.py:3: the derivative of pressure by r is no finite number at r = -0.5",
            ),
            (
                head
                + hardness
                + hardness.replace("c =", "d =")
                + "def pressure(r):\n    return (c + d) * r\n",
                "two parameters have the key 'hardness'",
            ),
            (head + "c = parameter('a', above=2, below=1, meaning='')\n", "my_law.py:2: ValueError"),
            ("", "my_law.py: is empty"),
        ):
            with self.subTest(expected=expected):
                scene = self.scene("compliance", text, "hardness = 1.0")
                self.refused(scene, "scene.toml:3: forms.compliance: ", *expected)

    def test_a_missing_file_and_unused_laws(self) -> None:
        scene = self.scene("compliance", SPRING, "hardness = 1.0")
        (self.folder / "my_law.py").unlink()
        self.refused(scene, "scene.toml:3: forms.compliance: ", "my_law.py: no such file")
        self.refused(
            self.scene("complaince", SPRING), 'forms.complaince: unknown key; did you mean "compliance"?'
        )
        scene = self.scene("compliance", SPRING)
        scene.write_text(scene.read_text().partition("[boundary.bottom.contact]")[0])
        self.refused(scene, "forms.compliance: no boundary has [boundary.NAME.contact.compliance]")

    # Its constants are keys of the scene

    def test_parameters_are_validated_like_other_keys(self) -> None:
        key = "boundary.bottom.contact.compliance"
        for numbers, *expected in (
            ("hradness = 1.0", f"{key}.hradness: unknown key", "hardness"),
            ("hardness = 0.0", f"{key}.hardness: expected a number > 0, found 0"),
            ('hardness = "x"', f"{key}.hardness: expected a number > 0, found"),
            ("stiffness = 1.0", f"{key}.stiffness: unknown key"),  # that of the built-in law
        ):
            with self.subTest(numbers=numbers):
                scene = self.scene("compliance", SPRING, numbers)
                line = next(n for n, text in enumerate(scene.read_text().splitlines(), 1) if numbers in text)
                self.refused(scene, f"scene.toml:{line}: ", *expected)
        scene = self.scene("compliance", SPRING)
        scene.write_text(scene.read_text().replace(NUMBERS["compliance"], ""))
        self.refused(scene, f"{key}.hardness: missing; add hardness = 1.0")

    def test_a_parameter_with_the_name_of_a_key_that_stays(self) -> None:
        text = 'from law import parameter\nmu = parameter("regularisation", meaning="")\ndef bound(p_n):\n    return mu * p_n\n'
        self.refused(self.scene("friction", text), "the parameter regularisation has the name of a key")

    def test_schema_summary_and_forms_tell_of_them(self) -> None:
        scene = self.scene("compliance", SPRING, "hardness = 30.0")
        code, output, errors = self.call("schema", "--scene", scene, "--format", "json")
        self.assertEqual(code, 0, errors)
        keys = {entry["key"]: entry for entry in json.loads(output)}
        self.assertNotIn("boundary.NAME.contact.compliance.stiffness", keys)
        own = keys["boundary.NAME.contact.compliance.hardness"]
        self.assertEqual(
            (own["description"], own["range"]["low"], own["required"]), ("Stiffness.", 0.0, True)
        )
        summary = json.loads((self.run_scene(scene, "results") / "summary.json").read_text())
        resolved = summary["scene"]
        self.assertEqual(resolved["boundary"]["bottom"]["contact"]["compliance"], {"hardness": 30.0})
        self.assertEqual(resolved["forms"], {"compliance": "my_law.py"})

    def test_what_a_law_takes_must_be_there(self) -> None:
        conductance = "def heat_flux(p_n, s):\n    return p_n * s\n"
        scene = self.scene("conductance", conductance, "foundation_temperature = 5.0")
        without = scene.read_text().replace(f"compliance = {{{NUMBERS['compliance']}}}\n", "")
        scene.write_text(without.replace(f"friction = {{{NUMBERS['friction']}}}\n", ""))
        self.refused(scene, "contact.conductance: needs [boundary.bottom.contact.compliance]", "takes p_n")
        friction = "def bound(p_n, speed):\n    return p_n / (1 + speed)\n"
        self.refused(
            self.scene("friction", friction, "regularisation = 0.0"),
            "friction.regularisation: expected a number > 0 (m/s)",
            "takes the speed",
        )

    # Compiled once

    def test_a_second_run_starts_no_python(self) -> None:
        scene = self.scene("compliance", SPRING, "hardness = 100.0")
        first = self.run_scene(scene, "first")
        self.assertEqual(self.starts(), 2, "one to describe and one to compile")
        second = self.run_scene(scene, "second")
        self.assertEqual(self.starts(), 2)
        self.assert_same(first, second)
        self.run_scene(self.scene("compliance", SPRING, "hardness = 50.0"), "other numbers")
        self.assertEqual(self.starts(), 2, "numbers are no part of the kernels")
        self.run_scene(self.scene("compliance", SPRING + "\n", "hardness = 50.0"), "another text")
        self.assertEqual(self.starts(), 4)
        self.run_scene(scene, "degree", "--set", "space.degree=2")
        self.assertEqual(self.starts(), 5, "kernels of the other degree")

    def test_a_copy_of_a_built_in_law_changes_nothing(self) -> None:
        for law in ("compliance", "friction", "conductance"):
            code, text, _ = self.call("forms", law)
            self.assertEqual(code, 0)
            scene = self.scene(law, text)
            plain = self.run_scene(scene, f"{law} copied")
            self.assertEqual(self.starts(), 0, "the built-in law itself needs no Python")
            (self.folder / "my_law.py").write_text(text + "# my own\n")
            own = self.run_scene(scene, f"{law} own")
            self.assertGreater(self.starts(), 0)
            self.started.write_text("")
            self.assert_same(plain, own)

    def test_a_width_is_what_continuation_widens(self) -> None:
        """One iteration is too few for contact that is in places beyond its limit, also in wider steps to it."""
        text = self.call("forms", "conductance")[1].replace('"limit"', '"largest_difference"')
        (self.folder / "my_law.py").write_text(text)
        path = self.folder / "scene.toml"
        path.write_text(CONDUCTOR)
        code, _, errors = self.call("run", path, "--quiet")
        self.assertEqual(code, 3, errors)
        self.assertIn("continuation in conductance.largest_difference stopped", errors)

    def test_two_runs_at_once(self) -> None:
        scene = self.scene("compliance", SPRING, "hardness = 100.0")
        runs = [self.start("run", scene, "--quiet", "--output", self.folder / name) for name in "ab"]
        for run in runs:
            _, errors = run.communicate()
            self.assertEqual(run.returncode, 0, errors)
        self.assertEqual(self.starts(), 2, "one of the two compiles")

    def test_several_processes(self) -> None:
        scene = self.scene("compliance", SPRING, "hardness = 100.0")
        several = self.run_scene(scene, "several", "--set", 'solver.strategy="newton-krylov"', processes=2)
        self.assertEqual(self.starts(), 2)
        alone = self.run_scene(scene, "alone")
        self.assertEqual(compare.main([str(alone), str(several), "--tolerance", "1e-9"]), 0)
        self.refused(
            self.scene("compliance", SPRING.replace("return c", "return d"), "hardness = 1.0"),
            ":7: NameError",
        )

    def test_what_is_missing_is_named(self) -> None:
        scene = self.scene("compliance", SPRING, "hardness = 1.0")
        self.environment["CC"] = "no-such-compiler"
        self.refused(scene, "no-such-compiler", "No such file", code=1)
        self.environment["THERMOCONTACT_PYTHON"] = "/no/such/python"
        self.refused(scene, "/no/such/python", "THERMOCONTACT_PYTHON", code=1)
        self.environment["THERMOCONTACT_PYTHON"] = "/bin/false"
        self.refused(scene, "/bin/false ended with exit code 1", code=1)
        del self.environment["XDG_CACHE_HOME"]
        self.environment["HOME"] = "/proc/no-such-home"
        self.refused(scene, "/proc/no-such-home/.cache/thermocontact", "cannot be made", code=1)

    # The law belongs to the scene

    def test_a_restart_with_another_law_is_refused(self) -> None:
        scene = self.scene("compliance", SPRING, "hardness = 100.0")
        results = self.run_scene(scene, "results", "--set", "time.end=0.1", "--set", "time.steps=1")
        checkpoint = results / "checkpoint.h5"
        self.run_scene(scene, "longer", "--restart", checkpoint)
        (self.folder / "my_law.py").write_text(SPRING.replace("(r)\n", "(r) / 2\n"))
        code, _, errors = self.call("run", scene, "--restart", checkpoint, "--output", self.folder / "none")
        self.assertEqual(code, 2, errors)
        self.assertIn("forms.compliance", errors)

    def test_the_oracle_notices_a_wrong_law(self) -> None:
        """A sign, a factor and a power, each turned in what the driver reads only."""
        for scene, law, good, bad in (
            ("own-compliance", "power-law", "** m", "** (m + 1e-6)"),
            ("own-friction", "stribeck", "exp(-speed", "exp(speed"),
            ("own-conductance", "pressure-conductance", "return k_1", "return -k_1"),
        ):
            few = ["--set", "time.steps=2", "--set", "mesh.cells=[6,6]"]
            with self.subTest(scene=scene):
                laws = self.folder / "laws"
                laws.mkdir(exist_ok=True)
                for path in (SCENES / "laws").glob("*.py"):
                    (laws / path.name).write_text(path.read_text())
                copy = self.folder / f"{scene}.toml"
                copy.write_text((SCENES / f"{scene}.toml").read_text())
                oracle = self.folder / f"oracle-{scene}"
                command = [sys.executable, str(ROOT / "verification" / "oracle.py"), str(copy)]
                subprocess.run(
                    [*command, "--quiet", "--output", str(oracle), *few], check=True, capture_output=True
                )
                right = self.run_scene(copy, f"right-{scene}", *few)
                self.assertEqual(compare.main([str(right), str(oracle), "--tolerance", "1e-9"]), 0)
                text = (laws / f"{law}.py").read_text()
                self.assertEqual(text.count(good), 1)
                (laws / f"{law}.py").write_text(text.replace(good, bad))
                code, _, _ = self.call(
                    "run", copy, "--quiet", "--output", self.folder / f"wrong-{scene}", *few
                )
                if code != 3:
                    self.assertEqual(code, 0)
                    wrong = str(self.folder / f"wrong-{scene}")
                    self.assertEqual(compare.main([wrong, str(oracle), "--tolerance", "1e-9"]), 1)


if __name__ == "__main__":
    unittest.main()
