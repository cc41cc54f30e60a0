"""How fast the driver is: against the oracle as whole processes, as n grows, and against the memory's bandwidth.

    python3 verification/benchmark.py [--sizes 16 32 64 128 256] [--oracle-sizes 64 128] [--repeat 3]
                                      [--threads 1] [--set KEY=VALUE]
                                      [--driver build/thermocontact] [--output DIR]
    python3 verification/benchmark.py --study ladder | scaling | multigrid [--largest CELLS] [--processes 1 2]

The problem is scenes/paper-isotropic.toml with theta_F = 10, n cells a side, n steps, no field output, one thread
(the driver, and the reading of the memory, by --threads). --set is the driver's.
Driver and oracle run in turn, each several times, after one run of both that is not counted and fills the oracle's
cache of compiled forms. At the largest size the memory's read bandwidth is measured between the runs, on an array
of the size of the two Cholesky factors, part of which may stay in the cache, and on one of 256 MiB; reading both
factors twice is what the triangular solves of a step need at least. Medians are given with the least and the largest value. Nothing here judges a time: the machine may be busy.

The other studies compare strategies and processes, see benchmarking/large.py.

Exit codes: 0 measured, 1 a run failed or driver and oracle did not solve the same problem, 2 wrong usage.
"""

import argparse
import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from benchmarking import large, process, report
from benchmarking.bandwidth import LARGE, ReadTimer
from benchmarking.process import Run, RunFailed
from benchmarking.statistics import Sample, exponent

SAME = 1e-9  # relative difference of the norms of the final fields
WARM_UP = 8  # cells a side: the forms to compile are the same at every size


def progress(text: str) -> None:
    print(text, file=sys.stderr, flush=True)


def against_oracle(
    driver: Sequence[str], sizes: Sequence[int], repeat: int, threads: int
) -> list[dict[str, Any]]:
    """Whole processes, in turn."""
    oracle = process.oracle_command()
    if sizes:
        progress("uncounted runs, the oracle compiles its forms")
        process.run(oracle, WARM_UP)
        process.run(driver, WARM_UP)
    results = []
    for n in sizes:
        ours: list[Run] = []
        theirs: list[Run] = []
        for turn in range(repeat):
            progress(f"n = {n}, turn {turn + 1} of {repeat}: driver and oracle")
            ours.append(process.run(driver, n, threads))
            theirs.append(process.run(oracle, n))
        results.append(compared(n, ours, theirs))
    return results


def compared(n: int, ours: Sequence[Run], theirs: Sequence[Run]) -> dict[str, Any]:
    difference = max(process.disagreement(a, b) for a in ours for b in theirs)
    if not difference <= SAME:
        raise RunFailed(f"n = {n}: driver and oracle differ by {difference:.3e} in a final norm")
    driver, oracle = (Sample.of([run.wall_seconds for run in runs]) for runs in (ours, theirs))
    return {
        "n": n,
        "driver_seconds": vars(driver),
        "oracle_seconds": vars(oracle),
        "ratio": oracle.median / driver.median,
        "ratios_in_turn": [b.wall_seconds / a.wall_seconds for a, b in zip(ours, theirs)],
        "largest_difference_of_norms": difference,
    }


def growth(
    driver: Sequence[str], sizes: Sequence[int], repeat: int, threads: int
) -> tuple[list[dict[str, Any]], dict[str, Any]]:
    """Seconds per step at each size, and the largest size against the memory."""
    results: list[dict[str, Any]] = []
    memory: dict[str, Any] = {}
    with ReadTimer() as timer:
        for n in sizes:
            runs: list[Run] = []
            reads: list[tuple[float, float]] = []
            for turn in range(repeat):
                progress(f"n = {n}, turn {turn + 1} of {repeat}: driver")
                runs.append(process.run(driver, n, threads))
                if n == max(sizes):
                    entries = factor_entries(runs[-1])
                    reads.append((timer.seconds(entries, threads), timer.seconds(LARGE, threads)))
            results.append(size_result(n, runs))
            if n == max(sizes):
                memory = against_memory(n, runs, reads)
    return results, memory


def factor_entries(run: Run) -> int:
    return int(run.summary["solver"]["factor_entries"])


