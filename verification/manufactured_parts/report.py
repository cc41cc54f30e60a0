"""Tables of the observed orders: one to read, one for programs."""

import csv
from collections.abc import Sequence
from pathlib import Path

from manufactured_parts.study import SYMBOLS, TOLERANCE, Curve

WHAT = {"space": "h", "time": "k"}


def heading(curve: Curve) -> str:
    first, last = curve.sizes[0], curve.sizes[-1]
    with_scheme = f", {curve.scheme}" if curve.study == "time" else ""
    return (
        f"\n{curve.case}, {curve.cell} of degree {curve.degree}{with_scheme}: "
        f"{WHAT[curve.study]} = 1/{first} ... 1/{last}"
    )


def row(curve: Curve) -> str:
    errors = " ".join(f"{error:9.2e}" for error in curve.errors)
    orders = " ".join(f"{order:6.3f}" for order in curve.orders)
    verdict = "ok" if curve.passes else f"FAILED: not within {TOLERANCE} of theory"
    return f"  {SYMBOLS[curve.norm]:<14} {errors}   orders {orders}   theory {curve.theory}  {verdict}"


def write_csv(path: Path, curves: Sequence[Curve]) -> None:
    with path.open("w", encoding="ascii", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(
            ["study", "case", "cell", "degree", "scheme", "norm", "size", "error", "order", "theory"]
        )
        for curve in curves:
            orders: list[float | str] = ["", *curve.orders]
            for size, error, order in zip(curve.sizes, curve.errors, orders):
                writer.writerow(
                    [
                        curve.study,
                        curve.case,
                        curve.cell,
                        curve.degree,
                        curve.scheme,
                        curve.norm,
                        size,
                        error,
                        order,
                        curve.theory,
                    ]
                )
