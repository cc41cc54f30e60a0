"""The paper's error curve (its Figure 5): how the driver's solution converges as h and k are refined.

    python3 verification/convergence.py [--scene paper|paper-isotropic|both] [--sizes 16 32 64 128] [--reference 256]
                                        [--mode both|space|time ...] [--foundation 10] [--experiment]
                                        [--set KEY=VALUE ...] [--driver build/thermocontact] [--output DIR] [--small]

E_hk is the largest value over all common times of ||w - w^hk||_L2 + ||eps(u - u^hk)||_L2 + ||theta - theta^hk||_L2,
with the solution of the reference size in place of the exact one. The meshes are nested: the coarse function is
represented exactly on the reference's mesh, and all integrals are exact. Mode both refines h = k = 1/n, space h alone
and time k alone; the other one is then the reference's. All three are the default.

Errors against a reference that is only twice as fine as the last size overstate the order: with an error C h they are
C (1/n - 1/256), whose last step has the order log2(3) = 1.58 and not 1. So the order of the differences between
n and 2n is given beside it, which has no such bias.

--experiment repeats the curve with loads that grow smoothly from 0 and with a contact conductance that does not jump
where the contact opens, each alone and both; it shows how the orders change, also where early times or the
neighbourhoods of the corners are left out, and where the squared error sits: within 1/8 of each corner, and within
1/32 of the lines along (1, 1) from the lower left corner (diagonal) and from the edges of the contact zone (edges).
--set changes a key of the scene in every run, to see what another part of the model does to the curve.

Exit codes: 0 done, 1 a run failed or the output cannot be written, 2 wrong usage.
"""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from benchmarking.process import ROOT, RunFailed
from convergence_parts import curves, report
from convergence_parts.runs import Problem
from convergence_parts.study import AS_STATED, MODES, Series, solve_all, variants
from plotting.style import Album, styled

SCENES = ("paper", "paper-isotropic")


def progress(text: str) -> None:
    print(text, file=sys.stderr, flush=True)


def setting(text: str) -> tuple[str, str]:
    key, separator, value = text.partition("=")
    if not separator:
        raise argparse.ArgumentTypeError("must be KEY=VALUE")
    return key, value


def parse(arguments: Sequence[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Measure how the solution of the paper's example converges.")
    parser.add_argument("--scene", choices=(*SCENES, "both"), default="both")
    parser.add_argument("--sizes", type=int, nargs="+", default=[16, 32, 64, 128], metavar="N")
    parser.add_argument("--reference", type=int, default=256, metavar="N")
    parser.add_argument("--mode", choices=MODES, nargs="+", default=list(MODES))
    parser.add_argument("--foundation", type=float, default=10.0, metavar="K", help="its temperature")
    parser.add_argument("--experiment", action="store_true", help="why the orders are what they are")
    parser.add_argument("--set", type=setting, action="append", default=[], metavar="KEY=VALUE")
    parser.add_argument("--driver", type=Path, default=ROOT / "build" / "thermocontact")
    parser.add_argument("--output", type=Path, metavar="DIR", help="where tables and pictures go")
    parser.add_argument("--small", action="store_true", help="small PNGs only, for a README")
    options = parser.parse_args(arguments)
    options.sizes, options.mode = sorted(set(options.sizes)), list(dict.fromkeys(options.mode))
    if not options.driver.is_file():
        parser.error(f"no driver at {options.driver}")
    if any(n < 1 or n >= options.reference or options.reference % n for n in options.sizes):
        parser.error("each size must divide the reference and be smaller")
    return options


def solve_scene(options: argparse.Namespace, scene: str) -> list[Series]:
    path = ROOT / "scenes" / f"{scene}.toml"
    found = []
    for variant, settings in variants(path, options.foundation).items():
        if variant != AS_STATED and not options.experiment:
            break
        problem = Problem(options.driver.resolve(), path, {**settings, **dict(options.set)})
        found += solve_all(problem, variant, options.mode, options.sizes, options.reference, progress)
    return found


def text(options: argparse.Namespace, found: Sequence[Series]) -> str:
    tables = [report.table(series) for series in found]
    if options.experiment:
        for scene, mode in dict.fromkeys((series.scene, series.mode) for series in found):
            tables.append(
                report.experiment(
                    [series for series in found if (series.scene, series.mode) == (scene, mode)]
                )
            )
    return "\n".join(tables)


def draw(options: argparse.Namespace, found: Sequence[Series]) -> None:
    album = Album(options.output, options.small)
    with styled():
        as_stated = [series for series in found if series.variant == AS_STATED]
        curves.draw_error_curve(as_stated, album, "error-curve")
        over_time = [series for series in found if series.mode == "both"]
        if options.experiment and over_time:
            curves.draw_over_time(over_time, album, "error-curve-time")
    for path in album.written:
        progress(str(path))


def main(arguments: Sequence[str]) -> int:
    options = parse(arguments)
    scenes = SCENES if options.scene == "both" else (options.scene,)
    try:
        found = [series for scene in scenes for series in solve_scene(options, scene)]
        written = text(options, found)
        print(written)
        if options.output:
            options.output.mkdir(parents=True, exist_ok=True)
            report.write_csv(options.output / "error-curve.csv", found)
            (options.output / "error-curve.txt").write_text(written + "\n", encoding="utf-8")
            draw(options, found)
    except (RunFailed, ValueError, OSError) as problem:
        print(f"convergence: {problem}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