def size_result(n: int, runs: Sequence[Run]) -> dict[str, Any]:
    median = sorted(runs, key=lambda run: run.step_seconds)[(len(runs) - 1) // 2]
    return {
        "n": n,
        "step_seconds": vars(Sample.of([run.step_seconds for run in runs])),
        "wall_seconds": vars(Sample.of([run.wall_seconds for run in runs])),
        "peak_memory_mib": max(run.peak_memory_mib for run in runs),
        "newton_iterations": median.summary["newton"]["iterations"],
        "factor_entries": factor_entries(median),
        "parts": median.summary["seconds"].get("parts"),  # of the median run, over all its steps
    }


def against_memory(n: int, runs: Sequence[Run], reads: Sequence[tuple[float, float]]) -> dict[str, Any]:
    entries = factor_entries(runs[0])
    step = Sample.of([run.step_seconds for run in runs]).median
    of_factors, of_large = (Sample.of(seconds).median for seconds in zip(*reads))
    twice = {
        "array_of_the_factors_size": 2.0 * of_factors,
        "array_of_256_mib": 2.0 * of_large * entries / LARGE,
    }
    return {
        "n": n,
        "factor_entries": entries,
        "step_seconds": step,
        "factors_twice_seconds": twice,
        "gb_per_s": {array: 16e-9 * entries / seconds for array, seconds in twice.items()},
        "ratio": {array: step / seconds for array, seconds in twice.items()},
    }


def measure(options: argparse.Namespace) -> dict[str, Any]:
    driver = process.driver_command(options.driver)
    for setting in options.set:
        driver += ["--set", setting]
    comparison = against_oracle(driver, options.oracle_sizes, options.repeat, options.threads)
    sizes, memory = growth(driver, sorted(options.sizes), options.repeat, options.threads)
    fitted = exponent({size["n"]: size["step_seconds"]["median"] for size in sizes})
    return {
        "machine": report.machine(),
        "repeat": options.repeat,
        "threads": options.threads,
        "against_oracle": comparison,
        "growth": sizes,
        "step_seconds_exponent": fitted,
        "against_memory": memory,
    }


def measure_large(options: argparse.Namespace) -> Any:
    driver, repeat = process.driver_command(options.driver), options.repeat
    if options.study == "ladder":
        return large.ladder(driver, repeat, options.largest or 256)
    if options.study == "scaling":
        return large.scaling(driver, repeat, options.largest or 40, options.processes)
    return large.multigrid(driver, repeat, options.largest or 28, options.processes)


def positive(text: str) -> int:
    value = int(text)
    if value < 1:
        raise argparse.ArgumentTypeError("must be at least 1")
    return value


def parse(arguments: Sequence[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Measure the driver against the oracle and the memory.")
    parser.add_argument("--sizes", type=positive, nargs="+", default=[16, 32, 64, 128, 256], metavar="N")
    parser.add_argument("--oracle-sizes", type=positive, nargs="*", default=[64, 128], metavar="N")
    parser.add_argument("--repeat", type=positive, default=3)
    parser.add_argument("--threads", type=positive, default=1, help="of the driver, and to read the memory")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="for the driver")
    parser.add_argument("--driver", type=Path, default=process.ROOT / "build" / "thermocontact")
    parser.add_argument("--output", type=Path, metavar="DIR", help="where benchmark.json goes")
    parser.add_argument("--study", choices=("speed", "ladder", "scaling", "multigrid"), default="speed")
    parser.add_argument("--largest", type=positive, metavar="CELLS", help="cells a side of the other studies")
    parser.add_argument("--processes", type=positive, nargs="+", default=[1, 2], metavar="P")
    options = parser.parse_args(arguments)
    if not options.driver.is_file():
        parser.error(f"no driver at {options.driver}")
    return options


def main(arguments: Sequence[str]) -> int:
    options = parse(arguments)
    try:
        results = measure(options) if options.study == "speed" else measure_large(options)
        print(report.text(results) if options.study == "speed" else large.text(options.study, results))
        if options.output:
            options.output.mkdir(parents=True, exist_ok=True)
            path = options.output / (
                "benchmark.json" if options.study == "speed" else f"{options.study}.json"
            )
            path.write_text(json.dumps(results, indent=2) + "\n", encoding="utf-8")
    except (RunFailed, OSError) as problem:
        print(f"benchmark: {problem}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
