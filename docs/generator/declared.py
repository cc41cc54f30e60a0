"""What the program declares of itself (declarations.cpp), as Python data."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any


@dataclass(frozen=True)
class Option:
    """An option, or an argument, whose name then has no dashes."""

    name: str
    value: str
    help: str
    choices: tuple[str, ...]
    repeatable: bool

    @property
    def names(self) -> list[str]:
        """-h and --help of "-h,--help"."""
        return self.name.split(",")

    @property
    def is_argument(self) -> bool:
        """Whether it stands by itself."""
        return not self.name.startswith("-")

    @property
    def awaits(self) -> str:
        """What completes it: SCENE, CHECKPOINT, FILE, DIR, KEY=VALUE; "" where that is none of them."""
        if self.name in ("SCENE", "--scene"):
            return "SCENE"
        return self.value if self.value in ("CHECKPOINT", "FILE", "DIR", "KEY=VALUE") else ""


@dataclass(frozen=True)
class Command:
    """A command; the first one, without a name, is the program itself."""

    name: str
    help: str
    options: tuple[Option, ...]

    @property
    def flags(self) -> list[Option]:
        """All but the arguments."""
        return [option for option in self.options if not option.is_argument]

    @property
    def argument(self) -> Option | None:
        """The one that it takes."""
        return next((option for option in self.options if option.is_argument), None)


@dataclass(frozen=True)
class Declared:
    """All of it; keys, results and exit codes as the program prints them."""

    version: str
    program: Command
    commands: tuple[Command, ...]
    exit_codes: list[dict[str, Any]]
    keys: list[dict[str, Any]]
    scene_keys_markdown: str
    results: dict[str, list[dict[str, Any]]]

    @property
    def values(self) -> dict[str, list[str]]:
        """Values of the keys that have choices, as TOML has them on a command line; lists have none here."""
        return {
            key["key"]: [f'"{choice}"' for choice in key["choices"]]
            for key in self.keys
            if key["choices"] and key["type"] != "list of choices"
        }


def _command(data: dict[str, Any]) -> Command:
    options = tuple(
        Option(
            option["name"], option["value"], option["help"], tuple(option["choices"]), option["repeatable"]
        )
        for option in data["options"]
    )
    return Command(data["name"], data["help"], options)


def read(path: Path) -> Declared:
    """The declarations in a file."""
    data = json.loads(path.read_text())
    program, *commands = (_command(command) for command in data.pop("commands"))
    return Declared(program=program, commands=tuple(commands), **data)
