"""One whole process of the driver or of the oracle: wall time, peak memory, its summary."""

import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
SCENE = ROOT / "scenes" / "paper-isotropic.toml"
ORACLE = ROOT / "verification" / "oracle.py"
FOUNDATION_TEMPERATURE = 10.0
NORMS = ("velocity_l2", "displacement_strain_l2", "temperature_l2")

# One thread everywhere: BLAS and OpenMP, the ordering of the oracle's factorisation; and MPI may run as root.
ENVIRONMENT = {
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "SCOTCH_PTHREAD_NUMBER": "1",
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
}


class RunFailed(Exception):
    """A program of the benchmark did not do its work."""


@dataclass(frozen=True)
class Run:
    wall_seconds: float
    peak_memory_mib: float
    summary: Mapping[str, Any]

    @property
    def step_seconds(self) -> float:
        return float(self.summary["seconds"]["steps"]) / int(self.summary["scene"]["time"]["steps"])

    @property
    def norms(self) -> list[float]:
        return [float(self.summary["final"][name]) for name in NORMS]


def driver_command(driver: Path) -> list[str]:
    return [str(driver.resolve()), "run"]


def oracle_command() -> list[str]:
    return [sys.executable, str(ORACLE)]


def run(program: Sequence[str], n: int, threads: int = 1) -> Run:
    """n cells a side, n steps, no field output."""
    settings = {
        "mesh.cells": f"[{n},{n}]",
        "time.steps": str(n),
        "output.fields": "[]",
        "boundary.bottom.contact.conductance.foundation_temperature": str(FOUNDATION_TEMPERATURE),
    }
    with tempfile.TemporaryDirectory(prefix="benchmark-") as folder:
        command = [*program, str(SCENE), "--output", folder, "--quiet"]
        for key, value in settings.items():
            command += ["--set", f"{key}={value}"]
        wall_seconds, peak_memory_mib = timed(command, threads)
        summary = json.loads((Path(folder) / "summary.json").read_text(encoding="utf-8"))
    return Run(wall_seconds, peak_memory_mib, summary)


def timed(command: Sequence[str], threads: int = 1) -> tuple[float, float]:
    """Wall seconds and peak memory in MiB as the system saw them."""
    environment = {**os.environ, **ENVIRONMENT, "OMP_NUM_THREADS": str(threads)}
    with tempfile.TemporaryFile() as messages:
        begin = time.perf_counter()
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=messages, env=environment)
        _, status, usage = os.wait4(process.pid, 0)
        wall_seconds = time.perf_counter() - begin
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            messages.seek(0)
            last = messages.read().decode(errors="replace").strip()[-2000:]
            raise RunFailed(f"{' '.join(command)}\nended with {process.returncode}: {last}")
    return wall_seconds, usage.ru_maxrss / 1024.0


def timed_output(command: Sequence[str]) -> tuple[float, str]:
    """Wall seconds, and what the program printed."""
    begin = time.perf_counter()
    done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, **ENVIRONMENT})
    seconds = time.perf_counter() - begin
    if done.returncode != 0:
        raise RunFailed(f"{' '.join(command)}\nended with {done.returncode}: {done.stderr.strip()[-2000:]}")
    return seconds, done.stdout


def disagreement(a: Run, b: Run) -> float:
    """The largest relative difference of the norms of the final fields."""
    pairs = zip(a.norms, b.norms)
    return max((abs(x - y) / max(abs(x), abs(y)) for x, y in pairs if x != y), default=0.0)
