"""Commands of a section, run or taken from an earlier run of the report."""

import dataclasses
import json
import os
import subprocess
import sys
import time
from datetime import datetime
from pathlib import Path
from typing import Any

from benchmarking.process import ENVIRONMENT, ROOT
from report_parts.section import DRIVER, MANUFACTURED, OUT, Command, Kept


@dataclasses.dataclass(frozen=True)
class Workshop:
    """Where the programs are and where results go."""

    driver: Path
    folder: Path
    version: str

    def of(self, section: str) -> Path:
        return self.folder / section

    def kept(self, section: str, command: Command, reuse: bool) -> Kept:
        """Raises OSError. A command that cannot be started counts as one that failed."""
        record = self.of(section) / f"{command.name}.json"
        if reuse and (found := _read(record, command)):
            return found
        self.of(section).mkdir(parents=True, exist_ok=True)
        begin = time.perf_counter()
        done = subprocess.run(
            self._words(section, command),
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            check=False,
            cwd=ROOT,
            env={**os.environ, **ENVIRONMENT},
        )
        seconds = time.perf_counter() - begin
        now = datetime.now().isoformat(sep=" ", timespec="minutes")
        kept = Kept(command, done.returncode, done.stdout, seconds, now, self.version)
        record.write_text(json.dumps(dataclasses.asdict(kept), indent=1), encoding="utf-8")
        return kept

    def _words(self, section: str, command: Command) -> list[str]:
        places = {
            OUT: self.of(section),
            DRIVER: self.driver,
            MANUFACTURED: self.driver.with_name("manufactured"),
        }
        words = [*command.words, *command.hidden]
        for mark, place in places.items():
            words = [word.replace(mark, str(place)) for word in words]
        return [sys.executable, *words] if words[0].endswith(".py") else words


def _read(record: Path, command: Command) -> Kept | None:
    """Nothing if there is no record of just this command."""
    try:
        data: dict[str, Any] = json.loads(record.read_text(encoding="utf-8"))
        words = data.pop("command")["words"]
        return Kept(command, **data) if list(words) == list(command.words) else None
    except (OSError, ValueError, KeyError, TypeError):
        return None


def shown(section: str, command: Command) -> str:
    """As a user would type it in a clone of the repository."""
    words = [word.replace(OUT, section).replace(DRIVER, "build/thermocontact") for word in command.words]
    quoted = [f"'{word}'" if any(c in word for c in '" ()[]*') else word for word in words]
    return " ".join(["python3", *quoted] if words[0].endswith(".py") else quoted)
