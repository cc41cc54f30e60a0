"""Strategies and processes compared on bodies in the plane and in space: `benchmark.py --study NAME`.

    ladder      both strategies at every size, and the one that "auto" takes: within 1.5 of the better one?
    scaling     newton-krylov on 1, 2, ... processes: the same body on more of them, and as many unknowns on each;
                Krylov iterations, memory an unknown, messages and bytes of each process from PETSc's log
    multigrid   the driver against the oracle with multigrid, whole processes, as many of each

Medians of the wall times of whole processes. Nothing is judged: the machine may be busy.
"""

import json
import re
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import Any

from benchmarking import process
from benchmarking.process import ROOT, RunFailed

ITERATIONS = re.compile(r"(momentum|heat)_ solve converged due to \S+ iterations (\d+)")
# Both stop where the forces balance to 1e-10; penetrations of 3e-3 that are wrong by as much move the conductance,
# which rises over 1e-5, by 3e-8, and the conductance the temperature. Ten times that.
NORMS_AGREE = 3e-7


@dataclass(frozen=True)
class Body:
    scene: str
    cells: int
    steps: int

    @property
    def settings(self) -> dict[str, str]:
        dimension = 3 if self.scene == "box" else 2
        cells = ",".join([str(self.cells)] * dimension)
        return {"mesh.cells": f"[{cells}]", "time.steps": str(self.steps), "output.fields": "[]"}

    def __str__(self) -> str:
        return f"{self.scene} {self.cells}"


LADDER = [
    *(Body("paper-isotropic", cells, 8) for cells in (16, 64, 128, 256)),
    *(Body("box", cells, 8) for cells in (6, 10, 14, 18, 22, 26)),
]


@dataclass(frozen=True)
class Measured:
    seconds: float
    summary: dict[str, Any]
    log: str

    @property
    def unknowns(self) -> int:
        return sum(self.summary["mesh"]["unknowns"].values())


def run(
    program: Sequence[str], body: Body, processes: int, more: Sequence[str], after: Sequence[str]
) -> Measured:
    with tempfile.TemporaryDirectory(prefix="benchmark-") as folder:
        launch = ["mpirun", "-n", str(processes)] if processes > 1 else []
        scene = str(ROOT / "scenes" / f"{body.scene}.toml")
        command = [*launch, *program, scene, "--output", folder, "--quiet", *more]
        for key, value in body.settings.items():
            command += ["--set", f"{key}={value}"]
        log = Path(folder) / "log.txt"
        if after:
            command += ["--", *after, "-log_view", f":{log}"]
        seconds, printed = process.timed_output(command)
        summary = json.loads((Path(folder) / "summary.json").read_text(encoding="utf-8"))
        return Measured(seconds, summary, printed + (log.read_text(encoding="utf-8") if log.exists() else ""))


def strategy(name: str) -> list[str]:
    return ["--set", f'solver.strategy="{name}"']


def ladder(driver: Sequence[str], repeat: int, largest: int) -> list[dict[str, Any]]:
    rows = []
    for body in LADDER:
        if body.cells > largest:
            continue
        names = ("condensed", "newton-krylov", "auto")
        runs: dict[str, list[Measured]] = {name: [] for name in names}
        for _ in range(repeat):
            for name in names:
                runs[name].append(run(driver, body, 1, strategy(name), []))
        seconds = {name: median(each.seconds for each in runs[name]) for name in names}
        chosen = runs["auto"][0].summary["solver"]
        better = min(seconds["condensed"], seconds["newton-krylov"])
        rows.append(
            {
                "body": str(body),
                "unknowns": runs["auto"][0].unknowns,
                "seconds": seconds,
                "choice": chosen["strategy"],
                "why": chosen["why"],
                "choice_over_better": seconds[chosen["strategy"]] / better,
            }
        )
    return rows


def krylov(measured: Measured) -> dict[str, Any]:
    """Iterations a solve of each balance, and what PETSc's log says of all processes together."""
    found: dict[str, list[int]] = {}
    for name, count in ITERATIONS.findall(measured.log):
        found.setdefault(name, []).append(int(count))
    totals = {}
    for line in measured.log.splitlines():
        if match := re.match(r"(MPI Msg Count|MPI Msg Len \(bytes\)|MPI Reductions|Flops):\s+(.*)", line):
            totals[match.group(1)] = float(match.group(2).split()[0])  # the largest of a process
    return {
        "iterations_a_solve": {name: sum(counts) / len(counts) for name, counts in found.items()},
        "solves": sum(len(counts) for counts in found.values()),
        "iterations": sum(sum(counts) for counts in found.values()),
        "of_a_process": totals,
    }


REASONS = ["-momentum_ksp_converged_reason", "-heat_ksp_converged_reason"]


