"""A run as a moving picture (GIF): the body deformed and coloured, in the plane with the foundation beneath it, the
springs that hold it, and marks that run with a belt.

    python3 verification/animate.py DIR --output FILE.gif [--field temperature] [--frames 24] [--scale 1]
        [--from SECONDS] [--until SECONDS] [--dpi 80]
    python3 verification/animate.py DIR --output FILE.png --frames 4       # the frames side by side, two in a row

Colours keep one range over all frames. The foundation is drawn where the driver's gap says that it is: the gap's length
away from the deformed contact side, along the side's outward normal.

Exit codes: 0 drawn, 1 the file cannot be written, 2 something that is needed is missing.
"""

import argparse
import io
import sys
import textwrap
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from PIL import Image
from plotting.body import MESH_COLOUR, OUTLINE_COLOUR, draw_axes
from plotting.results import Results, Unusable
from plotting.style import styled
from plotting.surface import outline, surface, triangulation, view_of

from oracle_parts import vtu
from plotting import style, surroundings

# name: what it is, its unit, whether it is a value of cells
FIELDS = {
    "temperature": ("temperature", "K", False),
    "von_mises": ("von Mises stress, mean of each cell", "Pa", True),
    "velocity": ("speed", "m/s", False),
}
COLOURS = 64  # of a frame's palette: a moving picture in a README is not to be large
WIDTH, LEAST_HEIGHT, DPI, STILL_DPI = 4.0, 2.0, 80, 110  # inches, of the body's panel
COLUMNS, CELLS_OF_STILLS = 2, 10_000  # of stills, which have points enough to tell the cells apart
TITLE = 52  # characters a line
SPRING_COLOUR = "#D55E00"
Array = style.Any


def values_of(grid: vtu.Grid, field: str) -> Array:
    name, _, on_cells = FIELDS[field]
    data = grid.cell_data if on_cells else grid.point_data
    if field not in data:
        raise Unusable(f"no field '{field}' ({name}); does output.fields of the scene leave it out?")
    found = data[field]
    return np.linalg.norm(found, axis=1) if found.ndim == 2 else found


def displacement(grid: vtu.Grid) -> Array:
    return grid.point_data.get("displacement", np.zeros_like(grid.points))


def foundation(body: vtu.Grid, moved: Array, contact: vtu.Grid) -> Array:
    """The foundation under each facet's nodes, [facets, nodes, 2]: gap n away from the deformed side."""
    facets = contact.points[contact.cells][:, :, :2]
    ends = facets[:, 1] - facets[:, 0]
    normals = np.stack([ends[:, 1], -ends[:, 0]], axis=1) / np.linalg.norm(ends, axis=1, keepdims=True)
    centres = body.points[body.cells][:, : vtu.VERTICES[body.cell_type], :2].mean(axis=1)
    middles = facets[:, :2].mean(axis=1)
    nearest = np.argmin(np.linalg.norm(middles[:, None] - centres[None], axis=2), axis=1)
    normals *= np.sign(np.einsum("ij,ij->i", normals, middles - centres[nearest]))[:, None]
    # the contact grid has points of its own: the body's at the same places tell where they went
    places = {tuple(point): i for i, point in enumerate(body.points)}
    now = np.array([moved[places[tuple(point)]][:2] for point in contact.points])
    gap = contact.point_data["gap"][contact.cells][:, :, None]
    return np.asarray(now[contact.cells] + gap * normals[:, None])


