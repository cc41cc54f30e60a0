"""The paper's Figures 2, 3 and 4: deformed configuration, temperature, von Mises stress at the final time."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize, PowerNorm

from plotting.results import Array
from plotting.style import PANEL, Album, Case, panels
from plotting.surface import View, outline, surface, triangulation, view_of

MESH_COLOUR, OUTLINE_COLOUR = "#0072B2", "#333333"
LARGEST_SHARE = 0.12  # of the body's extent: displacements are drawn no larger
VECTOR_CELLS = 20000  # finer meshes become bitmaps within the PDF
MARGIN = 0.04
TRIAD = 30.0  # points, the length of the arrows
CONTRAST = (
    4.0  # between the cases: above it the colours go by the square root, or the weaker one would be black
)


def round_down(value: float) -> float:
    """To 1, 2 or 5 times a power of ten."""
    power = 10.0 ** np.floor(np.log10(value))
    return float(max(step for step in (1.0, 2.0, 5.0) if step * power <= value * (1 + 1e-12)) * power)


def displacement_scale(cases: Sequence[Case]) -> float:
    """One for all cases, such that the largest displacement is well seen."""
    largest = max(float(np.abs(case.results.point_field("displacement")).max()) for case in cases)
    extent = max(float(np.ptp(case.results.body.points, axis=0).max()) for case in cases)
    return round_down(LARGEST_SHARE * extent / largest) if largest > 0.0 else 1.0


def view(case: Case) -> View:
    grids = case.results.contact_grids if case.results.contact_names else []
    return view_of(case.results.body, grids[-1] if grids else None)


def finish(axes: Any, case: Case) -> None:
    axes.set_aspect("equal")
    axes.margins(MARGIN)
    axes.set_title(f"{case.label}, t = {case.results.final_time:g} s")
    if view(case).solid:
        draw_axes(axes, view(case))
    else:
        axes.set_xlabel("x (m)")


def draw_axes(axes: Any, seen_from: View) -> None:
    """The directions of x, y and z at the lower right, in place of axes with numbers."""
    axes.set_axis_off()
    for name, along in zip("xyz", TRIAD * seen_from.axes[:2].T):
        arrow = {"arrowstyle": "<-", "color": OUTLINE_COLOUR, "shrinkA": 0.0, "shrinkB": 0.0}
        where = {"xycoords": "axes fraction", "textcoords": "offset points"}
        axes.annotate(
            name, (1.0, 0.0), xytext=tuple(along), arrowprops=arrow, ha="center", va="center", **where
        )


def row_of_panels(cases: Sequence[Case]) -> tuple[Any, Any]:
    figure, grid = panels(1, len(cases), PANEL, PANEL, sharex=True, sharey=True)
    grid[0, 0].set_ylabel("y (m)")
    return figure, grid[0]


def draw_deformed(cases: Sequence[Case], album: Album) -> None:
    scale = displacement_scale(cases)
    figure, row = row_of_panels(cases)
    for axes, case in zip(row, cases):
        grid, seen_from = case.results.body, view(case)
        moved = grid.points + scale * case.results.point_field("displacement")
        seen = surface(grid, seen_from, moved)
        flat, every = seen_from.project(moved), seen.edges()[0]
        if seen_from.solid:  # hides what lies behind
            faces = triangulation(seen_from, moved, seen.triangles()[0])
            axes.tripcolor(faces, np.zeros(len(moved)), cmap="Blues", vmin=-0.3, vmax=2.0, shading="gouraud")
        mesh = LineCollection(flat[every], colors=MESH_COLOUR, linewidths=0.5)
        mesh.set_rasterized(len(seen.cells) > VECTOR_CELLS)
        axes.add_collection(mesh)
        before = seen_from.project(grid.points)[outline(grid, seen_from)]
        axes.add_collection(LineCollection(before, colors=OUTLINE_COLOUR, linewidths=1.4, linestyles="--"))
        axes.autoscale_view()
        finish(axes, case)
    size = f"displacement × {scale:g}" + (" (true size)" if scale == 1.0 else "")
    figure.suptitle(f"Deformed mesh over the undeformed outline\n{size}")
    album.save(figure, "deformed")


def colour_limits(fields: Sequence[Array]) -> tuple[float, float]:
    return min(float(field.min()) for field in fields), max(float(field.max()) for field in fields)


def common_colours(fields: Sequence[Array]) -> tuple[Normalize, str]:
    low, high = colour_limits(fields)
    weakest = min(float(field.max()) for field in fields)
    if low >= 0.0 and high > CONTRAST * weakest:
        return PowerNorm(0.5, vmin=0.0, vmax=high), ", colours by its square root"
    return Normalize(vmin=low, vmax=high), ""


def draw_temperature(cases: Sequence[Case], album: Album) -> None:
    fields = [case.results.point_field("temperature") for case in cases]
    norm, remark = common_colours(fields)
    figure, row = row_of_panels(cases)
    for axes, case, field in zip(row, cases, fields):
        grid, seen_from = case.results.body, view(case)
        triangles, _ = surface(grid, seen_from, grid.points).triangles()
        drawn = axes.tripcolor(
            triangulation(seen_from, grid.points, triangles),
            field,
            shading="gouraud",
            cmap="inferno",
            norm=norm,
        )
        draw_outline(axes, case)
        finish(axes, case)
        note_range(axes, field, "K")
    figure.colorbar(drawn, ax=list(row), label=rf"temperature $\theta$ (K){remark}", shrink=0.85)
    figure.suptitle("Temperature")
    album.save(figure, "temperature")


def draw_von_mises(cases: Sequence[Case], album: Album) -> None:
    fields = [case.results.cell_field("von_mises") for case in cases]
    high = colour_limits(fields)[1]
    figure, row = row_of_panels(cases)
    for axes, case, field in zip(row, cases, fields):
        grid, seen_from = case.results.body, view(case)
        triangles, owners = surface(grid, seen_from, grid.points).triangles()
        drawn_on = triangulation(seen_from, grid.points, triangles)
        drawn = axes.tripcolor(drawn_on, facecolors=field[owners], cmap="viridis", vmin=0.0, vmax=high)
        # Neighbouring polygons would otherwise leave hairlines of background between them.
        drawn.set_edgecolor("face")
        drawn.set_linewidth(0.2)
        drawn.set_rasterized(len(owners) > VECTOR_CELLS)
        draw_outline(axes, case)
        finish(axes, case)
        note_range(axes, field, "Pa")
    figure.colorbar(drawn, ax=list(row), label="von Mises stress, mean of each cell (Pa)", shrink=0.85)
    figure.suptitle("Von Mises stress")
    album.save(figure, "von-mises")


def draw_outline(axes: Any, case: Case) -> None:
    """Of a body in space, without which its edges are not seen."""
    seen_from, grid = view(case), case.results.body
    if seen_from.solid:
        lines = seen_from.project(grid.points)[outline(grid, seen_from)]
        axes.add_collection(LineCollection(lines, colors=OUTLINE_COLOUR, linewidths=0.6))


def note_range(axes: Any, field: Array, unit: str) -> None:
    """What a common colour scale hides."""
    axes.set_title(f"{axes.get_title()}\n{field.min():.3g} to {field.max():.3g} {unit}")
