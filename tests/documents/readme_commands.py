"""Every command of README.md and of the pages that it leads to, as it is written there, and how a test tries it.

As it stands; smaller, where it takes minutes and the program has options for that; or not, with the reason: then its help
must be there, and the named test of ctest runs the program.
"""

from dataclasses import dataclass

TWO_CORES = "takes minutes to hours on two cores"


@dataclass(frozen=True)
class Command:
    """One of them. `instead` is run in its place; empty and without `reason`: itself."""

    text: str
    instead: str = ""
    reason: str = ""
    test: str = ""  # of ctest, which runs this program
    interrupted: bool = False  # by Ctrl-C, once there is a row of the history
    long: bool = False  # as it stands where tests may take long


DRIVER = "build/thermocontact "
PAPER = DRIVER + "run scenes/paper.toml "
ISOTROPIC = "scenes/paper-isotropic.toml "
PYTHON = "python3 verification/"
SIZES = "--set mesh.cells=[8,8] --set time.steps=8"

COMMANDS = (
    # The continuous check is the second one, and the first is what the second does but for the run and its pictures
    Command("sh scenes/paper.sh", reason="installs and builds", long=True),
    Command("sh tests/run.sh", reason="is what runs this test"),
    Command(DRIVER + "schema --format markdown"),
    Command(DRIVER + "check scenes/paper.toml"),
    Command(
        PAPER + "--output results --set mesh.cells=[64,64] --set time.steps=64"
        " --set boundary.bottom.contact.friction.regularisation=1e-6"
    ),
    Command(
        DRIVER + "plan " + ISOTROPIC + "--accuracy 1e-2",
        instead=DRIVER + "plan " + ISOTROPIC + "--accuracy 1e-1",
        long=True,
    ),
    Command(DRIVER + "run " + ISOTROPIC + "--accuracy 1e-1"),
    Command(
        DRIVER + "run " + ISOTROPIC + "--budget 30s",
        instead=DRIVER + "run " + ISOTROPIC + "--accuracy 0.2 --budget 90s",
        long=True,
    ),
    Command(PYTHON + "plan_check.py", reason=TWO_CORES, test="plan"),
    Command(PYTHON + "plan_check.py --accuracy --budget 2 30", reason=TWO_CORES, test="plan"),
    Command(
        DRIVER + "run scenes/refined.toml --output refined",
        instead=DRIVER + "run scenes/refined.toml --output refined --set time.steps=2",
        long=True,
    ),
    Command(PYTHON + "animate.py refined --output refined.png --frames 4"),
    Command(PYTHON + "refinement.py --output refinement", reason=TWO_CORES, test="refinement"),
    Command(PAPER + "--output results", interrupted=True),
    Command(PAPER + "--output results --restart results/checkpoint.h5"),
    Command(PYTHON + "cut_and_restart.py", reason=TWO_CORES, test="restart.cut"),
    Command(
        PYTHON + "kill_and_restart.py",
        instead=PYTHON + "kill_and_restart.py --kills 1",
        test="restart.fifty-kills",
    ),
    Command(
        "mpirun -n 4 " + DRIVER + "run scenes/brake-pad.toml --output results",
        instead="mpirun -n 2 " + DRIVER + "run scenes/brake-pad.toml --output results --set time.steps=2",
        long=True,
    ),
    Command(
        PYTHON + "cross_check.py scenes/brake-pad.toml --processes 2 --processes 4",
        reason=TWO_CORES,
        test="cross.brake-pad",
    ),
    Command(PYTHON + "report.py", reason="takes a quarter of an hour", test="verification.report"),
    Command(
        PYTHON + "cross_check.py scenes/paper.toml --ranks 2",
        instead=PYTHON + "cross_check.py scenes/paper.toml --ranks 2 " + SIZES,
        long=True,
    ),
    Command(PYTHON + "matrix.py", reason="is a test by itself", test="matrix"),
    Command(PYTHON + "sabotage.py", reason=TWO_CORES, test="sabotage"),
    Command(PYTHON + "mutate.py", instead=PYTHON + "mutate.py --check", test="mutation.run"),
    Command(
        PYTHON + "known_answers.py",
        instead=PYTHON + "known_answers.py --list",
        test="known_answers",
        long=True,
    ),
    Command(
        PYTHON + "manufactured.py --output orders --small",
        reason=TWO_CORES,
        test="verification.manufactured.triangle",
    ),
    Command(
        PYTHON + "manufactured.py --study time --cell triangle",
        instead=PYTHON
        + "manufactured.py --study time --cell triangle --case mechanics --degree 1 --scheme bdf2",
        long=True,
    ),
    Command("cmake --workflow --preset sanitize", reason=TWO_CORES),
    Command("sh tests/tidy.sh", reason="an hour of processor time"),
    Command(
        PYTHON + "mutate.py --work DIR --output mutations.csv --jobs 2",
        instead=PYTHON + "mutate.py --list",
        test="mutation.run",
    ),
    Command(
        "ctest --test-dir build -C Long -R versions", instead="ctest --test-dir build -C Long -R versions -N"
    ),
    Command(
        "ctest --test-dir build -C Mutation -R mutation.run",
        instead="ctest --test-dir build -C Mutation -R mutation.run -N",
    ),
    Command(PYTHON + "invariance.py", instead=PYTHON + "invariance.py --list", test="invariance", long=True),
    Command(
        PYTHON + "extremes.py --output extremes",
        instead=PYTHON
        + "extremes.py --output extremes --only 'alone: young' --draws 0 --second-opinion 0 --small",
        test="extremes.mended",
        long=True,
    ),
    Command(PYTHON + "conditioning.py", reason="a minute", test="conditioning", long=True),
    Command(PYTHON + "endurance.py", reason="is a test by itself", test="endurance"),
    Command(
        PYTHON + "convergence.py --output curve",
        instead=PYTHON
        + "convergence.py --output curve --scene paper --sizes 4 8 --reference 16 --mode both --small",
    ),
    Command(
        PYTHON + "convergence.py --experiment --sizes 8 16 32 64 --reference 128",
        reason=TWO_CORES,
        test="verification.convergence",
    ),
    Command(
        PYTHON + "tradeoff.py " + ISOTROPIC + "--output tradeoff",
        reason=TWO_CORES,
        test="verification.tradeoff",
    ),
    Command(
        PYTHON + """tradeoff.py scenes/box.toml --set 'boundary.top.displacement=["free",0.0,"free"]'""",
        reason=TWO_CORES,
        test="verification.tradeoff",
    ),
    Command(PYTHON + "reach.py --output reach", reason=TWO_CORES, test="reach"),
    Command(PYTHON + "coulomb_limit.py", reason=TWO_CORES),
    Command(PYTHON + "adaptive.py --output adaptive.csv", reason=TWO_CORES, test="adaptive"),
    Command(
        PYTHON + "benchmark.py --output measured",
        instead=PYTHON + "benchmark.py --output measured --sizes 8 16 --oracle-sizes 8 --repeat 1",
        long=True,
    ),
    # Installing
    Command("cmake --install build --prefix ~/.local"),
    Command("cmake --workflow --preset package", reason="builds all again", test="install.bare-debian"),
    Command(
        "sudo apt install ./build-package/thermocontact_*.deb",
        reason="installs; done in a bare system",
        test="install.bare-debian",
    ),
    Command("cmake -S examples/step_by_step -B example -DCMAKE_PREFIX_PATH=$HOME/.local"),
    Command("cmake --build example"),
    Command("example/step_by_step scenes/paper.toml bottom 0.5"),
    Command("cmake --build build --target docs"),
    # Looking at results
    Command(DRIVER + "view results", instead=DRIVER + "view results --no-open"),
    Command(PYTHON + "figures.py COLD HOT --output figures", reason="the folders are the reader's"),
    Command(PYTHON + "animate.py DIR --output film.gif", reason="the folder is the reader's"),
    Command(
        PYTHON + "gallery.py",
        instead=PYTHON + "gallery.py sphere --output gallery",
        test="verification.gallery",
    ),
)

# What else stands indented: what the program prints, and formulas
OUTPUT = (
    "scene.toml:31:",
    "constants on",
    "hypotheses of",
    "s1 ",
    "s2 ",
    "c_k",
    "c_f",
    "r_a",
    "holds ",
    "FAILS ",
    "ρ (",
    "+ ∫",
    "and ",
)
