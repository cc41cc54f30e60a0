"""Whether two runs have tried, rejected and taken the same adaptive steps."""

import csv
from itertools import zip_longest
from pathlib import Path

COLUMNS = ("step", "time", "size", "outcome")  # the estimate's last digits may differ


def first_difference(directory_a: Path, directory_b: Path) -> str:
    """Empty where the steps are the same, or one of the runs has no steps of its own, as the oracle."""
    files = [directory / "steps.csv" for directory in (directory_a, directory_b)]
    if not all(file.exists() for file in files):
        return ""
    tables = []
    for file in files:
        with file.open(encoding="ascii", newline="") as lines:
            tables.append([[row[column] for column in COLUMNS] for row in csv.DictReader(lines)])
    for number, (a, b) in enumerate(zip_longest(*tables), 1):
        if a != b:
            return f"other adaptive steps from number {number} on: {a} against {b}"
    return ""
