"""Runs of the driver, on one process or several, from the start or from a checkpoint."""

import json
import os
import signal
import subprocess
import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from under_test import patience

CHECKPOINT = "checkpoint.h5"
MPI = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMP_NUM_THREADS": "1",
}
PATIENCE = patience(300.0)  # s that any run may take


class RunFailed(Exception):
    """A run ended otherwise than it should."""


@dataclass(frozen=True)
class Program:
    """The driver with a scene and the settings of all its runs."""

    driver: Path
    scene: Path
    settings: Mapping[str, Any] = field(default_factory=dict)

    def start(
        self, output: Path, restart: Path | None = None, processes: int = 1, **settings: Any
    ) -> "subprocess.Popen[str]":
        """Settings are scene keys with `__` for the dot."""
        command = ["mpirun", "-n", str(processes)] if processes > 1 else []
        command += [str(self.driver), "run", str(self.scene), "--quiet", "--output", str(output)]
        here = {key.replace("__", "."): value for key, value in settings.items()}
        for key, value in {**self.settings, **here}.items():
            command += ["--set", f"{key}={json.dumps(value)}"]
        if restart:
            command += ["--restart", str(restart)]
        return subprocess.Popen(
            command,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
            env={**os.environ, **MPI},
        )

    def run(
        self, output: Path, restart: Path | None = None, processes: int = 1, **settings: Any
    ) -> Mapping[str, Any]:
        """The summary of a run that must complete."""
        process = self.start(output, restart, processes, **settings)
        _, errors = process.communicate(timeout=PATIENCE)
        if process.returncode != 0:
            raise RunFailed(f"{output.name}: exit {process.returncode}: {errors.strip()}")
        summary: dict[str, Any] = json.loads((output / "summary.json").read_text(encoding="utf-8"))
        if summary["status"] != "completed":
            raise RunFailed(f"{output}: {summary['status']}")
        return summary


def wait_for_checkpoint(process: "subprocess.Popen[str]", folder: Path) -> bool:
    """Until there is a checkpoint; False where the process ended first."""
    while not (folder / CHECKPOINT).exists():
        if process.poll() is not None:
            return (folder / CHECKPOINT).exists()
        time.sleep(0.0005)
    return True


def wait_for_rows(process: "subprocess.Popen[str]", folder: Path, rows: int) -> None:
    """Until history.csv has so many rows, or the process has ended."""
    file = folder / "history.csv"
    while process.poll() is None and (not file.exists() or file.read_bytes().count(b"\n") <= rows):
        time.sleep(0.0005)


def drivers_below(pid: int) -> list[int]:
    """The processes of the driver that mpirun started, or the driver itself."""
    try:
        name = Path(f"/proc/{pid}/comm").read_text(encoding="utf-8").strip()
        children = Path(f"/proc/{pid}/task/{pid}/children").read_text(encoding="utf-8").split()
    except OSError:
        return []
    return [pid] if name.startswith("thermoc") else [d for c in children for d in drivers_below(int(c))]


def kill(process: "subprocess.Popen[str]", which: int) -> None:
    """SIGKILL to one process of the run; mpirun then ends the others."""
    pids = drivers_below(process.pid)
    if pids:
        os.kill(pids[which % len(pids)], signal.SIGKILL)
    process.communicate(timeout=PATIENCE)
