"""The report: its page stands alone, its verdicts can fail, and kept results are taken only for what they are.

Run from verification/: python3 -m unittest tests.test_report. Where the driver (THERMOCONTACT_DRIVER names it) and
the program of the manufactured solutions are built, a small page is built and checked.
"""

import base64
import dataclasses
import re
import tempfile
import unittest
from pathlib import Path

import report
from browser import CHROMIUM, DESKTOP, PHONE, look
from report_parts import (
    agreement,
    audits,
    constants,
    error_curve,
    extremes,
    invariance,
    known_answers,
    matrix,
    orders,
    tradeoff,
)
from report_parts.html import markdown_rows, picture, table
from report_parts.kept import Workshop, shown
from report_parts.page import Answer, page
from report_parts.section import Command, Findings, Kept, Section
from report_parts.self_contained import problems
from report_parts.sections import SECTIONS
from tradeoff_parts.choice import SOURCES
from under_test import DRIVER

PIXEL = base64.b64decode(
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=="
)


def kept(printed: str, exit_code: int = 0, name: str = "x") -> Kept:
    return Kept(Command(name, ["verification/x.py"]), exit_code, printed, 1.0, "2026-01-01 00:00", "driver 1")


def section(name: str = "one") -> Section:
    return Section(name, "Is it?", "About <it>.", lambda small: [], lambda folder, kept: None)  # type: ignore


