"""The paper's Figures 2, 3 and 4: deformed configuration, temperature, von Mises stress at the final time."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize, PowerNorm
from matplotlib.tri import Triangulation

from oracle_parts import vtu
from plotting.results import Array
from plotting.style import PANEL, Album, Case, panels

MESH_COLOUR, OUTLINE_COLOUR = "#0072B2", "#333333"
LARGEST_SHARE = 0.12  # of the body's extent: displacements are drawn no larger
VECTOR_CELLS = 20000  # finer meshes become bitmaps within the PDF
MARGIN = 0.04
CONTRAST = (
    4.0  # between the cases: above it the colours go by the square root, or the weaker one would be black
)


def edges(grid: vtu.Grid) -> tuple[Array, Array]:
    """The mesh's edges as rows of nodes from end to end, and the same of the outline only."""
    quadratic = grid.cell_type == vtu.QUADRATIC_TRIANGLE
    rows = ((0, 3, 1), (1, 4, 2), (2, 5, 0)) if quadratic else ((0, 1), (1, 2), (2, 0))
    every = np.concatenate([grid.cells[:, row] for row in rows])
    ends = np.sort(every[:, [0, -1]], axis=1)
    _, first, count = np.unique(ends, axis=0, return_index=True, return_counts=True)
    return every[first], every[first[count == 1]]


def triangulation(grid: vtu.Grid) -> Triangulation:
    """Straight triangles through all nodes: four to a quadratic one."""
    cells = grid.cells
    if grid.cell_type == vtu.QUADRATIC_TRIANGLE:
        parts = ((0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5))
        cells = np.stack([cells[:, part] for part in parts], axis=1).reshape(-1, 3)
    return Triangulation(grid.points[:, 0], grid.points[:, 1], cells)


def round_down(value: float) -> float:
    """To 1, 2 or 5 times a power of ten."""
    power = 10.0 ** np.floor(np.log10(value))
    return float(max(step for step in (1.0, 2.0, 5.0) if step * power <= value * (1 + 1e-12)) * power)


def displacement_scale(cases: Sequence[Case]) -> float:
    """One for all cases, such that the largest displacement is well seen."""
    largest = max(float(np.abs(case.results.point_field("displacement")).max()) for case in cases)
    extent = max(float(np.ptp(case.results.body.points, axis=0).max()) for case in cases)
    return round_down(LARGEST_SHARE * extent / largest) if largest > 0.0 else 1.0


def finish(axes: Any, case: Case) -> None:
    axes.set_aspect("equal")
    axes.margins(MARGIN)
    axes.set_title(f"{case.label}, t = {case.results.final_time:g} s")
    axes.set_xlabel("x (m)")


def row_of_panels(cases: Sequence[Case]) -> tuple[Any, Any]:
    figure, grid = panels(1, len(cases), PANEL, PANEL, sharex=True, sharey=True)
    grid[0, 0].set_ylabel("y (m)")
    return figure, grid[0]


def draw_deformed(cases: Sequence[Case], album: Album) -> None:
    scale = displacement_scale(cases)
    figure, row = row_of_panels(cases)
    for axes, case in zip(row, cases):
        grid = case.results.body
        every, outline = edges(grid)
        moved = grid.points[:, :2] + scale * case.results.point_field("displacement")[:, :2]
        mesh = LineCollection(moved[every], colors=MESH_COLOUR, linewidths=0.5)
        mesh.set_rasterized(len(grid.cells) > VECTOR_CELLS)
        axes.add_collection(mesh)
        axes.add_collection(
            LineCollection(
                grid.points[outline][:, :, :2],
                colors=OUTLINE_COLOUR,
                linewidths=1.4,
                linestyles="--",
            )
        )
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
        drawn = axes.tripcolor(
            triangulation(case.results.body), field, shading="gouraud", cmap="inferno", norm=norm
        )
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
        drawn_on = triangulation(case.results.body)
        faces = np.repeat(field, len(drawn_on.triangles) // len(field))
        drawn = axes.tripcolor(drawn_on, facecolors=faces, cmap="viridis", vmin=0.0, vmax=high)
        # Neighbouring polygons would otherwise leave hairlines of background between them.
        drawn.set_edgecolor("face")
        drawn.set_linewidth(0.2)
        drawn.set_rasterized(len(faces) > VECTOR_CELLS)
        finish(axes, case)
        note_range(axes, field, "Pa")
    figure.colorbar(drawn, ax=list(row), label="von Mises stress, mean of each cell (Pa)", shrink=0.85)
    figure.suptitle("Von Mises stress")
    album.save(figure, "von-mises")


def note_range(axes: Any, field: Array, unit: str) -> None:
    """What a common colour scale hides."""
    axes.set_title(f"{axes.get_title()}: {field.min():.3g} to {field.max():.3g} {unit}")
