"""The read bandwidth of the memory, by a small C program compiled on the spot for this machine."""

import subprocess
import tempfile
from pathlib import Path
from types import TracebackType

from benchmarking.process import RunFailed

SOURCE = Path(__file__).with_name("read_bandwidth.c")
COMPILER = ("gcc", "-O3", "-march=native", "-ffast-math", "-pthread")
REPETITIONS = 15
LARGE = 256 * 2**20 // 8  # doubles: far more than any cache


class ReadTimer:
    """Context: the compiled program."""

    def __enter__(self) -> "ReadTimer":
        self.folder = tempfile.TemporaryDirectory(prefix="bandwidth-")
        self.program = Path(self.folder.name) / "read_bandwidth"
        self._run([*COMPILER, str(SOURCE), "-o", str(self.program)])
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.folder.cleanup()

    def seconds(self, count: int, threads: int) -> float:
        """To read that many doubles once, by that many threads; the best of several passes."""
        words = [str(self.program), str(count), str(REPETITIONS), str(threads)]
        return float(self._run(words).split()[0])

    @staticmethod
    def _run(command: list[str]) -> str:
        try:
            return subprocess.run(command, check=True, capture_output=True, text=True).stdout
        except (OSError, subprocess.CalledProcessError) as problem:
            raise RunFailed(f"{command[0]}: {problem}") from problem