class PageTest(unittest.TestCase):
    def setUp(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            image = Path(folder) / "a.png"
            image.write_bytes(PIXEL)
            blocks = [table(["a", "b"], [["1e-9", "<b>"]]), picture(image, "a picture")]
        run = kept("said\nthis")
        good = Answer(
            section("one"), [run.command], [run], Findings(True, "worst 1e-12, allowed 1e-9", blocks)
        )
        bad = Answer(section("two"), [run.command], [run], None, "ended with exit code 2")
        self.page = page([good, bad], [["processor", "a <fast> one"]], "report.py", "today")

    def test_stands_alone(self) -> None:
        self.assertEqual(problems(self.page), [])
        self.assertIn("data:image/png;base64,", self.page)
        self.assertIn("&lt;b&gt;", self.page)
        self.assertIn("1 of 2 questions", self.page)

    def test_what_does_not_stand_alone(self) -> None:
        for old, new in (
            ('src="data:image/png', 'src="picture.png'),
            ("</head>", '<link rel="stylesheet" href="a.css"></head>'),
            ("</body>", "<script>1</script></body>"),
            ("</style>", "body { background: url(a.png) }</style>"),
            ('href="#one"', 'href="https://example.org"'),
            ('href="#one"', 'href="#three"'),
            ('<p class="verdict">', "<p>"),
            ('alt="a picture"', ""),
        ):
            self.assertIn(old, self.page)
            self.assertNotEqual(problems(self.page.replace(old, new)), [], new)

    def test_versions_that_differ_are_said(self) -> None:
        other = dataclasses.replace(kept(""), version="driver 2")
        found = Findings(True, "", [])
        answers = [Answer(section(), [], [kept(""), other], found)]
        self.assertIn("kept from other versions", page(answers, [], "", ""))
        self.assertNotIn("kept from other versions", self.page)


class KeptTest(unittest.TestCase):
    def test_reused_only_for_the_same_command(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            workshop = Workshop(Path("/bin/echo"), Path(folder), "1")
            first = workshop.kept("part", Command("c", ["{driver}", "once", "{out}"]), reuse=False)
            self.assertEqual(first.printed, f"once {folder}/part\n")
            marked = Path(folder, "part", "c.json")
            marked.write_text(marked.read_text().replace("once {out}", "x").replace("once /", "kept /"))
            again = workshop.kept("part", first.command, reuse=True)
            self.assertTrue(again.printed.startswith("kept "))
            self.assertTrue(workshop.kept("part", first.command, reuse=False).printed.startswith("once "))
            other = workshop.kept("part", Command("c", ["{driver}", "other"]), reuse=True)
            self.assertEqual(other.printed, "other\n")

    def test_shown_as_typed(self) -> None:
        command = Command("c", ["verification/x.py", "--output", "{out}", 'a="b"'], ["--driver", "{driver}"])
        self.assertEqual(shown("part", command), "python3 verification/x.py --output part 'a=\"b\"'")


class VerdictTest(unittest.TestCase):
    """Each reader, on what its program prints, passing and failing."""

    def setUp(self) -> None:
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def test_agreement(self) -> None:
        good = kept("agreement within 1e-09; the worst is body temperature at t = 1, (0, 0, 0): 2.000e-13")
        bad = kept("DIFFERENT beyond 1e-09; the worst is body temperature at t = 1, (0, 0, 0): 2.000e-03", 1)
        self.assertTrue(agreement.read(self.folder, [good]).passes)
        found = agreement.read(self.folder, [good, bad])
        self.assertFalse(found.passes)
        self.assertIn("2.0e-03 (x), allowed 1e-09", found.worst)

    def test_matrix(self) -> None:
        rows = "| key or family | v | c | d | in |\n| --- | --- | --- | --- | --- |\n| heat.source | a \\| b | | 2e-14 | T |\n"
        (self.folder / "matrix.md").write_text(rows)
        text = "14 cases, 2 of them also with the oracle on 2 processes, 119 refusals; largest difference {}; {} failures"
        self.assertTrue(matrix.read(self.folder, [kept(text.format("3.1e-13", 0))]).passes)
        found = matrix.read(self.folder, [kept("FAILED a: b\n" + text.format("3.1e-03", 1), 1)])
        self.assertFalse(found.passes)
        self.assertIn("FAILED a: b", found.blocks[0])
        self.assertEqual(markdown_rows(rows)[1][1], "a | b")

    def test_orders(self) -> None:
        head = "study,case,cell,degree,scheme,norm,size,error,order,theory\n"
        line = "space,heat,triangle,1,backward-euler,temperature,{},1.0,{},2\n"
        (self.folder / "orders.md").write_text("| cell |\n| --- |\n| triangle |\n")
        (self.folder / "orders.png").write_bytes(PIXEL)
        for order, passes in (("1.95", True), ("1.89", False), ("nan", False)):
            (self.folder / "orders.csv").write_text(head + line.format(8, "") + line.format(16, order))
            self.assertEqual(orders.read(self.folder, []).passes, passes, order)

    def test_known_answers(self) -> None:
        row = f"{'heat flow, W/m2':<58} {1:16.10g} {1.1:16.10g} {0.1:10.1e} {{:9.1e}}  {{}}"
        good = kept("\nslab\nquantity  expected\n" + row.format(1.0, "ok") + "\n\nall within tolerance")
        bad = kept("\nslab\nquantity  expected\n" + row.format(0.01, "FAILED"), 1)
        self.assertIn(
            "slab: heat flow, W/m2: 1.0e-01 of 1.0e+00", known_answers.read(self.folder, [good]).worst
        )
        self.assertTrue(known_answers.read(self.folder, [good]).passes)
        self.assertFalse(known_answers.read(self.folder, [bad]).passes)

    def test_constants(self) -> None:
        good = kept("        driver     dolfinx, SciPy\ns1      2.63079   2.63078996091\nr_a   inf   inf\n")
        bad = kept("s1      2.7   2.63078996091   differs\n", 1)
        self.assertTrue(constants.read(self.folder, [good]).passes)
        found = constants.read(self.folder, [good, bad])
        self.assertFalse(found.passes)
        self.assertIn("2.6e-02 (s1 of x)", found.worst)

    def test_audits(self) -> None:
        summary = '{"audit": {"energy": %s, "heat": null}, "mesh": {"unknowns": {"u": 1}}, "newton": {"iterations": 1}}'
        (self.folder / "x").mkdir()
        for residual, passes in (("1e-12", True), ("1e-8", False), ("NaN", False)):
            (self.folder / "x" / "summary.json").write_text(summary % residual)
            self.assertEqual(audits.read(self.folder, [kept("")]).passes, passes)

    def test_invariance(self) -> None:
        rows = "box: mirrored 1.0e-14 in velocity\n{}box: turned       {} in temperature\n"
        good = kept(rows.format("", "2.0e-14") + "\nall 2 agree to 1e-10")
        bad = kept(rows.format("FAILED ", "inf") + "\n1 of 2 differ", 1)
        self.assertTrue(invariance.read(self.folder, [good]).passes)
        self.assertIn("2.0e-14 (box: turned, of 2 ways)", invariance.read(self.folder, [good]).worst)
        self.assertFalse(invariance.read(self.folder, [bad]).passes)

    def test_extremes(self) -> None:
        head = "group,case,outcome,second opinion,why\n"
        (self.folder / "cases.csv").write_text(head + "alone,a,completed,same,\nalone,b,bad,,not finite\n")
        self.assertTrue(extremes.read(self.folder, [kept("", 0)]).passes)
        found = extremes.read(self.folder, [kept("", 1)])
        self.assertFalse(found.passes)
        self.assertIn("1 ended badly", found.worst)
        self.assertIn("not finite", found.blocks[-1])

    def test_error_curve(self) -> None:
        head = "scene,variant,mode,reference,h,error,order,relative_error\n"
        lines = "paper,s,both,16,0.25,0.4,nan,0.3\npaper,s,both,16,0.125,{},1.0,0.2\n"
        (self.folder / "error-curve.png").write_bytes(PIXEL)
        for error, passes in ((0.2, True), (0.5, False)):
            (self.folder / "error-curve.csv").write_text(head + lines.format(error))
            self.assertEqual(error_curve.read(self.folder, []).passes, passes)

    def test_tradeoff(self) -> None:
        head = (
            "knob,status,error,told_from_reference," + ",".join(f"own_{source}" for source in SOURCES) + "\n"
        )
        line = "the scene as it is,completed,0.3,{},,,{},,,0.1\nbound of the reference,{},0.01,,,,,,,\n"
        (self.folder / "tradeoff.png").write_bytes(PIXEL)
        price = "mesh,0.3,0.1,,0.9,1,0.8,1,,\n"
        (self.folder / "prices.csv").write_text(
            "knob,from_error,to_error,factor_per_digit,order_w,theory_w,order_strain,theory_strain,order_theta,"
            "theory_theta\n" + price
        )
        for told, part, status, passes in (
            ("True", 0.25, "bound", True),
            ("False", 0.25, "bound", False),
            ("True", 0.15, "bound", False),
            ("True", 0.25, "estimate", True),
        ):
            (self.folder / "tradeoff.csv").write_text(head + line.format(told, part, status))
            found = tradeoff.read(self.folder, [])
            self.assertEqual(found.passes, passes, (told, part, status))
            self.assertEqual("an estimate" in found.worst, status == "estimate")


@unittest.skipUnless(DRIVER.with_name("manufactured").is_file(), "not built")
class SmallPageTest(unittest.TestCase):
    def test_small_page(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            options = ["--small", "--output", folder, "--driver", str(DRIVER)]
            self.assertEqual(report.main(options), 0)
            text = Path(folder, "report.html").read_text(encoding="utf-8")
            self.assertEqual(problems(text), [])
            for part in SECTIONS.values():
                self.assertEqual(text.count(f'<section id="{part.name}">'), 1)
            self.assertEqual(text.count('<p class="verdict"><span class="mark ok">'), len(SECTIONS))
            self.assertGreaterEqual(len(re.findall(r'<img alt="[^"]+" src="data:image/png;base64,', text)), 2)
            self.assertNotIn("://", re.sub(r"base64,[^\"]*", "", text))
            if CHROMIUM is not None:
                self.check_in_browser(Path(folder, "report.html"))
            # results that are gone, or that say otherwise, are not answered with yes
            Path(folder, "orders", "orders.csv").unlink()
            self.assertEqual(report.main([*options, "--reuse", "--section", "orders"]), 1)

    def check_in_browser(self, page: Path) -> None:
        for window in (PHONE, DESKTOP):
            backgrounds = set()
            for dark in (False, True):
                seen = look(page, window, dark)
                self.assertEqual((seen.errors, seen.broken_images), ([], []))
                self.assertLessEqual(seen.wider_by, 0)
                self.assertGreaterEqual(seen.images, 2)
                backgrounds.add(seen.background)
            self.assertEqual(len(backgrounds), 2, "light and dark look the same")


if __name__ == "__main__":
    unittest.main()
