"""Endurance: 20 thousand steps of a cyclic stick-slip scene, on one process and on two.

    python3 verification/endurance.py [--cycles N] [--processes P]... [--driver PROGRAM]

A block is rubbed to and fro on a foundation (endurance_parts/cyclic.toml): it sticks at each turn and slips between,
100 steps a cycle, 200 cycles. Asked of every number of processes (one: strategy condensed, more: newton-krylov):

- the audits of all steps are below 1e-9;
- it sticks and slips in the last cycle as in all others: slip fraction 1 and below 1/2;
- the last cycle is that in the middle of the run: a column of history.csv differs by at most 1e-8 of its largest
  value in the cycle. A step errs by solver.tolerance, 1e-10, and friction and viscosity wipe out in a cycle what they
  are given: the errors of the 100 steps of one cycle may add up, those of older ones are gone;
- energy does not drift: what the balance of all steps together lacks, summed here from the columns, is below 1e-9 of
  what friction and viscosity took;
- memory is flat: the processes are no larger in the second half of the run than in the first, but for one large page
  (2 MiB) each.

Exit codes: 0 all so, 1 not.
"""

import argparse
import sys
import tempfile
import threading
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from restart_parts.runs import Program, RunFailed, drivers_below
from under_test import DRIVER, patience

SCENE = Path(__file__).resolve().parent / "endurance_parts" / "cyclic.toml"
CYCLE = 100  # steps
AUDIT, SAME_CYCLE, DRIFT = 1e-9, 1e-8, 1e-9
PAGE = 2 << 20  # bytes
PATIENCE = patience(3000.0)  # s
History = dict[str, npt.NDArray[np.float64]]
RESIDUALS = ("energy_residual", "force_residual", "heat_residual")
COUNTS = ("step", "time", "newton_iterations", "heat_iterations")
TAKEN = (
    "kinetic_numerical_dissipation",
    "strain_numerical_dissipation",
    "viscous_dissipation",
    "compliance_work",
    "friction_dissipation",
)
GIVEN = ("load_work", "thermal_work", "reaction_work")


@dataclass
class Memory:
    """What the processes of a run hold, bytes, as it goes on: [(rows of its history, bytes)]."""

    samples: list[tuple[int, int]] = field(default_factory=list)

    def watch(self, pid: int, history: Path, over: threading.Event) -> None:
        while not over.wait(0.1):
            held = sum(resident(driver) for driver in drivers_below(pid))
            if held and history.exists():
                self.samples.append((history.read_bytes().count(b"\n") - 1, held))

    def largest(self, first: int, last: int) -> int:
        return max((held for rows, held in self.samples if first <= rows < last), default=0)


def resident(pid: int) -> int:
    try:
        lines = Path(f"/proc/{pid}/status").read_text(encoding="ascii").splitlines()
    except OSError:  # it has ended
        return 0
    return next((1024 * int(line.split()[1]) for line in lines if line.startswith("VmRSS:")), 0)


def rub(driver: Path, folder: Path, cycles: int, processes: int) -> tuple[History, Memory]:
    """The history of a run and its memory. Raises RunFailed."""
    memory, over = Memory(), threading.Event()
    strategy = "condensed" if processes == 1 else "newton-krylov"
    settings = {"time.end": cycles, "time.steps": CYCLE * cycles, "solver.strategy": strategy}
    run = Program(driver, SCENE, settings).start(folder, processes=processes)
    watcher = threading.Thread(target=memory.watch, args=(run.pid, folder / "history.csv", over))
    watcher.start()
    try:
        _, errors = run.communicate(timeout=PATIENCE)
    finally:
        run.kill()
        over.set()
        watcher.join()
    if run.returncode != 0:
        raise RunFailed(f"exit {run.returncode}: {errors.strip()}")
    table: Any = np.genfromtxt(folder / "history.csv", delimiter=",", names=True)
    return {name: table[name] for name in table.dtype.names or ()}, memory


def drift(history: History) -> float:
    """What the energy balance of the steps after the first lacks, relative to what was dissipated."""
    energy = history["kinetic_energy"] + history["strain_energy"]
    taken = sum(float(np.sum(history[name][1:])) for name in TAKEN)
    given = sum(float(np.sum(history[name][1:])) for name in GIVEN)
    dissipated = sum(
        float(np.sum(history[name][1:])) for name in ("friction_dissipation", "viscous_dissipation")
    )
    return abs(energy[-1] - energy[0] + taken - given) / dissipated


def change_of_cycle(history: History, cycles: int) -> tuple[float, str]:
    """The largest difference of the last cycle to that in the middle, and the column that has it."""
    worst = (0.0, "")
    for name, values in history.items():
        if name not in (*RESIDUALS, *COUNTS):
            last = values[-CYCLE:]
            middle = values[CYCLE * (cycles // 2 - 1) : CYCLE * (cycles // 2)]
            size = float(np.max(np.abs(last)))
            if size > 0:
                worst = max(worst, (float(np.max(np.abs(last - middle))) / size, name))
    return worst


def findings(history: History, memory: Memory, cycles: int) -> list[tuple[str, bool]]:
    """What is said of a run, and whether it is as it should be."""
    audit = max(float(np.max(history[name])) for name in RESIDUALS)
    slip = history["slip_fraction"][-CYCLE:]
    change, column = change_of_cycle(history, cycles)
    lacking = drift(history)
    steps = CYCLE * cycles
    processes_begin, processes_end = memory.largest(steps // 10, steps // 2), memory.largest(
        steps // 2, steps
    )
    rise = processes_end - processes_begin
    return [
        (f"{len(history['step'])} of {steps} steps", len(history["step"]) == steps),
        (f"largest residual of an audit {audit:.1e}", audit <= AUDIT),
        (
            f"slips on {slip.min():.0%} to {slip.max():.0%} of the contact",
            slip.min() < 0.5 and slip.max() == 1.0,
        ),
        (f"the last cycle differs from the middle one by {change:.1e} ({column})", change <= SAME_CYCLE),
        (f"energy that is missing: {lacking:.1e} of what was dissipated", lacking <= DRIFT),
        (
            f"memory {processes_begin >> 20} MiB, then {rise / 2**20:+.1f}",
            processes_begin > 0 and rise <= PAGE,
        ),
    ]


def parse(words: Sequence[str] | None = None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Rub a block to and fro, 20 thousand steps.")
    parser.add_argument("--cycles", type=int, default=200, metavar="N")
    parser.add_argument("--processes", type=int, action="append", metavar="P", help="default: 1 and 2")
    parser.add_argument("--driver", type=Path, default=DRIVER)
    return parser.parse_args(words)


def main() -> int:
    arguments = parse()
    failed = False
    for processes in arguments.processes or (1, 2):
        start = time.monotonic()
        with tempfile.TemporaryDirectory() as folder:
            try:
                history, memory = rub(arguments.driver.resolve(), Path(folder), arguments.cycles, processes)
            except RunFailed as failure:
                print(f"endurance: {processes} processes: {failure}", file=sys.stderr)
                return 1
        found = findings(history, memory, arguments.cycles)
        print(f"{processes} process{'es' if processes > 1 else ''}, {time.monotonic() - start:.0f} s")
        for text, good in found:
            print(f"  {'' if good else 'FAIL: '}{text}")
        failed = failed or not all(good for _, good in found)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
