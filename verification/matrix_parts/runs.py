"""Start the programs: the driver once for each scene, the oracle in a few processes that take many scenes each."""

import json
import subprocess
import sys
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import oracle_results

HERE = Path(__file__).resolve().parent.parent
Job = tuple[Path, Path]  # scene file, output directory

REFUSED = 2


class Driver:
    def __init__(self, program: Path) -> None:
        self.program = program

    def schema(self) -> str:
        return self._call("schema", "--format", "json").stdout

    def run(self, scene: Path, directory: Path) -> str:
        """Empty, or what went wrong."""
        result = self._call("run", str(scene), "--quiet", "--output", str(directory))
        return "" if result.returncode == 0 else f"driver: exit {result.returncode}: {result.stderr.strip()}"

    def check(self, scene: Path) -> tuple[int, str]:
        """The exit code and the message."""
        result = self._call("check", str(scene))
        return result.returncode, result.stderr.strip()

    def _call(self, *words: str) -> "subprocess.CompletedProcess[str]":
        return subprocess.run([str(self.program), *words], capture_output=True, text=True)


def oracle(jobs: Sequence[Job], folder: Path, workers: int) -> None:
    """Every job, dealt out to that many processes at a time."""
    new = _new(jobs, 1)
    lists = [new[number::workers] for number in range(workers)]
    commands = [_command(part, folder / f"jobs-{number}.json") for number, part in enumerate(lists) if part]
    with ThreadPoolExecutor(max_workers=workers) as pool:
        list(pool.map(_start, commands))
    _keep(new, 1)


def oracle_on_ranks(jobs: Sequence[Job], folder: Path, ranks: int) -> None:
    if new := _new(jobs, ranks):
        _start(["mpirun", "-n", str(ranks), *_command(new, folder / f"jobs-ranks-{ranks}.json")])
        _keep(new, ranks)


def _new(jobs: Sequence[Job], ranks: int) -> list[Job]:
    """Those whose results are not kept from an earlier run; the others' are fetched."""
    new = []
    for scene, directory in jobs:
        if oracle_results.fetch(scene, directory, ranks=ranks, followed=followed(directory)):
            code_file(directory).write_text("0", encoding="ascii")
        else:
            new.append((scene, directory))
    return new


def _keep(jobs: Sequence[Job], ranks: int) -> None:
    for scene, directory in jobs:
        if not oracle_failure(directory):
            oracle_results.keep(scene, directory, ranks=ranks, followed=followed(directory))


def _command(jobs: Sequence[Job], file: Path) -> list[str]:
    file.write_text(json.dumps([[str(scene), str(directory)] for scene, directory in jobs]), encoding="utf-8")
    return [sys.executable, "-m", "matrix_parts.worker", str(file)]


def _start(command: Sequence[str]) -> None:
    """Its success is not asked for: a scene without a code file was not solved."""
    subprocess.run(command, cwd=HERE)


def followed(directory: Path) -> Path:
    """The driver's results beside the oracle's: the latter takes their steps where these are adapted."""
    return directory.with_name("driver")


def oracle_failure(directory: Path) -> str:
    """Empty, or what went wrong."""
    file = code_file(directory)
    code = file.read_text(encoding="ascii") if file.exists() else "none"
    return "" if code == "0" else f"oracle: exit {code}"


def code_file(directory: Path) -> Path:
    """Where worker.py says how the oracle ended."""
    return directory.with_name(directory.name + ".code")
