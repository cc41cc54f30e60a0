"""Runs of the driver on the cases, each with a time limit."""

import subprocess
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from extremes_parts.cases import Case
from matrix_parts.scenes import Flat, write
from under_test import patience

LIMIT = patience(60.0)  # s
HANGS = -1000  # in place of an exit code


@dataclass(frozen=True)
class Ended:
    """How a run ended: exit code (negative: the signal), last line of stderr, seconds."""

    directory: Path
    code: int
    message: str
    seconds: float

    def text(self) -> str:
        if self.code == HANGS:
            return f"not finished after {LIMIT:.0f} s"
        what = f"signal {-self.code}" if self.code < 0 else f"exit {self.code}"
        return f"{what}: {self.message or 'no message'}"


class Driver:
    """Scenes and results below one folder."""

    def __init__(self, program: Path, folder: Path) -> None:
        self.program, self.folder = program, folder
        folder.mkdir(parents=True, exist_ok=True)

    def run(self, name: str, scene: Flat) -> Ended:
        file, directory = self.folder / f"{name}.toml", self.folder / name
        write(file, scene)
        return self._start(
            [str(self.program), "run", str(file), "--quiet", "--output", str(directory)], directory
        )

    def case(self, number: int, case: Case) -> Ended:
        steps = int(case.scene["time.steps"])
        return self.run(f"case-{number}", {"output.every": max(1, steps // 4), **case.scene})

    def _start(self, command: Sequence[str], directory: Path) -> Ended:
        start = time.monotonic()
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=LIMIT, check=False)
        except subprocess.TimeoutExpired:
            return Ended(directory, HANGS, "", time.monotonic() - start)
        lines = done.stderr.strip().splitlines()
        return Ended(directory, done.returncode, lines[-1] if lines else "", time.monotonic() - start)
