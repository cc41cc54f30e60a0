"""Along the contact boundary: pressure, tangential traction, slip velocity and penetration, at the end and in time."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.tri import Triangulation

from oracle_parts import vtu
from plotting.results import Array, ContactCurve
from plotting.style import CURVES, OPEN_COLOUR, PANEL, Album, Case, panels
from plotting.surface import TRIANGLES, plane_of

HEIGHT = 2.9  # inches, of a panel with curves
BELOW = 0.2  # of the largest penetration: how much of the opening is shown


@dataclass(frozen=True)
class Quantity:
    title: str
    label: str
    needs: str  # the field in the file
    of: Callable[[ContactCurve], Array]

    def on_surface(self, surface: vtu.Grid) -> Array:
        """Of a body in space: the value, or the length of a vector; the penetration where it is open is negative."""
        values = surface.point_data[self.needs]
        if values.ndim > 1:
            return np.asarray(np.linalg.norm(values, axis=1))
        return np.asarray(-values if self.needs == "gap" else values)


PRESSURE = Quantity("Pressure", r"$p_n$ (Pa)", "pressure", lambda curve: curve.field("pressure"))
TRACTION = Quantity(
    "Tangential traction", r"$\sigma_t$ (Pa)", "traction", lambda curve: curve.tangential("traction")
)
SLIP = Quantity(
    "Slip velocity", r"$w_t$ (m/s)", "slip_velocity", lambda curve: curve.tangential("slip_velocity")
)
PENETRATION = Quantity("Penetration", r"$u_n - g$ (m)", "gap", lambda curve: -curve.field("gap"))


def quantities(cases: Sequence[Case], boundary: str) -> list[Quantity]:
    """Those that every case models on this boundary."""
    laws = {
        law: all(case.results.contact_law(boundary, law) is not None for case in cases)
        for law in ("compliance", "friction")
    }
    chosen = [PRESSURE] if laws["compliance"] else []
    chosen += [TRACTION] if laws["friction"] else []
    return [*chosen, SLIP, PENETRATION]


def curves(case: Case, boundary: str, wanted: Sequence[Quantity]) -> list[ContactCurve]:
    return case.results.curves(boundary, [quantity.needs for quantity in wanted])


def draw_final(cases: Sequence[Case], album: Album) -> None:
    for boundary in cases[0].results.contact_names:
        if not cases[0].results.contact_is_curve:
            draw_final_surface(cases, boundary, album)
            continue
        wanted = quantities(cases, boundary)
        rows = (len(wanted) + 1) // 2
        figure, grid = panels(rows, 2, PANEL, HEIGHT, sharex=True)
        last = [curves(case, boundary, wanted)[-1] for case in cases]
        for axes, quantity in zip(grid.flat, wanted):
            draw_profiles(axes, quantity, cases, last, boundary)
        for axes in grid.flat[len(wanted) :]:
            axes.remove()
        for axes in grid.flat[: len(wanted)][-2:]:
            axes.set_xlabel(f"{last[0].axis} (m)")
            axes.tick_params(labelbottom=True)
        grid[0, 0].legend(loc="best")
        time = ", ".join(sorted({f"t = {case.results.final_time:g} s" for case in cases}))
        figure.suptitle(f"Contact boundary '{boundary}' at {time}")
        album.save(figure, f"contact-{boundary}-final")


def draw_final_surface(cases: Sequence[Case], boundary: str, album: Album) -> None:
    """Seen along the axis in which the boundary extends least: a row for each quantity, or two quantities in a row."""
    wanted = quantities(cases, boundary)
    surfaces = [case.results.contact_surface(boundary, [q.needs for q in wanted]) for case in cases]
    across, up = plane_of(surfaces[0].points)
    width, height = np.ptp(surfaces[0].points, axis=0)[[across, up]]
    rows, columns = (len(wanted), len(cases)) if len(cases) > 1 else ((len(wanted) + 1) // 2, 2)
    size = 0.9 + 0.8 * PANEL * min(1.0, height / width)
    figure, grid = panels(rows, columns, PANEL, size, sharex=True, sharey=True)
    for axes in grid.flat[len(wanted) * len(cases) :]:
        axes.remove()
    for at, quantity in enumerate(wanted):
        row = grid.flat[at * len(cases) : (at + 1) * len(cases)]
        drawn = draw_surfaces(row, quantity, cases, surfaces)
        figure.colorbar(drawn, ax=list(row), label=quantity.label)
    for axes in grid[-1]:
        axes.set_xlabel(f"{'xyz'[across]} (m)")
    for axes in grid[:, 0]:
        axes.set_ylabel(f"{'xyz'[up]} (m)")
    time = ", ".join(sorted({f"t = {case.results.final_time:g} s" for case in cases}))
    figure.suptitle(f"Contact boundary '{boundary}' at {time}")
    album.save(figure, f"contact-{boundary}-final")


def draw_surfaces(row: Any, quantity: Quantity, cases: Sequence[Case], surfaces: Sequence[vtu.Grid]) -> Any:
    """One quantity for every case in common colours; the last picture, for the bar of colours."""
    tables = [np.maximum(quantity.on_surface(surface), 0.0) for surface in surfaces]
    largest = max(float(table.max()) for table in tables) or 1.0
    across, up = plane_of(surfaces[0].points)
    for axes, case, surface, table in zip(row, cases, surfaces, tables):
        split = np.concatenate([surface.cells[:, part] for part in TRIANGLES[surface.cell_type]])
        flat = Triangulation(surface.points[:, across], surface.points[:, up], split)
        drawn = axes.tripcolor(flat, table, shading="gouraud", cmap="viridis", vmin=0.0, vmax=largest)
        axes.set_aspect("equal")
        axes.set_title(quantity.title if len(cases) == 1 else f"{quantity.title}, {case.label}")
    return drawn


def draw_profiles(
    axes: Any, quantity: Quantity, cases: Sequence[Case], last: Sequence[ContactCurve], boundary: str
) -> None:
    axes.axhline(0.0, color="#888888", linewidth=0.8)
    for case, curve, look in zip(cases, last, CURVES):
        if quantity is TRACTION:
            shade_friction_bound(axes, case, curve, boundary, look["color"])
        values = quantity.of(curve)
        axes.plot(curve.along, values, label=case.label, **look)
        if quantity is SLIP:
            closed = ~curve.is_open
            axes.plot(curve.along[closed], values[closed], "o", color=look["color"], markersize=3.5)
    if quantity is PENETRATION:
        deepest = max(float(PENETRATION.of(curve).max()) for curve in last)
        if deepest > 0.0:
            axes.set_ylim(-BELOW * deepest, 1.08 * deepest)
    axes.set_title(profile_title(quantity, cases, boundary))
    axes.set_ylabel(quantity.label)


def profile_title(quantity: Quantity, cases: Sequence[Case], boundary: str) -> str:
    details = {
        TRACTION.title: r" (shaded: bound $\pm\mu p_n$)" if friction_coefficient(cases[0], boundary) else "",
        SLIP.title: " (dots: closed)",
        PENETRATION.title: " (below 0: open, cut off)",
    }
    return quantity.title + details.get(quantity.title, "")


def friction_coefficient(case: Case, boundary: str) -> float | None:
    """None where it is an expression."""
    friction = case.results.contact_law(boundary, "friction") or {}
    value = friction.get("coefficient")
    return float(value) if isinstance(value, (int, float)) else None


def shade_friction_bound(axes: Any, case: Case, curve: ContactCurve, boundary: str, colour: str) -> None:
    coefficient = friction_coefficient(case, boundary)
    if coefficient is not None and "pressure" in curve.values:
        bound = coefficient * curve.field("pressure")
        axes.fill_between(curve.along, -bound, bound, color=colour, alpha=0.15, linewidth=0)


def draw_maps(cases: Sequence[Case], album: Album) -> None:
    """Position against time in colours; grey where the contact is open. Nothing where the boundary is a surface."""
    if not all(case.results.contact_is_curve for case in cases):
        print("figures: the contact boundary is a surface, so no contact-maps")
        return
    for boundary in cases[0].results.contact_names:
        wanted = [quantity for quantity in quantities(cases, boundary) if quantity in (PRESSURE, SLIP)]
        figure, grid = panels(len(wanted), len(cases), PANEL, 3.1, sharex=True, sharey=True)
        series = [curves(case, boundary, wanted) for case in cases]
        for row, quantity in zip(grid, wanted):
            draw_map_row(figure, row, quantity, cases, series)
        for axes in grid[-1]:
            axes.set_xlabel(f"{series[0][0].axis} (m)")
        for axes in grid[:, 0]:
            axes.set_ylabel("t (s)")
        figure.suptitle(f"Contact boundary '{boundary}' over time (grey: open)")
        album.save(figure, f"contact-{boundary}-maps")


def draw_map_row(
    figure: Any, row: Any, quantity: Quantity, cases: Sequence[Case], series: Sequence[Sequence[ContactCurve]]
) -> None:
    # The initial state is left out: before the first step nothing has been solved.
    tables: list[Any] = [masked([quantity.of(c) for c in s[1:]], [c.is_open for c in s[1:]]) for s in series]
    largest = max(float(np.abs(table).max()) if table.count() else 0.0 for table in tables) or 1.0
    signed = quantity is SLIP
    for axes, case, curve_list, table in zip(row, cases, series, tables):
        x_edges, centres = cells_of_nodes(curve_list[0].along, table)
        axes.set_facecolor(OPEN_COLOUR)
        drawn = axes.pcolormesh(
            x_edges,
            [time for time, _ in case.results.steps],  # a step fills the interval that it ends
            centres,
            cmap="PuOr_r" if signed else "viridis",
            vmin=-largest if signed else 0.0,
            vmax=largest,
            rasterized=centres.size > 20000,
        )
        axes.set_title(f"{quantity.title}, {case.label}")
    figure.colorbar(drawn, ax=list(row), label=quantity.label)


def cells_of_nodes(along: Array, table: Any) -> tuple[Array, Any]:
    """Cells between the midpoints of neighbouring nodes; the two values at a node shared by facets are averaged."""
    nodes, where = np.unique(np.round(along, 12), return_inverse=True)
    count = np.zeros((len(table), len(nodes)))
    total = np.zeros_like(count)
    for column, node in enumerate(where):
        seen = ~table.mask[:, column]
        total[seen, node] += table.data[seen, column]
        count[:, node] += seen
    mean = masked(total / np.maximum(count, 1.0), count == 0)
    return np.concatenate((nodes[:1], 0.5 * (nodes[1:] + nodes[:-1]), nodes[-1:])), mean


def masked(values: Any, hidden: Any) -> Any:
    make: Any = np.ma.masked_array  # untyped
    return make(np.asarray(values), mask=np.asarray(hidden))
