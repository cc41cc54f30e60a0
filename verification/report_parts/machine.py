"""On what and with what the results were made."""

import os
import platform
import subprocess
from collections.abc import Sequence
from importlib import metadata
from pathlib import Path

from benchmarking.process import ROOT
from benchmarking.report import processor


def version_of(driver: Path) -> str:
    """Of the driver, with the commit that the sources stand at: its own number changes less often."""
    commit = _printed(["git", "-C", str(ROOT), "describe", "--always", "--dirty"])
    return f"{_printed([str(driver), '--version'])}, sources {commit}"


def rows(version: str) -> list[list[str]]:
    """Name and value, the version first."""
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30
    found = [
        ["driver", version],
        ["processor", f"{processor()}, {os.cpu_count()} cores, {memory:.0f} GiB"],
        ["system", _system()],
        ["compiler", _printed(["c++", "--version"]).splitlines()[0]],
        ["Python", platform.python_version()],
    ]
    for package in ("fenics-dolfinx", "petsc4py", "numpy", "scipy"):
        try:
            found.append([package, metadata.version(package)])
        except metadata.PackageNotFoundError:
            found.append([package, "not known to Python's registry"])
    return found


def _system() -> str:
    try:
        name = platform.freedesktop_os_release()["PRETTY_NAME"]
    except (OSError, KeyError):
        name = platform.system()
    return f"{name}, {platform.machine()}"


def _printed(words: Sequence[str]) -> str:
    try:
        done = subprocess.run(words, capture_output=True, text=True, check=False)
    except OSError:
        return "unknown"
    return done.stdout.strip() if done.returncode == 0 and done.stdout.strip() else "unknown"
