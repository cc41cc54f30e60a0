"""Show that a wrong sign in any one form is noticed.

    python3 verification/sabotage.py [--work DIR]

The short run of mutate.py: builds the driver from a copy, for triangles only, and checks that it agrees with the oracle
on small scenes. Then, one form after another: turns one sign in the copy, rebuilds what depends on it, runs a small
scene and compares with the oracle's result. The sabotage is noticed if compare.py finds a difference or the driver
refuses (exit code 3).

The manufactured solutions must notice it too, without the oracle, for every form that they march with: their orders of
convergence leave theory, or a run finds no solution.

Exit codes: 0 every sabotage was noticed, 1 one survived, 2 the check itself could not be made.
"""

import argparse
import sys
import tempfile
import textwrap
from pathlib import Path

from mutate_parts.forms import SIGNS
from mutate_parts.mutation import Mutation
from mutate_parts.workspace import ROOT, CannotCheck, Workspace, call, last_line, must

FOLDERS = ("cmake", "docs", "examples", "forms", "scenes", "src", "verification/manufactured_parts")
SWITCHES = ("-DTHERMOCONTACT_TESTS=OFF", "-DKERNEL_CELLS=triangle", "-DTHERMOCONTACT_MANUFACTURED=ON")
HELPERS = {
    "space",
    "generate",
    "law",
    "in_force",
    "describe",
    "describe_body",
}  # files in forms/ that hold no form
# The one decides which mesh is made, and the oracle follows: refinement.py and the closed forms in C++ judge it. The
# other is compiled for scenes with laws of the body in files: tests/test_body_law_files.py compares it with what is built in.
JUDGED_ELSEWHERE = {"estimate", "at_points"}
SMALL = ["--set", "mesh.cells=[8,8]", "--set", "time.steps=4"]
USUAL_SCENE = ("paper-isotropic",)  # and what is set in it
EXACT_FRICTION = (*USUAL_SCENE, "--set", "boundary.bottom.contact.friction.regularisation=0")
CONVECTION = (
    "impact",  # whose sides have no temperature
    *("--set", "boundary.left.convection.coefficient=2"),
    *("--set", "boundary.left.convection.ambient_temperature=5"),
)
SPRING = (
    "impact",
    *("--set", "boundary.left.spring.stiffness=[[20,5],[5,10]]"),
    *("--set", 'boundary.left.spring.anchor=["0.2*t", 0.0]'),
)
SCENES = {
    "heat_flux": ("heat-only",),
    "coulomb": EXACT_FRICTION,
    "convection": CONVECTION,
    "spring": SPRING,
    "norms": ("elastic",),  # that of an isotropic viscous body in the plane comes from another matrix
}  # for forms that the usual scene has not

ORDERS = ["--case", "slipping", "--cell", "triangle", "--degree", "1"]  # the case that has all physics
# Forms that do not act there: loads, in whose place compiled sources stand, and those that only report.
# Exact friction has no solution of class C2 to be made from.
WITHOUT_ORDERS = {
    "coulomb",
    "convection",
    "spring",
    "body_force",
    "traction",
    "heat_source",
    "heat_flux",
    "kinematics",
    "norms",
    "stress",
}

CAUGHT, SURVIVED, BROKEN = 0, 1, 2
DRIVER_REFUSED = 3
COMPARE_AGREES, COMPARE_DIFFERS = 0, 1
ORDERS_AGREE, ORDERS_DIFFER, ORDERS_REFUSED = 0, 1, 3

Scene = tuple[str, ...]
Verdict = tuple[bool, str]  # whether it was noticed, and how that shows


