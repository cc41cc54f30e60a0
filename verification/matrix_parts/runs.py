"""Start the programs: the driver once for each scene, the oracle in a few processes that take many scenes each."""

import json
import subprocess
import sys
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

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
    lists = [list(jobs[number::workers]) for number in range(workers)]
    commands = [_command(part, folder / f"jobs-{number}.json") for number, part in enumerate(lists) if part]
    with ThreadPoolExecutor(max_workers=workers) as pool:
        list(pool.map(_start, commands))


def oracle_on_ranks(jobs: Sequence[Job], folder: Path, ranks: int) -> None:
    _start(["mpirun", "-n", str(ranks), *_command(jobs, folder / f"jobs-ranks-{ranks}.json")])


def _command(jobs: Sequence[Job], file: Path) -> list[str]:
    file.write_text(json.dumps([[str(scene), str(directory)] for scene, directory in jobs]), encoding="utf-8")
    return [sys.executable, "-m", "matrix_parts.worker", str(file)]


def _start(command: Sequence[str]) -> None:
    """Its success is not asked for: a scene without a code file was not solved."""
    subprocess.run(command, cwd=HERE)


def oracle_failure(directory: Path) -> str:
    """Empty, or what went wrong."""
    file = directory.with_name(directory.name + ".code")
    code = file.read_text(encoding="ascii") if file.exists() else "none"
    return "" if code == "0" else f"oracle: exit {code}"
