"""Show that a wrong sign in any one form is noticed.

    python3 verification/sabotage.py [--work DIR]

Builds the driver from a copy of forms/ and src/ and checks that it agrees with the oracle on small scenes. Then, one
form after another: turns one sign in the copy, rebuilds what depends on it, runs a small scene and compares with the
oracle's result. The sabotage is noticed if compare.py finds a difference or the driver refuses (exit code 3).

The manufactured solutions must notice it too, without the oracle, for every form that they march with: their orders of
convergence leave theory, or a run finds no solution.

Exit codes: 0 every sabotage was noticed, 1 one survived, 2 the check itself could not be made.
"""

import argparse
import shutil
import subprocess
import sys
import tempfile
import textwrap
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
HELPERS = {"space", "generate"}  # files in forms/ that hold no form
SMALL = ["--set", "mesh.cells=[8,8]", "--set", "time.steps=4"]

ORDERS = ["--case", "slipping", "--cell", "triangle", "--degree", "1"]  # the case that has all physics
# Forms that do not act there: loads, in whose place compiled sources stand, and those that only report.
WITHOUT_ORDERS = {"body_force", "traction", "heat_source", "heat_flux", "kinematics", "norms", "stress"}

CAUGHT, SURVIVED, BROKEN = 0, 1, 2
DRIVER_REFUSED = 3
COMPARE_AGREES, COMPARE_DIFFERS = 0, 1
ORDERS_AGREE, ORDERS_DIFFER, ORDERS_REFUSED = 0, 1, 3

Verdict = tuple[bool, str]  # whether it was noticed, and how that shows


@dataclass(frozen=True)
class Edit:
    """One sign turned in one form, and a scene that has this physics."""

    form: str
    scene: str
    text: str
    wrong: str


EDITS = (
    Edit("body_force", "paper-isotropic", "load = inner(f, v)", "load = -inner(f, v)"),
    Edit(
        "compliance",
        "paper-isotropic",
        "positive_part(dot(u_old + k * w, n)",
        "positive_part(dot(u_old - k * w, n)",
    ),
    Edit("conductance", "paper-isotropic", "s = theta - theta_F", "s = theta + theta_F"),
    Edit("conduction", "paper-isotropic", "conduction = dot(", "conduction = -dot("),
    Edit("elasticity", "paper-isotropic", "stiffness = inner(", "stiffness = -inner("),
    Edit("friction", "paper-isotropic", "sigma_t = -p_t", "sigma_t = p_t"),
    Edit("heat_capacity", "paper-isotropic", "capacity = c", "capacity = -c"),
    Edit("heat_flux", "heat-only", "load = flux", "load = -flux"),
    Edit("heat_source", "paper-isotropic", "load = q0", "load = -q0"),
    Edit("inertia", "paper-isotropic", "mass = rho", "mass = -rho"),
    Edit("kinematics", "paper-isotropic", "gap = at_nodes((g - dot(u, n))", "gap = at_nodes((g + dot(u, n))"),
    Edit("norms", "paper-isotropic", "strains = inner(", "strains = -inner("),
    Edit("strain_heating", "paper-isotropic", "coupling = inner(", "coupling = -inner("),
    Edit("stress", "paper-isotropic", "sigma[2] - theta * M[0, 1]", "sigma[2] + theta * M[0, 1]"),
    Edit("thermal_stress", "paper-isotropic", "coupling = theta", "coupling = -theta"),
    Edit("traction", "paper-isotropic", "load = inner(f, v)", "load = -inner(f, v)"),
    Edit("viscosity", "paper-isotropic", "damping = inner(", "damping = -inner("),
)


class CannotCheck(Exception):
    """The check itself failed: no verdict on the forms."""


def call(*command: str | Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)


def must(what: str, *command: str | Path) -> None:
    result = call(*command)
    if result.returncode != 0:
        raise CannotCheck(
            f"{what} failed with exit code {result.returncode}:\n{result.stdout}{result.stderr}"
        )


def last_line(text: str) -> str:
    lines = text.strip().splitlines()
    return lines[-1] if lines else "no message"


