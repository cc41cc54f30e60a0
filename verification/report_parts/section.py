"""What a section of the report is: the commands that make its results, and how these are read and judged."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

OUT = "{out}"  # in the words of a command: the folder for its results
DRIVER, MANUFACTURED = "{driver}", "{manufactured}"  # programs that were built


class Unreadable(Exception):
    """A section's results are missing or not what its commands write."""


@dataclass(frozen=True)
class Command:
    """`name` tells the commands of a section apart. `hidden` words only say where the programs are. With the exit codes
    `judged` there are results to judge; any other one means that there are none."""

    name: str
    words: Sequence[str]
    hidden: Sequence[str] = ()
    judged: Sequence[int] = (0, 1)


@dataclass(frozen=True)
class Kept:
    """A command that was run: its exit code and all it printed."""

    command: Command
    exit_code: int
    printed: str
    seconds: float
    finished: str  # local time, ISO 8601
    version: str  # of the driver and its sources


@dataclass(frozen=True)
class Findings:
    """`worst`: the verdict in words, the worst number against its tolerance. `blocks`: HTML."""

    passes: bool
    worst: str
    blocks: Sequence[str]


@dataclass(frozen=True)
class Section:
    """`commands(small)` and `read(folder, kept)`; `files`: whether reading needs only the files in the folder, so that
    results made before can stand in for it."""

    name: str
    title: str
    about: str
    commands: Callable[[bool], Sequence[Command]]
    read: Callable[[Path, Sequence[Kept]], Findings]
    files: bool = False


def last_line(text: str) -> str:
    lines = text.strip().splitlines()
    return lines[-1] if lines else ""
