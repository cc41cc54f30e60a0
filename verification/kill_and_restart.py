"""Kill runs at random moments, restart each from its checkpoint, and compare with the run that was not killed.

    kill_and_restart.py [SCENE.toml] [--kills N] [--processes P] [--seed S] [--driver PROGRAM]

A trial starts the scene in a folder of its own, waits for the first checkpoint, for a random number of steps and for
a random part of a few more, and sends SIGKILL (to one process of several). Every other restart is killed as well. The last
one must complete; on one process every field file must then be the same byte by byte, in the same folder, with the
history to 1e-13 and no row missing or twice. Then SIGINT and SIGTERM: exit codes 130 and 143, status "interrupted",
and a restart that ends with the same result. On several processes the results must agree to 1e-9, as runs on
different processes do.
"""

import argparse
import json
import os
import random
import signal
import sys
import tempfile
import time
from pathlib import Path

from restart_parts.runs import (
    CHECKPOINT,
    PATIENCE,
    Program,
    RunFailed,
    drivers_below,
    kill,
    wait_for_checkpoint,
    wait_for_rows,
)
from restart_parts.same import Differs, check_same_files, history_distance

HERE = Path(__file__).resolve().parent
ONE_PROCESS, SEVERAL = 1e-13, 1e-9
SETTINGS = {"mesh.cells": [24, 24], "time.steps": 128, "output.every": 8}
FEWER = {"time.steps": 40}  # on several processes, where a step takes longer
INTERVALS = (1, 3, 10)  # output.checkpoint_every of the trials in turn


def parse() -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("scene", nargs="?", type=Path, default=HERE.parent / "scenes" / "paper.toml")
    parser.add_argument("--kills", type=int, default=50)
    parser.add_argument("--processes", type=int, default=1)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--driver", type=Path, default=HERE.parent / "build" / "thermocontact")
    return parser.parse_args()


class Trials:
    """Runs below one folder against the whole one."""

    def __init__(self, program: Program, folder: Path, processes: int, seed: int) -> None:
        self.program, self.folder, self.processes = program, folder, processes
        self.random = random.Random(seed)
        self.steps = int(program.settings["time.steps"])
        self.whole = folder / "whole"
        process = program.start(self.whole, None, processes, output__checkpoint_every=1)
        wait_for_checkpoint(process, self.whole)
        begin = time.perf_counter()
        _, errors = process.communicate(timeout=PATIENCE)
        self.seconds = time.perf_counter() - begin  # of the steps
        if process.returncode != 0:
            raise RunFailed(f"the whole run: exit {process.returncode}: {errors}")

    def attempt(self, folder: Path, every: int) -> bool:
        """Start or restart, and kill at a random moment; False where the run was done before."""
        checkpoint = folder / CHECKPOINT
        restart = checkpoint if checkpoint.exists() else None
        process = self.program.start(folder, restart, self.processes, output__checkpoint_every=every)
        wait_for_checkpoint(process, folder)
        wait_for_rows(process, folder, self.random.randrange(self.steps))
        time.sleep(self.random.uniform(0, 4 * self.seconds / self.steps))
        if process.poll() is not None:
            process.communicate()
            return False
        kill(process, self.random.randrange(self.processes))
        return process.returncode != 0

    def finish(self, folder: Path) -> float:
        """Restart to the end and compare; the difference of the histories."""
        self.program.run(folder, folder / CHECKPOINT, self.processes)
        if self.processes == 1:
            check_same_files(self.whole, folder)
        return history_distance(self.whole, folder)

    def killed(self, kills: int) -> float:
        """As many kills as asked for, two in a row in every other trial."""
        done, trial, worst, from_step = 0, 0, 0.0, []
        while done < kills:
            folder = self.folder / f"trial-{trial}"
            for _ in range(1 + trial % 2):
                done += self.attempt(folder, INTERVALS[trial % len(INTERVALS)])
            worst = max(worst, self.finish(folder))
            summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
            from_step.append(summary.get("restarted_after_step", 0))
            trial += 1
        print(f"{done} kills in {trial} trials, restarted after steps {sorted(from_step)}")
        return worst

    def interrupted(self, number: signal.Signals) -> float:
        """End a run by a signal that it can see."""
        folder = self.folder / number.name
        process = self.program.start(folder, None, self.processes)
        wait_for_rows(process, folder, 3)
        for pid in drivers_below(process.pid):
            os.kill(pid, number)
        _, errors = process.communicate(timeout=PATIENCE)
        if process.returncode != 128 + number:
            raise Differs(f"{number.name}: exit {process.returncode} instead of {128 + number}: {errors}")
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        if summary["status"] != "interrupted":
            raise Differs(f"{number.name}: status {summary['status']}")
        worst = self.finish(folder)
        print(
            f"{number.name}: exit {process.returncode} after step {summary['steps']}, gone on with to the end"
        )
        return worst


def main() -> int:
    """Print what was done and the largest difference; 1 if a restart failed or differs."""
    arguments = parse()
    settings = {**SETTINGS, **(FEWER if arguments.processes > 1 else {})}
    program = Program(arguments.driver.resolve(), arguments.scene, settings)
    allowed = ONE_PROCESS if arguments.processes == 1 else SEVERAL
    try:
        with tempfile.TemporaryDirectory() as folder:
            trials = Trials(program, Path(folder), arguments.processes, arguments.seed)
            worst = trials.killed(arguments.kills)
            worst = max(worst, *map(trials.interrupted, (signal.SIGINT, signal.SIGTERM)))
    except (RunFailed, Differs) as failure:
        print(f"FAILED: {failure}")
        return 1
    print(f"largest difference {worst:.1e}, allowed {allowed:.0e}")
    return 0 if worst <= allowed else 1


if __name__ == "__main__":
    sys.exit(main())
