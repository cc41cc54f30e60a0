"""Tables of the error curves: text and CSV."""

import csv
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from convergence_parts.errors import NORMS, History, Peak, fitted_order, observed_orders
from convergence_parts.lattice import REGIONS
from convergence_parts.study import GRADUAL, RAMP_END, Series

SHORT = dict(zip(NORMS, ("|w|_L2", "|eps(u)|_L2", "|theta|_L2")))
REFINED = {"both": "h = k = 1/n", "space": "h = 1/n, k = 1/{0}", "time": "k = 1/n, h = 1/{0}"}
LATE = 0.25
CUTS = {
    "all times, everywhere": (0.0, False),
    f"only t >= {LATE}": (LATE, False),
    "without the corners": (0.0, True),
}

Curve = Mapping[str, Sequence[float]]


def heading(series: Series) -> str:
    refined = REFINED[series.mode].format(series.reference)
    return f"{series.scene}, {series.variant}, {refined}, against h = k = 1/{series.reference}"


def curves(histories: Iterable[History], begin: float = 0.0, outside_corners: bool = False) -> Curve:
    """E_hk and each norm's own largest value over time, by size."""
    peaks = [history.peak(begin, outside_corners) for history in histories]
    return {"E_hk": [peak.error for peak in peaks]} | {
        norm: [peak.own[norm] for peak in peaks] for norm in NORMS
    }


def in_order(histories: Mapping[int, History]) -> list[History]:
    return [histories[n] for n in sorted(histories)]


def error_table(series: Series) -> str:
    """E_hk and its parts, at the time at which their sum is largest."""
    peaks = [history.peak() for history in in_order(series.against_reference)]
    references = [history.reference_peak() for history in in_order(series.against_reference)]
    orders = observed_orders(series.sizes, [peak.error for peak in peaks])
    lines = [
        "   n      E_hk   order   at t  " + "".join(f"{SHORT[norm]:>13}" for norm in NORMS) + "   relative"
    ]
    for n, peak, reference, order in zip(series.sizes, peaks, references, orders):
        parts = "".join(f"{peak.parts[norm]:13.4e}" for norm in NORMS)
        relative = peak.error / reference.error
        lines.append(f"{n:4d} {peak.error:10.3e} {number(order)} {peak.time:7.4f} {parts} {relative:10.2e}")
    return "\n".join(lines)


def norm_table(series: Series) -> str:
    """Each norm's own largest value over time, relative to the reference's, and its order."""
    values = curves(in_order(series.against_reference))
    largest = series.against_reference[max(series.sizes)].reference_peak().own
    orders = {norm: observed_orders(series.sizes, values[norm]) for norm in NORMS}
    lines = ["   n" + "".join(f"{SHORT[norm]:>13}  relative   order" for norm in NORMS)]
    for at, n in enumerate(series.sizes):
        cells = (
            f"{values[norm][at]:13.4e} {values[norm][at] / largest[norm]:9.2e}  {number(orders[norm][at])}"
            for norm in NORMS
        )
        lines.append(f"{n:4d}" + "".join(cells))
    return "\n".join(lines)


def order_row(series: Series, label: str, begin: float, outside_corners: bool) -> str:
    """Fitted orders against the reference and, behind the bar, of the differences of n and 2 n."""
    cells = []
    for histories in (series.against_reference, series.against_doubled):
        found = curves(in_order(histories), begin, outside_corners) if histories else {}
        cells.append("  ".join(f"{number(fitted_order(sorted(histories), v)):>9}" for v in found.values()))
    return f"{label:48}" + "   |".join(cells)


def order_heading() -> str:
    names = "  ".join(f"{name:>9}" for name in ("E_hk", "w", "eps(u)", "theta"))
    return f"{'fitted order':48}{names}   |{names}   (against the reference | n against 2n)"


def share_table(series: Series) -> str:
    """Where the squared error sits at the largest size, beside the share of the area."""
    history = series.against_reference[max(series.sizes)]
    area = history.area_shares("temperature_l2")
    lines = ["share of squared error (%)".ljust(28) + "".join(f"{name:>13}" for name in REGIONS[1:])]
    for norm in NORMS:
        shares = history.shares(norm)
        cells = "".join(f"{100 * shares[name]:13.1f}" for name in REGIONS[1:])
        lines.append(f"{SHORT[norm]:28}" + cells)
    cells = "".join(f"{100 * area[name]:13.1f}" for name in REGIONS[1:])
    return "\n".join([*lines, f"{'share of the area':28}" + cells])


def number(order: float) -> str:
    return f"{order:6.2f}" if order == order else "     -"


def table(series: Series) -> str:
    rows = [order_row(series, "all times, everywhere", 0.0, False)]
    parts = [heading(series), error_table(series), "each norm at its own worst time"]
    return "\n".join([*parts, norm_table(series), order_heading(), *rows, ""])


def experiment(compared: Sequence[Series]) -> str:
    """What the loads' sudden start, the early times, the corners and the jump of k_c do to the orders."""
    ways = f"loads sudden or ramped over t < {RAMP_END}, k_c as stated or gradual over {GRADUAL} m"
    lines = [heading(compared[0]).replace(compared[0].variant, ways), order_heading()]
    for series in compared:
        for cut, (begin, outside_corners) in CUTS.items():
            lines.append(order_row(series, f"{series.variant}: {cut}", begin, outside_corners))
    for series in compared:
        lines += [f"{series.variant}, n = {max(series.sizes)}", share_table(series)]
    return "\n".join([*lines, ""])


def rows(series: Series) -> list[dict[str, object]]:
    peaks = [history.peak() for history in in_order(series.against_reference)]
    orders = observed_orders(series.sizes, [peak.error for peak in peaks])
    return [row(series, n, peak, order) for n, peak, order in zip(series.sizes, peaks, orders)]


def row(series: Series, n: int, peak: Peak, order: float) -> dict[str, object]:
    reference = series.against_reference[n].reference_peak()
    doubled = series.against_doubled.get(n)
    steps = series.reference if series.mode == "space" else n
    cells = series.reference if series.mode == "time" else n
    return {
        "scene": series.scene,
        "variant": series.variant,
        "mode": series.mode,
        "reference": series.reference,
        "h": 1.0 / cells,
        "k": 1.0 / steps,
        "error": peak.error,
        "order": order,
        "difference_to_doubled": doubled.peak().error if doubled else "",
        "relative_error": peak.error / reference.error,
        "time": peak.time,
        **peak.parts,
        **{f"relative_{norm}": peak.parts[norm] / reference.own[norm] for norm in NORMS},
        **{f"worst_{norm}": peak.own[norm] for norm in NORMS},
    }


def write_csv(path: Path, found: Sequence[Series]) -> None:
    lines = [line for series in found for line in rows(series)]
    with path.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, list(lines[0]))
        writer.writeheader()
        writer.writerows(lines)
