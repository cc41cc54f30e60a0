"""The tests of ctest, one at a time, in the build of a copy."""

import json
import os
import re
import signal
import subprocess
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .workspace import CannotCheck, must

NOT_ASKED = ("sabotage", "mutation", "fuzz", "restart.fifty-kills")  # they change the code or take too long
SLOWEST, SHORTEST = 10, 60.0  # a test that takes that many times as long as usual, and s, has no end
TELLING = re.compile(r"\[  FAILED  \] \w+[./]\w+|^FAILED|FAIL:|differ|beyond|thermocontact: |rror")


@dataclass(frozen=True)
class Outcome:
    passed: bool
    seconds: float
    how: str  # a line that tells what failed


class Suite:
    """The tests that use what the build made; the others test the verification programs, and cannot notice."""

    def __init__(self, build: Path, oracle_results: Path, usual: dict[str, float]) -> None:
        self.build, self.usual = build, usual  # s, of all copies
        self.environment = os.environ | {
            "GTEST_FAIL_FAST": "1",
            "THERMOCONTACT_ORACLE_RESULTS": str(oracle_results),
        }
        listing = json.loads(must("ctest", "ctest", "--test-dir", build, "--show-only=json-v1"))
        self.names = [
            test["name"]
            for test in listing["tests"]
            if not test["name"].startswith(NOT_ASKED) and str(build) in json.dumps(uses(test))
        ]

    def baseline(self, name: str) -> None:
        """Run a test on the untouched code: it must pass, and shows how long it takes."""
        outcome = self.run(name)
        if not outcome.passed:
            raise CannotCheck(f"untouched code: {name} fails: {outcome.how}")
        self.usual[name] = outcome.seconds

    def order(self, first: Sequence[str]) -> list[str]:
        """Those whose names begin like one of `first`, in that order, then the others, the shortest first."""

        def rank(name: str) -> tuple[int, float]:
            places = [place for place, start in enumerate(first) if name.startswith(start)]
            return min(places, default=len(first)), self.usual[name]

        return sorted(self.names, key=rank)

    def run(self, name: str) -> Outcome:
        limit = max(SHORTEST, SLOWEST * self.usual[name]) if name in self.usual else None
        command = [
            "ctest",
            "--test-dir",
            str(self.build),
            "-R",
            f"^{re.escape(name)}$",
            "--output-on-failure",
        ]
        start = time.monotonic()
        with subprocess.Popen(
            command,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            env=self.environment,
            start_new_session=True,
        ) as process:
            try:
                output, _ = process.communicate(timeout=limit)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                return Outcome(False, time.monotonic() - start, f"no end after {limit:.0f} s")
        return Outcome(process.returncode == 0, time.monotonic() - start, telling_line(output))


def uses(test: dict[str, Any]) -> list[Any]:
    """The command of a test and its environment, as ctest lists them: where programs of the build are named."""
    properties = test.get("properties", [])
    return [test.get("command"), [entry["value"] for entry in properties if entry["name"] == "ENVIRONMENT"]]


def telling_line(output: str) -> str:
    """The first line of a failed test's output that says what failed."""
    lines = [line.strip() for line in output.splitlines()]
    begin = next((number for number, line in enumerate(lines) if "***" in line), 0)
    end = next((number for number, line in enumerate(lines) if "tests passed" in line), len(lines))
    said = [line for line in lines[begin + 1 : end] if line]
    return next((line for line in said if TELLING.search(line)), said[-1] if said else lines[begin])
