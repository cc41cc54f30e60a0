"""Run the oracle on many scenes in one process, or in one set of MPI processes.

    [mpirun -n P] python3 -m matrix_parts.worker JOBS.json

JOBS.json lists pairs [scene file, output directory]; beside the latter, "driver" has the driver's results, whose steps
are followed where they are adapted. The exit code of each is written into its directory's parent as NAME.code; what
went wrong is on stderr.
"""

import gc
import json
import logging
import sys
import traceback
from pathlib import Path

from mpi4py import MPI

import oracle
from matrix_parts.runs import code_file, followed


def solve(scene: str, directory: Path) -> int:
    """The oracle's exit code; an exception that it does not foresee is one more failure of the system."""
    try:
        follow = ["--follow", str(followed(directory))]
        return oracle.main([scene, "--output", str(directory), *follow, "--quiet"])
    except Exception:
        traceback.print_exc()
        if MPI.COMM_WORLD.size > 1:
            MPI.COMM_WORLD.Abort(1)
        return 1


def main(jobs_file: str) -> int:
    logging.disable(logging.INFO)  # every command of the C compiler
    # PETSc's objects are freed by all processes together: at one place, not where each one's collector strikes
    gc.disable()
    for scene, directory in json.loads(Path(jobs_file).read_text(encoding="utf-8")):
        code = solve(scene, Path(directory))
        gc.collect()
        if MPI.COMM_WORLD.rank == 0:
            code_file(Path(directory)).write_text(str(code), encoding="ascii")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
