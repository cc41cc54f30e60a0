"""Make the pictures of the gallery (docs/gallery.md) again: run its scenes and draw them.

    python3 verification/gallery.py [SCENE...] [--output docs/images] [--driver PROGRAM] [--work DIR]

All of its scenes, or those named; `gallery_parts/entries.py` says what is run and drawn. Results stay in DIR, by default
in a folder that goes away.

Exit codes: 0 drawn, 1 a run failed or a picture cannot be written, 2 the command line or something needed is wrong.
"""

import argparse
import contextlib
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

import animate
import figures
from gallery_parts.entries import ENTRIES, Entry, Film, Run, Still

ROOT = Path(__file__).resolve().parents[1]


class Unmade(Exception):
    """A run or a picture that failed."""


def results_of(run: Run, driver: Path, folder: Path) -> Path:
    command: list[str | Path] = [
        driver,
        "run",
        ROOT / f"scenes/{run.scene}.toml",
        "--quiet",
        "--output",
        folder,
    ]
    for setting in run.settings:
        command += ["--set", setting]
    if subprocess.run(command, check=False).returncode != 0:
        raise Unmade(f"{run.scene}: the run failed")
    return folder


def draw(picture: Still | Film, results: dict[str, Path], work: Path, output: Path) -> None:
    with contextlib.redirect_stdout(sys.stderr):
        if isinstance(picture, Film):
            target = output / picture.image
            code = animate.main([str(results[picture.run]), "--output", str(target), *picture.options])
        else:
            folders = [str(results[name]) for name in picture.runs]
            code = figures.main([*folders, "--output", str(work), "--small", "--only", picture.picture])
            if code == 0:
                shutil.copyfile(work / picture.drawn, output / picture.image)
    if code != 0:
        raise Unmade(f"{picture.image}: exit {code}")


def make(entry: Entry, driver: Path, work: Path, output: Path) -> None:
    results = {
        name: results_of(run, driver, work / f"{entry.scene}-{name}") for name, run in entry.runs.items()
    }
    for picture in entry.pictures:
        draw(picture, results, work / f"{entry.scene}-drawn", output)
        print(output / picture.image, flush=True)


def main(arguments: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(description="Make the pictures of the gallery again.")
    names = [entry.scene for entry in ENTRIES]
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help="one of: " + ", ".join(names))
    parser.add_argument("--output", type=Path, default=ROOT / "docs/images", metavar="DIR")
    parser.add_argument("--driver", type=Path, default=ROOT / "build/thermocontact", metavar="PROGRAM")
    parser.add_argument("--work", type=Path, metavar="DIR", help="where results stay")
    options = parser.parse_args(arguments)
    for name in options.scenes:
        if name not in names:
            parser.error(f"no scene {name} in the gallery; there are {', '.join(names)}")
    try:
        options.output.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory() as folder:
            for entry in ENTRIES:
                if not options.scenes or entry.scene in options.scenes:
                    make(entry, options.driver.resolve(), options.work or Path(folder), options.output)
    except (Unmade, OSError) as problem:
        print(f"gallery: {problem}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