def scaled(driver: Sequence[str], body: Body, processes: int, repeat: int) -> dict[str, Any]:
    runs = [run(driver, body, processes, strategy("newton-krylov"), REASONS) for _ in range(repeat)]
    first = runs[0]
    return {
        "body": str(body),
        "processes": processes,
        "unknowns": first.unknowns,
        "step_seconds": median(each.summary["seconds"]["steps"] for each in runs) / body.steps,
        "bytes_an_unknown": first.summary["peak_memory_mib"] * 2**20 / first.unknowns,
        **krylov(first),
    }


def scaling(driver: Sequence[str], repeat: int, largest: int, processes: Sequence[int]) -> dict[str, Any]:
    strong = [scaled(driver, Body("box", largest, 2), count, repeat) for count in processes]
    weak = []
    for count in processes:
        cells = round(largest / 2 * count ** (1 / 3))
        weak.append(scaled(driver, Body("box", cells, 2), count, repeat))
    for row in strong:
        row["efficiency"] = strong[0]["step_seconds"] / row["step_seconds"] * processes[0] / row["processes"]
    for row in weak:  # unknowns are not exactly as many on each, iterations are what they are
        work = row["unknowns"] / weak[0]["unknowns"] * processes[0] / row["processes"]
        row["efficiency"] = weak[0]["step_seconds"] / row["step_seconds"] * work
    return {"strong": strong, "weak": weak}


def multigrid(
    driver: Sequence[str], repeat: int, largest: int, processes: Sequence[int]
) -> list[dict[str, Any]]:
    body, rows = Body("box", largest, 10), []
    for count in processes:
        ours, theirs = [], []
        run(process.oracle_command(), Body("box", 2, 1), 1, ["--solver", "amg"], [])  # compiles the forms
        for _ in range(repeat):
            ours.append(run(driver, body, count, strategy("newton-krylov"), []))
            theirs.append(run(process.oracle_command(), body, count, ["--solver", "amg"], []))
        difference = max(_difference(ours[0], each) for each in theirs)
        if not difference <= NORMS_AGREE:
            raise RunFailed(f"{body}: driver and oracle differ by {difference:.1e} in a final norm")
        mine, others = (median(each.seconds for each in runs) for runs in (ours, theirs))
        rows.append(
            {
                "body": str(body),
                "processes": count,
                "unknowns": ours[0].unknowns,
                "driver": mine,
                "oracle": others,
                "ratio": others / mine,
                "difference": difference,
            }
        )
    return rows


def _difference(a: Measured, b: Measured) -> float:
    pairs = [(a.summary["final"][name], b.summary["final"][name]) for name in process.NORMS]
    return max(abs(x - y) / max(abs(x), abs(y)) for x, y in pairs)


def text(study: str, results: Any) -> str:
    lines: dict[str, Callable[[Any], list[str]]] = {
        "ladder": _ladder_text,
        "scaling": _scaling_text,
        "multigrid": _multigrid_text,
    }
    return "\n".join(lines[study](results))


def _ladder_text(rows: Any) -> list[str]:
    lines = [
        f"{'body':>20} {'unknowns':>9} {'condensed':>10} {'krylov':>8} {'auto':>8} {'its choice':>14} {'over':>5}"
    ]
    for row in rows:
        s = row["seconds"]
        lines.append(
            f"{row['body']:>20} {row['unknowns']:>9} {s['condensed']:>9.2f}s {s['newton-krylov']:>7.2f}s "
            f"{s['auto']:>7.2f}s {row['choice']:>14} {row['choice_over_better']:>5.2f}"
        )
    return lines


def _scaling_text(results: Any) -> list[str]:
    lines = []
    for kind, rows in results.items():
        lines += ["", f"{kind} scaling, newton-krylov"]
        lines.append(
            f"{'processes':>9} {'unknowns':>9} {'s a step':>9} {'efficiency':>10} {'iterations a solve':>24} "
            f"{'bytes/unknown':>13} {'messages/it.':>12} {'kB/it.':>8} {'reductions/it.':>14}"
        )
        for row in rows:
            of, its = row["of_a_process"], max(1, row["iterations"])
            solves = ", ".join(f"{name} {value:.1f}" for name, value in row["iterations_a_solve"].items())
            lines.append(
                f"{row['processes']:>9} {row['unknowns']:>9} {row['step_seconds']:>9.2f} {row['efficiency']:>10.2f} "
                f"{solves:>24} {row['bytes_an_unknown']:>13.0f} {of.get('MPI Msg Count', 0) / its:>12.1f} "
                f"{of.get('MPI Msg Len (bytes)', 0) / its / 1e3:>8.1f} {of.get('MPI Reductions', 0) / its:>14.1f}"
            )
    return lines


def _multigrid_text(rows: Any) -> list[str]:
    return [
        f"{row['body']}, {row['unknowns']} unknowns, {row['processes']} processes: driver {row['driver']:.2f} s, "
        f"oracle with multigrid {row['oracle']:.2f} s, ratio {row['ratio']:.1f}; norms differ by {row['difference']:.1e}"
        for row in rows
    ]