class Film:
    def __init__(
        self,
        results: Results,
        field: str,
        frames: int,
        scale: float,
        span: tuple[float, float] = (-np.inf, np.inf),
        dpi: int = DPI,
    ) -> None:
        self.dpi = dpi
        self.field, self.scale, self.title = field, scale, str(results.scene.get("title", ""))
        self.scene = results.scene
        shown_steps = [i for i, (time, _) in enumerate(results.steps) if span[0] <= time <= span[1]]
        if len(shown_steps) < 2:
            raise Unusable(f"fewer than two output times from {span[0]:g} to {span[1]:g} s")
        places = np.unique(np.linspace(0, len(shown_steps) - 1, frames).round().astype(int))
        chosen = [shown_steps[place] for place in places]
        self.times = [results.steps[i][0] for i in chosen]
        self.bodies = [vtu.without_seams(vtu.read_grid(results.steps[i][1][0])) for i in chosen]
        self.contacts = [
            vtu.read_grid(results.steps[i][1][1]) if 1 in results.steps[i][1] else None for i in chosen
        ]
        self.view = view_of(self.bodies[-1], self.contacts[-1])
        shown = [values_of(body, field) for body in self.bodies]
        self.low = float(min(values.min() for values in shown))
        self.high = float(max(values.max() for values in shown))
        self.true_size = not self.view.solid and scale == 1.0
        self.springs = surroundings.springs(self.scene, self.bodies[0]) if self.true_size else []
        flat = np.concatenate(
            [self.view.project(self.moved(i)) for i in range(len(chosen))]
            + [line for i in range(len(chosen)) for line in self.spring_lines(i)]
        )
        margin = 0.06 * float(np.ptp(flat, axis=0).max())
        self.corners = np.stack([flat.min(axis=0) - margin, flat.max(axis=0) + margin])

    def moved(self, frame: int) -> Array:
        body = self.bodies[frame]
        return body.points + self.scale * displacement(body)

    def spring_lines(self, i: int) -> list[Array]:
        moved = self.moved(i)
        return [line for spring in self.springs for line in spring.lines(moved, self.times[i])]

    def body_at(self, i: int, axes: style.Any, most_cells: int = 2000) -> style.Any:
        """Draws it, with cells where there are no more seen; returns what a scale of colours can be made of."""
        body, moved = self.bodies[i], self.moved(i)
        seen = surface(body, self.view, moved)
        triangles, owners = seen.triangles()
        values = values_of(body, self.field)
        on_cells = FIELDS[self.field][2]
        colours = {"facecolors": values[owners]} if on_cells else {"shading": "gouraud"}
        arguments = [] if on_cells else [values]
        drawn = axes.tripcolor(
            triangulation(self.view, moved, triangles),
            *arguments,
            cmap="inferno",
            vmin=self.low,
            vmax=self.high,
            **colours,
        )
        edges = seen.edges()[0] if len(seen.cells) < most_cells else outline(body, self.view)
        lines = style.matplotlib.collections.LineCollection
        axes.add_collection(
            lines(self.view.project(moved)[edges], colors=MESH_COLOUR, linewidths=0.3, alpha=0.5)
        )
        contact = self.contacts[i]
        if contact is not None and self.true_size:
            ground = foundation(body, moved, contact)[:, :2]
            axes.add_collection(lines(ground, colors=OUTLINE_COLOUR, linewidths=2.0))
            edges_of_picture = (float(self.corners[0, 0]), float(self.corners[1, 0]))
            belt = list(surroundings.marks(self.scene, ground, edges_of_picture, self.times[i]))
            axes.add_collection(lines(belt, colors=OUTLINE_COLOUR, linewidths=1.0))
        axes.add_collection(lines(self.spring_lines(i), colors=SPRING_COLOUR, linewidths=1.2))
        axes.set_xlim(*self.corners[:, 0])
        axes.set_ylim(*self.corners[:, 1])
        axes.set_aspect("equal")
        if self.view.solid:
            draw_axes(axes, self.view)
        else:
            axes.locator_params(axis="x", nbins=6)
            axes.set_xlabel("x (m)")
            axes.set_ylabel("y (m)")
        return drawn

    def time_at(self, i: int) -> str:
        size = "" if self.scale == 1.0 else f", displacement × {self.scale:g}"
        return f"t = {self.times[i]:.4g} s{size}"

    @property
    def label(self) -> str:
        name, unit, _ = FIELDS[self.field]
        return f"{name} ({unit})"

    def frame(self, i: int) -> Image.Image:
        width, height = self.corners[1] - self.corners[0]
        figure, axes = style.plt.subplots(
            figsize=(WIDTH + 1.2, 1.3 + max(LEAST_HEIGHT, WIDTH * height / width))
        )
        drawn = self.body_at(i, axes)
        axes.set_title(f"{textwrap.fill(self.title, TITLE)}\n{self.time_at(i)}")
        figure.colorbar(drawn, ax=axes, label=self.label, shrink=0.9)
        buffer = io.BytesIO()
        figure.savefig(buffer, dpi=self.dpi, format="png")
        style.plt.close(figure)
        with Image.open(buffer) as image:
            return image.convert("RGB").quantize(COLOURS, dither=Image.Dither.NONE)

    def save_moving(self, path: Path) -> None:
        first, *rest = [self.frame(i) for i in range(len(self.times))]
        first.save(path, save_all=True, append_images=rest, duration=100, loop=0, optimize=True)

    def save_stills(self, path: Path) -> None:
        """A panel a frame, with the number of its cells: meshes may follow the solution."""
        rows = -(-len(self.times) // COLUMNS)
        width, height = self.corners[1] - self.corners[0]
        figure, grid = style.panels(
            rows, COLUMNS, WIDTH + 1, 0.9 + WIDTH * float(height / width), sharex=True, sharey=True
        )
        panels = grid.ravel()
        drawn = [self.body_at(i, panels[i], CELLS_OF_STILLS) for i in range(len(self.times))]
        for i, axes in enumerate(panels[: len(drawn)]):
            axes.set_title(f"{self.time_at(i)}, {len(self.bodies[i].cells)} cells")
            axes.label_outer()
        for axes in panels[len(drawn) :]:
            axes.set_visible(False)
        figure.suptitle(self.title, fontsize=11)
        figure.colorbar(drawn[0], ax=grid, label=self.label, shrink=0.7)
        figure.savefig(path, dpi=STILL_DPI)
        style.plt.close(figure)
        style.reduce_colours(path)


def main(arguments: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(description="Draw a run as a moving picture.")
    parser.add_argument("folder", type=Path, metavar="DIR")
    parser.add_argument("--output", type=Path, required=True, metavar="FILE.gif|png")
    parser.add_argument("--field", choices=FIELDS, default="temperature")
    parser.add_argument("--frames", type=int, default=24)
    parser.add_argument("--scale", type=float, default=1.0, help="of the displacement; default 1")
    parser.add_argument(
        "--from", type=float, default=-np.inf, dest="first", help="time of the first frame, s"
    )
    parser.add_argument("--until", type=float, default=np.inf, dest="last", help="time of the last, s")
    parser.add_argument("--dpi", type=int, default=DPI, help=f"dots an inch; default {DPI}")
    options = parser.parse_args(arguments)
    if options.frames < 2:
        parser.error("--frames: expected at least 2")
    try:
        film = Film(
            Results(options.folder),
            options.field,
            options.frames,
            options.scale,
            (options.first, options.last),
            options.dpi,
        )
        with styled():
            (film.save_stills if options.output.suffix == ".png" else film.save_moving)(options.output)
    except Unusable as problem:
        print(f"animate: {problem}", file=sys.stderr)
        return 2
    except OSError as problem:
        print(f"animate: {problem}", file=sys.stderr)
        return 1
    print(options.output)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