class Copy:
    """A copy of the sources with its own build and the oracle's results beside it."""

    def __init__(self, work: Path) -> None:
        self.work, self.build, self.clean = work, work / "build", work / "build-clean"
        for folder in ("forms", "src", "verification/manufactured_parts"):
            ignored = shutil.ignore_patterns("__pycache__")
            shutil.copytree(ROOT / folder, work / folder, ignore=ignored, dirs_exist_ok=True)
        shutil.copy(ROOT / "CMakeLists.txt", work)
        flags = ["-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_C_FLAGS_RELEASE=-O1", "-DCMAKE_CXX_FLAGS_RELEASE=-O1"]
        switches = [
            "-DTHERMOCONTACT_TESTS=OFF",
            "-DKERNEL_CELLS=triangle",
            "-DTHERMOCONTACT_MANUFACTURED=ON",
            "-DTHERMOCONTACT_NATIVE=OFF",
        ]
        must("cmake", "cmake", "-S", work, "-B", self.build, "-G", "Ninja", *flags, *switches)
        self.make()
        shutil.rmtree(self.clean, ignore_errors=True)
        shutil.copytree(self.build, self.clean)

    def make(self) -> None:
        must("the build", "ninja", "-C", self.build, "thermocontact", "manufactured")

    def oracle(self, scene: str) -> Path:
        """The oracle's result of the small scene, computed once."""
        results = self.work / f"oracle-{scene}"
        if not results.exists():
            program = ROOT / "verification/oracle.py"
            must(
                "the oracle",
                sys.executable,
                program,
                scene_file(scene),
                "--quiet",
                "--output",
                results,
                *SMALL,
            )
        return results

    def verdict(self, scene: str) -> Verdict:
        """Whether the driver as built now disagrees with the oracle, and how that shows."""
        expected, results = self.oracle(scene), self.work / "results"
        program = self.build / "thermocontact"
        run = call(program, "run", scene_file(scene), "--quiet", "--output", results, *SMALL)
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
        study = call(sys.executable, program, "--program", self.build / "manufactured", *ORDERS)
        if study.returncode == ORDERS_REFUSED:
            return True, "orders: " + last_line(study.stderr).removeprefix("manufactured: ")
        if study.returncode not in (ORDERS_AGREE, ORDERS_DIFFER):
            raise CannotCheck(f"manufactured.py ended with exit code {study.returncode}: {study.stderr}")
        return study.returncode == ORDERS_DIFFER, "orders: " + last_line(study.stdout)

    def sabotaged(self, edit: Edit) -> list[Verdict]:
        """The verdicts with the sign turned. Form and build are put back with their times, lest they be built again."""
        original, path = ROOT / f"forms/{edit.form}.py", self.work / f"forms/{edit.form}.py"
        text = path.read_text(encoding="utf-8")
        if text.count(edit.text) != 1:
            raise CannotCheck(f"forms/{edit.form}.py holds {text.count(edit.text)} times: {edit.text}")
        path.write_text(text.replace(edit.text, edit.wrong), encoding="utf-8")
        self.make()
        verdicts = [self.verdict(edit.scene)]
        if edit.form not in WITHOUT_ORDERS:
            verdicts.append(self.orders_verdict())
        shutil.copy2(original, path)
        shutil.rmtree(self.build)
        shutil.copytree(self.clean, self.build)
        return verdicts


def scene_file(scene: str) -> Path:
    return ROOT / "scenes" / f"{scene}.toml"


def check_that_all_forms_are_listed() -> None:
    forms = {path.stem for path in (ROOT / "forms").glob("*.py")} - HELPERS
    listed = {edit.form for edit in EDITS}
    if forms != listed:
        raise CannotCheck(f"forms without an edit, or edits without a form: {sorted(forms ^ listed)}")


def check(work: Path) -> int:
    check_that_all_forms_are_listed()
    copy = Copy(work)
    for scene in sorted({edit.scene for edit in EDITS}):
        differs, how = copy.verdict(scene)
        if differs:
            raise CannotCheck(f"untouched forms, scene {scene}: {how}")
        print(f"untouched forms, scene {scene}: {how}", flush=True)
    off, how = copy.orders_verdict()
    if off:
        raise CannotCheck(f"untouched forms: {how}")
    print(f"untouched forms: {how}", flush=True)
    print(f"\n{'form':<15} {'wrong sign':<48} noticed by")
    survived = []
    for edit in EDITS:
        verdicts = copy.sabotaged(edit)
        names = [edit.form, ""], [edit.wrong, ""]
        for form, wrong, (noticed, how) in zip(*names, verdicts):
            note = textwrap.shorten(how if noticed else "NOT NOTICED: " + how, 120)
            print(f"{form:<15} {wrong:<48} {note}", flush=True)
        if not all(noticed for noticed, _ in verdicts):
            survived.append(edit.form)
    print(f"\n{len(EDITS) - len(survived)} of {len(EDITS)} wrong signs noticed")
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
