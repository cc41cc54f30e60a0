"""A copy of the project with a build of its own, in which one thing at a time is made wrong."""

import os
import shutil
import subprocess
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from .mutation import Mutation

ROOT = Path(__file__).resolve().parents[2]
PASSED_OVER = {"__pycache__", "build", ".git"}
# quick to compile; what is compiled for one machine only would not come from a cache of another
FLAGS = (
    "-DCMAKE_BUILD_TYPE=Release",
    "-DCMAKE_C_FLAGS_RELEASE=-O1",
    "-DCMAKE_CXX_FLAGS_RELEASE=-O1",
    "-DTHERMOCONTACT_NATIVE=OFF",
)


class CannotCheck(Exception):
    """The check itself failed: no verdict on the code."""


def call(*command: str | Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)


def must(what: str, *command: str | Path) -> str:
    """The output of a command that has to succeed."""
    result = call(*command)
    if result.returncode != 0:
        raise CannotCheck(
            f"{what} failed with exit code {result.returncode}:\n{result.stdout}{result.stderr}"
        )
    return result.stdout


def last_line(text: str) -> str:
    lines = text.strip().splitlines()
    return lines[-1] if lines else "no message"


def mirror(source: Path, target: Path) -> None:
    """Make the folder `target` like `source`, with its times; what has the same time and size stays untouched."""
    target.mkdir(parents=True, exist_ok=True)
    wanted = {entry.name: entry for entry in os.scandir(source) if entry.name not in PASSED_OVER}
    for entry in os.scandir(target):
        if entry.name not in wanted and entry.name not in PASSED_OVER:
            shutil.rmtree(entry.path) if entry.is_dir() else os.remove(entry.path)
    for name, entry in wanted.items():
        copy = target / name
        if entry.is_dir():
            mirror(Path(entry.path), copy)
        elif not copy.exists() or stamp(copy) != stamp(Path(entry.path)):
            copy.unlink(missing_ok=True)  # a program that still runs cannot be written to
            shutil.copy2(entry.path, copy)


def stamp(path: Path) -> tuple[int, int]:
    status = path.stat()
    return status.st_mtime_ns, status.st_size


class Workspace:
    """A copy of `folders` of the project in `work`, configured with `switches`, built, and kept clean beside it."""

    def __init__(self, work: Path, folders: Sequence[str], switches: Sequence[str], *targets: str) -> None:
        self.project, self.build, self.clean = work / "project", work / "project" / "build", work / "clean"
        self.targets = targets
        for folder in folders:
            mirror(ROOT / folder, self.project / folder)
        shutil.copy2(ROOT / "CMakeLists.txt", self.project)
        if self.clean.exists():
            self._restore()  # what an interrupted run left half built
        must("cmake", "cmake", "-S", self.project, "-B", self.build, "-G", "Ninja", *FLAGS, *switches)
        problem = self.make(*targets)
        if problem:
            raise CannotCheck(f"the build of the untouched code failed:\n{problem}")
        mirror(self.build, self.clean)

    def make(self, *targets: str) -> str:
        """Build; empty, or what went wrong."""
        result = call("ninja", "-C", self.build, *(targets or self.targets))
        if result.returncode == 0:
            return ""
        lines = (result.stdout + result.stderr).splitlines()
        return next((line for line in lines if "rror" in line), lines[-1])

    @contextmanager
    def mutated(self, mutation: Mutation) -> Iterator[None]:
        """The sources with that mutation, not yet built. After it, sources and build are clean again with their
        times, lest they be built again."""
        path = self.project / mutation.file
        original, times = path.read_text(encoding="utf-8"), path.stat()
        if original.count(mutation.text) != 1:
            raise CannotCheck(f"{mutation.file} holds {original.count(mutation.text)} times: {mutation.text}")
        path.write_text(original.replace(mutation.text, mutation.wrong), encoding="utf-8")
        try:
            yield
        finally:
            path.write_text(original, encoding="utf-8")
            os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))
            self._restore()

    def _restore(self) -> None:
        mirror(self.clean, self.build)
