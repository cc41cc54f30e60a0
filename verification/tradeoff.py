"""Speed against accuracy: each knob of a scene is turned, its error and its time are measured.

    python3 verification/tradeoff.py [SCENE.toml] [--output DIR] [--reference N] [--repeat R] [--knob NAME]...
                                     [--driver PROGRAM]

The scene is one on a rectangle; default the paper's with K = I. The plan
(tradeoff_parts/plan.py) turns mesh, degree, step, scheme, adaptive tolerance, epsilon, coupling, Newton's tolerance and
strategy, each alone from one base, and adds the paper's choice h = k and some bargains of several knobs.

Error: the largest, over displacement, velocity, temperature and eight times, of the difference to the reference at the
vertices of an 8 x 8 lattice that all meshes share, in the l2 norm and relative to the field's largest. It is not a norm
over the body: nodal values may be better than what lies between. The reference (N x N cells of degree 2, 32 N steps of
bdf2, a hundredth of the scene's epsilon) is bounded by the differences that come from halving its mesh, doubling its step and enlarging
its epsilon tenfold: their sum is printed, and errors below three times that are not counted for the front. Beside the
error stands that of the knob alone, to its finest value with all others at the base.

In DIR: tradeoff.csv, prices.txt, tradeoff.png. Exit codes: 0 done, 1 a run failed, 2 the scene is not one for it.
"""

import argparse
import csv
import json
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from restart_parts.runs import Program, RunFailed
from tradeoff_parts.measure import Box, Outcome, distance, run
from tradeoff_parts.plan import Configuration, Scene, base, halves, plan, reference
from tradeoff_parts.report import Point, by_knob, draw, front, prices

ROOT = Path(__file__).resolve().parent.parent


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Measure the trade of speed against accuracy.")
    parser.add_argument("scene", nargs="?", type=Path, default=ROOT / "scenes" / "paper-isotropic.toml")
    parser.add_argument("--output", type=Path, default=Path("tradeoff"), metavar="DIR")
    parser.add_argument("--reference", type=int, default=64, choices=(16, 32, 64, 128), metavar="N")
    parser.add_argument("--repeat", type=int, default=3, metavar="R")
    parser.add_argument("--knob", action="append", metavar="NAME", help="these alone")
    parser.add_argument("--driver", type=Path, default=ROOT / "build" / "thermocontact")
    return parser.parse_args()


def resolved(driver: Path, scene: Path, folder: Path) -> dict[str, Any]:
    """The scene with all defaults, from the summary of a crude run. Raises ValueError where it is not one for this."""
    mesh = tomllib.loads(scene.read_text(encoding="utf-8")).get("mesh", {})
    if "file" in mesh or mesh.get("shape", "rectangle") != "rectangle":
        raise ValueError('mesh.shape: expected "rectangle", as meshes must share vertices')
    command = [
        driver,
        "run",
        scene,
        "--quiet",
        "--output",
        folder,
        "--set",
        "time.steps=1",
        "--set",
        "mesh.cells=[8,8]",
    ]
    answer = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if answer.returncode != 0:
        raise ValueError(answer.stderr.strip())
    content: dict[str, Any] = json.loads((folder / "summary.json").read_text(encoding="utf-8"))["scene"]
    return content


def described(content: dict[str, Any]) -> tuple[Scene, Box]:
    contacts = {
        name: side["contact"] for name, side in content.get("boundary", {}).items() if "contact" in side
    }
    friction = {name: contact["friction"] for name, contact in contacts.items() if "friction" in contact}
    epsilon = min((law["regularisation"] for law in friction.values()), default=0.0)
    mesh = content["mesh"]
    scene = Scene(tuple(friction), epsilon, "material" in content and "heat" in content)
    return scene, Box(tuple(mesh["lower"]), tuple(mesh["upper"]))


def measured(outcomes: Sequence[tuple[Configuration, Outcome]], best: Outcome) -> list[Point]:
    """With the error of each knob alone: to the finest of its values, which has none."""
    points = [Point(of, distance(done.states, best.states), 0.0, done.seconds) for of, done in outcomes]
    finest = {knob: of[-1].configuration for knob, of in by_knob(points).items()}
    states = {id(of): done.states for of, done in outcomes}
    return [
        Point(
            point.configuration, point.error, distance(states[id(point.configuration)], other), point.seconds
        )
        for point in points
        for other in [states[id(finest[point.configuration.knob])]]
    ]


def write(points: Sequence[Point], bound: float, title: str, folder: Path) -> None:
    trusted = [point for point in points if point.error > 3 * bound]
    best = {id(point) for point in front(trusted)}
    with (folder / "tradeoff.csv").open("w", encoding="ascii", newline="") as file:
        table = csv.writer(file)
        table.writerow(("knob", "value", "error", "own_error", "seconds", "on_front", "settings"))
        for point in points:
            of = point.configuration
            row = (
                of.knob,
                of.value,
                point.error,
                point.own,
                point.seconds,
                id(point) in best,
                json.dumps(of.settings),
            )
            table.writerow(row)
    (folder / "prices.txt").write_text("\n".join(prices(points)) + "\n", encoding="utf-8")
    draw(trusted, bound, title, folder / "tradeoff.png")


def study(arguments: argparse.Namespace, folder: Path) -> None:
    driver = arguments.driver.resolve()
    scene, box = described(resolved(driver, arguments.scene, folder / "first"))
    program = Program(driver, arguments.scene, {})
    best = run(program, box, folder / "reference", reference(scene, arguments.reference), 1)
    parts = {
        name: distance(run(program, box, folder / name, settings, 1).states, best.states)
        for name, settings in halves(scene, arguments.reference).items()
    }
    bound = sum(parts.values())
    print(
        "the reference errs by " + " + ".join(f"{value:.1e} ({name})" for name, value in parts.items()),
        flush=True,
    )
    outcomes = []
    for of in plan(scene):
        if not arguments.knob or of.knob in arguments.knob:
            outcome = run(program, box, folder / "run", {**base(scene), **of.settings}, arguments.repeat)
            outcomes.append((of, outcome))
            error = distance(outcome.states, best.states)
            print(f"{of.knob:<20} {of.value:9.3g} {error:9.2e} {outcome.seconds:8.3f} s", flush=True)
    points = measured(outcomes, best)
    arguments.output.mkdir(parents=True, exist_ok=True)
    write(points, bound, arguments.scene.stem, arguments.output)
    print("\n".join(prices(points)))


def main() -> int:
    arguments = parse()
    try:
        with tempfile.TemporaryDirectory() as folder:
            study(arguments, Path(folder))
    except RunFailed as failure:
        print(f"tradeoff: {failure}", file=sys.stderr)
        return 1
    except (OSError, ValueError, KeyError) as failure:
        print(f"tradeoff: {arguments.scene}: {failure}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
