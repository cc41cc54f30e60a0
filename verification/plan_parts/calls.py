"""The program's commands, and the settings that its plans print."""

import json
import os
import shlex
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from benchmarking.process import ENVIRONMENT


@dataclass(frozen=True)
class Settings:
    """KEY=VALUE each, as --set takes them, and how many steps they make."""

    words: Sequence[str]
    steps: int

    def value(self, key: str) -> str | None:
        found = [word.partition("=")[2] for word in self.words if word.startswith(key + "=")]
        return found[-1] if found else None

    def replaced(self, key: str, value: str, steps: int | None = None) -> "Settings":
        others = [word for word in self.words if not word.startswith(key + "=")]
        return Settings([*others, f"{key}={value}"], steps or self.steps)

    @property
    def cells(self) -> list[int]:
        found: list[int] = json.loads(self.value("mesh.cells") or "[]")
        return found

    def at_instants(self, count: int) -> "Settings":
        """With fields at so many equal instants."""
        return self.replaced("output.every", str(self.steps // count))


@dataclass(frozen=True)
class Program:
    """`changed`: KEY=VALUE, of every scene."""

    driver: Path
    scenes: Path
    changed: Sequence[str] = ()

    def call(self, command: str, scene: str, *words: str) -> "subprocess.CompletedProcess[str]":
        file = str(self.scenes / f"{scene}.toml")
        environment = {**os.environ, **ENVIRONMENT}
        sets = [word for setting in self.changed for word in ("--set", setting)]
        return subprocess.run(
            [str(self.driver), command, file, *sets, *words], capture_output=True, text=True, env=environment
        )

    def printed(self, scene: str, folder: Path, *words: str) -> tuple[list[str], dict[str, Any]]:
        """The settings of the command that `plan` prints, and the summary of that command run as printed."""
        plan = self.call("plan", scene, *words)
        line = next((line for line in plan.stdout.splitlines() if line.startswith("run ")), None)
        if plan.returncode != 0 or line is None:
            raise RuntimeError(f"{scene}: exit {plan.returncode}: {plan.stdout}{plan.stderr}")
        _, name, command, *rest = shlex.split(line)
        assert (name, command) == ("thermocontact", "run"), line
        environment = {**os.environ, **ENVIRONMENT}
        subprocess.run(
            [str(self.driver), command, *rest, "--quiet", "--output", str(folder)],
            check=True,
            env=environment,
        )
        summary: dict[str, Any] = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        return [word for word in rest if "=" in word], summary

    def run(self, scene: str, folder: Path, settings: Settings, fields: Sequence[str]) -> None:
        words = [*settings.words, f"output.fields={json.dumps(fields)}"]
        sets = [word for setting in words for word in ("--set", setting)]
        done = self.call("run", scene, "--quiet", "--output", str(folder), *sets)
        if done.returncode != 0:
            raise RuntimeError(f"{scene}: exit {done.returncode}: {done.stderr}")
