"""Runs of the driver: each choice once for its fields, kept; times in rounds, one choice after the other in each."""

import json
import os
import statistics
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from benchmarking.process import ENVIRONMENT
from lattice_errors import Solution, read
from tradeoff_parts.choice import Choice
from tradeoff_parts.facts import Facts

PARTS = ("setup", "factor", "steps")  # of the time that counts
ROUNDS_BELOW = 10.0  # s: what takes longer is timed once


@dataclass(frozen=True)
class Failed:
    reason: str


@dataclass(frozen=True)
class Done:
    solution: Solution
    summary: Mapping[str, Any]


@dataclass(frozen=True)
class Seconds:
    """Medians over the rounds."""

    setup: float
    factor: float
    steps: float
    rounds: int

    @property
    def total(self) -> float:
        return self.setup + self.factor + self.steps


class Runs:
    """`limit`: the seconds that a run may take. A run that fails or takes longer is a result, `Failed`. `changed`: keys of
    the scene that are other ones in all runs."""

    def __init__(
        self,
        driver: Path,
        scene: Path,
        facts: Facts,
        folder: Path,
        limit: float,
        jobs: int,
        changed: Mapping[str, Any] | None = None,
    ) -> None:
        self.driver, self.scene, self.facts, self.changed = driver, scene, facts, changed or {}
        self.folder, self.limit, self.jobs = folder, limit, jobs
        self.kept: dict[str, Done | Failed] = {}

    def all(self, choices: Sequence[Choice]) -> None:
        """Runs those that have not been run, several at a time."""
        keys = {self.key(choice): choice for choice in choices}
        missing = {key: choice for key, choice in keys.items() if key not in self.kept}
        with ThreadPoolExecutor(self.jobs) as pool:
            self.kept |= zip(missing, pool.map(self._with_fields, missing.values()))

    def of(self, choice: Choice) -> Done | Failed:
        self.all([choice])
        return self.kept[self.key(choice)]

    def key(self, choice: Choice) -> str:
        """Choices that differ in what the scene does not have are one."""
        return json.dumps(choice.settings(self.facts), sort_keys=True)

    def _with_fields(self, choice: Choice) -> Done | Failed:
        fields = list(self.facts.fields)
        every = 1 if choice.time.tolerance else max(1, choice.time.steps // self.facts.outputs)
        with tempfile.TemporaryDirectory(dir=self.folder) as name:
            summary = self._run(choice, Path(name), {"output.fields": fields, "output.every": every})
            if isinstance(summary, Failed):
                return summary
            try:
                return Done(read(Path(name)), summary)
            except (OSError, ValueError) as failure:
                return Failed(f"its results cannot be read: {failure}")

    def seconds(self, choices: Sequence[Choice], rounds: int) -> dict[Choice, Seconds | Failed]:
        """Each choice once a round, alone on the machine as far as this program goes."""
        taken: dict[Choice, list[Mapping[str, float]]] = {choice: [] for choice in choices}
        failed: dict[Choice, Failed] = {}
        for number in range(rounds):
            for choice, so_far in taken.items():
                if choice in failed or (number and so_far[0]["total"] > ROUNDS_BELOW):
                    continue
                with tempfile.TemporaryDirectory(dir=self.folder) as name:
                    summary = self._run(choice, Path(name), {"output.fields": []})
                if isinstance(summary, Failed):
                    failed[choice] = summary
                else:
                    so_far.append(summary["seconds"])
        return {choice: failed.get(choice) or medians(rows) for choice, rows in taken.items()}

    def _run(self, choice: Choice, folder: Path, more: Mapping[str, Any]) -> Mapping[str, Any] | Failed:
        settings = {**self.changed, **choice.settings(self.facts), **more}
        return run(self.driver, self.scene, folder, settings, self.limit)


def medians(rows: Sequence[Mapping[str, float]]) -> Seconds:
    setup, factor, steps = (statistics.median(row[part] for row in rows) for part in PARTS)
    return Seconds(setup, factor, steps, len(rows))


def run(
    driver: Path, scene: Path, folder: Path, settings: Mapping[str, Any], limit: float
) -> Mapping[str, Any] | Failed:
    """The summary of a run that completed."""
    command = [str(driver), "run", str(scene), "--quiet", "--output", str(folder)]
    for key, value in settings.items():
        command += ["--set", f"{key}={json.dumps(value)}"]
    environment = {**os.environ, **ENVIRONMENT}
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=limit, env=environment)
    except subprocess.TimeoutExpired:
        return Failed(f"took longer than {limit:g} s")
    except OSError as failure:
        return Failed(str(failure))
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines()
        return Failed(f"exit {done.returncode}: {lines[-1] if lines else 'no message'}")
    try:
        summary: dict[str, Any] = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    except (OSError, ValueError) as failure:
        return Failed(f"no summary: {failure}")
    return summary if summary.get("status") == "completed" else Failed(str(summary.get("status")))