class Judge:
    """The oracle and theory against the driver as it is built now."""

    def __init__(self, work: Path) -> None:
        self.work = work
        self.workspace = Workspace(work, FOLDERS, SWITCHES, "thermocontact", "manufactured")

    def oracle(self, scene: Scene) -> Path:
        """The oracle's result of the small scene, computed once."""
        results = self.work / ("oracle-" + "-".join(scene).replace("--set-", ""))
        if not results.exists():
            program: list[str | Path] = [
                sys.executable,
                ROOT / "verification/oracle.py",
                scene_file(scene),
                *scene[1:],
                "--quiet",
            ]
            must("the oracle", *program, "--output", results, *SMALL)
        return results

    def verdict(self, scene: Scene) -> Verdict:
        """Whether the driver disagrees with the oracle, and how that shows."""
        expected, results = self.oracle(scene), self.work / "results"
        program = self.workspace.build / "thermocontact"
        run = call(program, "run", scene_file(scene), *scene[1:], "--quiet", "--output", results, *SMALL)
        if run.returncode == DRIVER_REFUSED:
            return True, "driver: " + last_line(run.stderr).removeprefix("thermocontact: ")
        if run.returncode != 0:
            raise CannotCheck(f"the driver ended with exit code {run.returncode}: {run.stderr}")
        comparison = call(sys.executable, ROOT / "verification/compare.py", results, expected)
        if comparison.returncode not in (COMPARE_AGREES, COMPARE_DIFFERS):
            raise CannotCheck(f"compare.py ended with exit code {comparison.returncode}: {comparison.stderr}")
        return comparison.returncode == COMPARE_DIFFERS, last_line(comparison.stdout).split("; ", 1)[-1]

    def orders_verdict(self) -> Verdict:
        """Whether the manufactured solutions converge otherwise than theory says."""
        program = ROOT / "verification/manufactured.py"
        study = call(sys.executable, program, "--program", self.workspace.build / "manufactured", *ORDERS)
        if study.returncode == ORDERS_REFUSED:
            return True, "orders: " + last_line(study.stderr).removeprefix("manufactured: ")
        if study.returncode not in (ORDERS_AGREE, ORDERS_DIFFER):
            raise CannotCheck(f"manufactured.py ended with exit code {study.returncode}: {study.stderr}")
        return study.returncode == ORDERS_DIFFER, "orders: " + last_line(study.stdout)

    def sabotaged(self, mutation: Mutation) -> list[Verdict]:
        """The verdicts with the sign turned."""
        with self.workspace.mutated(mutation):
            if problem := self.workspace.make():
                raise CannotCheck(f"the build of {mutation.name} failed: {problem}")
            verdicts = [self.verdict(SCENES.get(mutation.name, USUAL_SCENE))]
            if mutation.name not in WITHOUT_ORDERS:
                verdicts.append(self.orders_verdict())
            return verdicts


def scene_file(scene: Scene) -> Path:
    return ROOT / "scenes" / f"{scene[0]}.toml"


def check_that_all_forms_are_listed() -> None:
    forms = {path.stem for path in (ROOT / "forms").glob("*.py")} - HELPERS - JUDGED_ELSEWHERE
    listed = {mutation.name for mutation in SIGNS}
    if forms != listed:
        raise CannotCheck(f"forms without an edit, or edits without a form: {sorted(forms ^ listed)}")


def check(work: Path) -> int:
    check_that_all_forms_are_listed()
    judge = Judge(work)
    for scene in sorted({USUAL_SCENE, *SCENES.values()}):
        differs, how = judge.verdict(scene)
        if differs:
            raise CannotCheck(f"untouched forms, scene {' '.join(scene)}: {how}")
        print(f"untouched forms, scene {' '.join(scene)}: {how}", flush=True)
    off, how = judge.orders_verdict()
    if off:
        raise CannotCheck(f"untouched forms: {how}")
    print(f"untouched forms: {how}", flush=True)
    print(f"\n{'form':<15} {'wrong sign':<48} noticed by")
    survived = []
    for mutation in SIGNS:
        verdicts = judge.sabotaged(mutation)
        names = [mutation.name, ""], [mutation.wrong, ""]
        for form, wrong, (noticed, how) in zip(*names, verdicts):
            note = textwrap.shorten(how if noticed else "NOT NOTICED: " + how, 120)
            print(f"{form:<15} {wrong:<48} {note}", flush=True)
        if not all(noticed for noticed, _ in verdicts):
            survived.append(mutation.name)
    print(f"\n{len(SIGNS) - len(survived)} of {len(SIGNS)} wrong signs noticed")
    return SURVIVED if survived else CAUGHT


def main() -> int:
    parser = argparse.ArgumentParser(description="Show that a wrong sign in any one form is noticed.")
    parser.add_argument("--work", type=Path, help="folder of the copy, kept; default: a temporary one")
    options = parser.parse_args()
    try:
        if options.work is not None:
            options.work.mkdir(parents=True, exist_ok=True)
            return check(options.work.resolve())
        with tempfile.TemporaryDirectory(prefix="sabotage-") as work:
            return check(Path(work))
    except (CannotCheck, OSError) as problem:
        print(f"sabotage: {problem}", file=sys.stderr)
        return BROKEN


if __name__ == "__main__":
    sys.exit(main())
