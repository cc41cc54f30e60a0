"""The measurements as tables for a reader, beside what issue 2 asks for."""

import os
import platform
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from benchmarking.statistics import Sample

ASKED_SPEEDUP = {64: 15, 128: 25}
ASKED_READS = 3  # a step over the time to read the factors twice
ASKED_MEMORY_MIB = 1536


def machine() -> dict[str, Any]:
    return {"processor": processor(), "cores": os.cpu_count(), "load_at_end": os.getloadavg()[0]}


def processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return platform.processor()
    names = (line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
    return next(names, platform.processor())


def text(results: Mapping[str, Any]) -> str:
    machine = results["machine"]
    lines = [
        f"{machine['processor']}, {machine['cores']} cores, load {machine['load_at_end']:.1f}; "
        f"medians of {results['repeat']} (least-most); threads {results['threads']}",
        *oracle_lines(results),
        *growth_lines(results),
        *memory_lines(results["against_memory"]),
        *parts_lines(results["growth"][-1]),
    ]
    return "\n".join(lines)


def oracle_lines(results: Mapping[str, Any]) -> list[str]:
    if not results["against_oracle"]:
        return []
    lines = [
        "",
        "Whole processes, seconds",
        f"{'n':>5} {'driver':>22} {'oracle':>22} {'ratio':>7} {'asked':>7}",
    ]
    for row in results["against_oracle"]:
        driver, oracle = (Sample(**row[f"{name}_seconds"]).text() for name in ("driver", "oracle"))
        asked = f">= {ASKED_SPEEDUP[row['n']]}" if row["n"] in ASKED_SPEEDUP else ""
        lines.append(f"{row['n']:>5} {driver:>22} {oracle:>22} {row['ratio']:>7.1f} {asked:>7}")
    difference = max(row["largest_difference_of_norms"] for row in results["against_oracle"])
    return [*lines, f"same problem: the final norms agree to {difference:.1e}"]


def growth_lines(results: Mapping[str, Any]) -> list[str]:
    header = f"{'n':>5} {'ms a step':>24} {'Newton a step':>14} {'factor entries':>15} {'peak MiB':>9}"
    lines = ["", "Driver as n grows", header]
    for row in results["growth"]:
        step = Sample(**row["step_seconds"]).text(1e3)
        newton = row["newton_iterations"] / row["n"]
        lines.append(
            f"{row['n']:>5} {step:>24} {newton:>14.1f} {row['factor_entries']:>15} {row['peak_memory_mib']:>9.0f}"
        )
    if results["step_seconds_exponent"] is not None:
        lines.append(f"seconds a step grow as n^{results['step_seconds_exponent']:.2f}")
    if results["growth"][-1]["n"] == 256:
        lines.append(f"asked: at most {ASKED_MEMORY_MIB} MiB at n = 256")
    return lines


def memory_lines(memory: Mapping[str, Any]) -> list[str]:
    lines = [
        "",
        f"Against the memory, n = {memory['n']}: a step takes {1e3 * memory['step_seconds']:.2f} ms, "
        f"the two factors are {memory['factor_entries'] * 8 / 2**20:.0f} MiB",
        f"{'bandwidth measured on an':<26} {'GB/s':>7} {'ms to read both twice':>22} {'step / that':>12}",
    ]
    for array, seconds in memory["factors_twice_seconds"].items():
        shown = array.replace("_", " ").replace("mib", "MiB").replace("factors size", "factors' size")
        lines.append(
            f"{shown:<26} {memory['gb_per_s'][array]:>7.2f} {1e3 * seconds:>22.2f} {memory['ratio'][array]:>12.2f}"
        )
    return [*lines, f"asked: at most {ASKED_READS} at n = 256"]


def parts_lines(largest: Mapping[str, Any]) -> list[str]:
    parts: dict[str, float] | None = largest["parts"]
    if not parts:
        return ["", "Where a step's time goes: the driver's summary does not say (seconds.parts)"]
    total = sum(parts.values()) or 1.0
    lines = ["", f"Where a step's time goes, n = {largest['n']} (the median run)"]
    for name, seconds in sorted(parts.items(), key=lambda item: item[1], reverse=True):
        shown = name.replace("_", " ")
        lines.append(f"{shown:<20} {1e3 * seconds / largest['n']:8.3f} ms {100 * seconds / total:6.1f} %")
    return lines
