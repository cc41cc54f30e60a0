"""Speed against accuracy: each knob of a scene is turned, its error and its time are measured.

    python3 verification/tradeoff.py [SCENE.toml] [--output DIR] [--finer F] [--rounds R] [--knob NAME]... [--limit S]
                                     [--jobs J] [--set KEY=VALUE]... [--driver PROGRAM] [--small]

SCENE (default: the paper's with K = I) is on a rectangle or box, or a mesh of Gmsh, where the mesh is no knob. The plan
(tradeoff_parts/plan.py) turns mesh, degree, grading, step and scheme, adaptive tolerance, epsilon, contact quadrature,
Newton's tolerance, coupling and strategy, each alone from one base, beside the scene as it is, the paper's choice h = k
and bargains of several. A knob that the scene or the driver does not have is named and left out.

Error: the largest, over output times and the norms ||w||_L2, ||eps(u)||_L2, ||theta||_L2 over the body (lattice_errors),
of the difference to a reference, relative to the largest norm of the reference's field. The reference is finer in all
that errs; by how much it may itself be off is bounded for each source (tradeoff_parts/bounds.py has the derivation) and
printed. Errors below three times that sum are marked, as they may be off by more than a third; those below it are not on
the front.

Beside its error stand its parts: from a configuration to the reference one source after the other is made the
reference's, and the distances of these steps are the parts of solver, coupling, time, regularisation, contact quadrature
and space. By the triangle inequality their sum is at least the error.

Time: setup, factorisations and steps, medians over rounds in which each configuration runs once, alone. A run that fails
or takes longer than --limit is a row that says so. --finer F: F times the cells and steps of the reference.

In DIR: tradeoff.csv (all configurations), prices.csv and .md (what a digit costs, orders), tradeoff.txt, tradeoff.png (and .pdf
but for --small). Exit codes: 0 done, 1 the reference failed or nothing can be written, 2 the scene is not one for it.
"""

import argparse
import csv
import json
import sys
import tempfile
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from tradeoff_parts.facts import Facts, Unfit, absent, facts_of, hindrances, keys, stated
from tradeoff_parts.measure import NoReference, Reference, best_grading, bounds, measured
from tradeoff_parts.picture import draw
from tradeoff_parts.plan import Plan, knobs
from tradeoff_parts.prices import prices
from tradeoff_parts.runs import Failed, Runs, run
from tradeoff_parts.tables import Study, markdown, text, write_points, write_prices
from under_test import DRIVER, ROOT


def setting(words: str) -> tuple[str, Any]:
    key, separator, value = words.partition("=")
    try:
        return key, tomllib.loads(f"value = {value}")["value"]
    except tomllib.TOMLDecodeError as problem:
        raise argparse.ArgumentTypeError("must be KEY=VALUE, a value of TOML") from problem


def positive(words: str) -> int:
    if not words.isdigit() or int(words) == 0:
        raise argparse.ArgumentTypeError("must be a whole number from 1 on")
    return int(words)


def parse(arguments: Sequence[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Measure the trade of speed against accuracy.")
    parser.add_argument("scene", nargs="?", type=Path, default=ROOT / "scenes" / "paper-isotropic.toml")
    parser.add_argument("--output", type=Path, default=Path("tradeoff"), metavar="DIR")
    parser.add_argument("--finer", type=positive, default=1, metavar="F")
    parser.add_argument("--rounds", type=positive, default=3, metavar="R")
    parser.add_argument("--knob", action="append", metavar="NAME", help="these alone; all that begin so")
    parser.add_argument("--limit", type=float, default=300.0, metavar="S", help="seconds that a run may take")
    parser.add_argument(
        "--jobs", type=positive, default=2, metavar="J", help="runs at a time, of those not timed"
    )
    parser.add_argument("--set", type=setting, action="append", default=[], metavar="KEY=VALUE")
    parser.add_argument("--driver", type=Path, default=DRIVER)
    parser.add_argument("--small", action="store_true", help="a small picture, for a README")
    return parser.parse_args(arguments)


def say(words: str) -> None:
    print(words, file=sys.stderr, flush=True)


def first_run(options: argparse.Namespace, folder: Path) -> tuple[Facts, Mapping[str, Any], list[float]]:
    """Facts, the scene with all defaults, and the share of contact after each step. Raises Unfit."""
    schema = keys(options.driver)
    written = stated(options.scene)
    settings: dict[str, Any] = {**dict(options.set), "output.fields": []}
    summary = run(options.driver, options.scene, folder, settings, options.limit)
    if isinstance(summary, Failed):
        raise Unfit(summary.reason)
    resolved = summary["scene"]
    with (folder / "history.csv").open(encoding="utf-8") as file:
        fractions = [float(row.get("contact_fraction") or 0.0) for row in csv.DictReader(file)]
    return facts_of(options.scene.stem, written, resolved, schema), resolved, fractions


def study(options: argparse.Namespace, folder: Path) -> Study:
    facts, resolved, fractions = first_run(options, folder / "first")
    runs = Runs(options.driver, options.scene, facts, folder, options.limit, options.jobs, dict(options.set))
    plan = Plan(facts, options.finer)
    plan = Plan(facts, options.finer, best_grading(runs, plan))
    known = knobs(facts)
    chosen = [of for of in plan.configurations() if wanted(of.knob, options.knob)]
    if not chosen:
        raise Unfit(f"--knob: expected one of {', '.join(known)}")
    say("the reference")
    best = Reference(runs, plan.reference())
    say("the reference made coarser, one source at a time")
    found, unbounded = bounds(runs, plan, best)
    own: dict[str | None, float] = {part.source: part.value for part in found}
    own[None] = sum(own.values())
    points, lost = measured(runs, best, own[None], chosen, options.rounds, say)
    words = json.dumps(best.choice.settings(facts))
    reasons = absent(facts), hindrances(resolved, fractions)
    return Study(facts, words, found, unbounded, points, lost, prices(points, known, own), known, *reasons)


def wanted(knob: str, chosen: Sequence[str] | None) -> bool:
    return chosen is None or any(knob.startswith(name) for name in chosen)


def main(arguments: Sequence[str]) -> int:
    options = parse(arguments)
    options.driver = options.driver.resolve()
    try:
        with tempfile.TemporaryDirectory(prefix="tradeoff-") as folder:
            found = study(options, Path(folder))
        options.output.mkdir(parents=True, exist_ok=True)
        write_points(found, options.output / "tradeoff.csv")
        write_prices(found, options.output / "prices.csv")
        (options.output / "tradeoff.txt").write_text(text(found) + "\n", encoding="utf-8")
        (options.output / "prices.md").write_text(markdown(found), encoding="utf-8")
        draw(found, options.output, options.small)
        print(text(found))
    except Unfit as problem:
        print(f"tradeoff: {options.scene}: {problem}", file=sys.stderr)
        return 2
    except NoReference as problem:
        print(f"tradeoff: {options.scene}: no reference, so no errors: {problem}", file=sys.stderr)
        return 1
    except OSError as problem:
        print(f"tradeoff: {problem}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
