"""Tables of the observed orders: one to read, one for programs."""

import csv
from collections.abc import Sequence
from pathlib import Path

from manufactured_parts.study import L2_NORMS, SYMBOLS, TOLERANCE, Curve

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


def summary(curves: Sequence[Curve]) -> str:
    """A table in Markdown: a row for each cell and degree in h and for each scheme in k, a column a case; in it the least
    and the greatest order in L2, then in the energy norms."""
    cases = list(dict.fromkeys(curve.case for curve in curves))
    cells = dict.fromkeys(curve.cell for curve in curves)

    def place(curve: Curve) -> tuple[str, str]:
        together = curve.study == "time" and len(cells) > 1
        return "all" if together else curve.cell, refined(curve)

    rows = dict.fromkeys(map(place, curves))
    lines = [["cell", "refined", *cases], ["---"] * (2 + len(cases))]
    for cell, what in rows:
        own = [curve for curve in curves if place(curve) == (cell, what)]
        lines.append([cell, what, *(spread([c for c in own if c.case == case]) for case in cases)])
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def refined(curve: Curve) -> str:
    return f"h, degree {curve.degree}" if curve.study == "space" else f"k, {curve.scheme}"


def spread(curves: Sequence[Curve]) -> str:
    groups = [[c for c in curves if (c.norm in L2_NORMS) == is_l2] for is_l2 in (True, False)]
    orders = [[order for curve in group for order in curve.orders] for group in groups]
    return "; ".join(f"{min(found):.2f} – {max(found):.2f}" for found in orders if found)


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
