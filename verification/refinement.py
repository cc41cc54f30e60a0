"""Meshes that adapt, against meshes that are uniformly fine, on a solution with a singular point that is known.

    refinement.py [--output DIR] [--small] [--driver PROGRAM]

A temperature that is harmonic, r^(1/2) sin(phi/2) about a point where the kind of boundary condition changes, in the
plane and, the same along z, in space. The true error of the heat flux is integrated on the driver's own mesh, element by
element, and so judges the driver's estimate, too. Theory (P. Binev, W. Dahmen, R. DeVore, Numer. Math. 97 (2004)
219-268): with N unknowns, adaptive meshes of degree p reach the order p/d of smooth solutions; uniform ones 1/(2 d). Of
degree 2 in space no mesh of bisected tetrahedra does, as the singular edge takes more of them than the order allows.

Exits 1 if an order is more than 0.1 below theory's (of uniform meshes: off by that, either way), if the estimate is not
within a fifth of the true error, or a tolerance is not met.
"""

import argparse
import csv
import json
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from oracle_parts import vtu
from plotting.style import Album, panels, styled

HERE = Path(__file__).resolve().parent
Array = npt.NDArray[Any]
OFF, FAITHFUL = 0.1, 0.2

SCENE = """[mesh]
file = "body.msh"
{refinement}
[space]
degree = {degree}
[time]
end = 1.0
steps = 1
[heat]
conductivity = 1.0
[boundary.around]
temperature = "sqrt(max(sqrt(x^2 + y^2) - x, 0)/2)"
[boundary.held]
temperature = 0.0
[output]
fields = ["temperature"]
"""
REFINEMENT = "[mesh.refinement]\ntolerance = {}\nmax_cells = 2000000\nmax_level = 60"


@dataclass(frozen=True)
class Series:
    dimension: int
    degree: int
    tolerances: Sequence[float]
    uniform: Sequence[int]  # cells along y

    @property
    def name(self) -> str:
        return f"{self.dimension}D, degree {self.degree}"

    @property
    def order(self) -> float:
        return self.degree / self.dimension


@dataclass(frozen=True)
class Point:
    series: Series
    tolerance: float | None  # None: a uniform mesh
    unknowns: int
    error: float  # relative, true
    estimate: float | None


SERIES = (
    Series(2, 1, (0.2, 0.1, 0.05, 0.025, 0.0125), (4, 8, 16, 32, 64)),
    Series(2, 2, (0.02, 0.01, 0.005, 0.002, 0.001), (4, 8, 16, 32)),
    Series(3, 1, (0.4, 0.3, 0.2, 0.14, 0.1, 0.07), (2, 4, 8, 16)),
)
SMALL = (Series(2, 1, (0.1, 0.05, 0.025), (8, 16, 32)), Series(2, 2, (0.01, 0.003, 0.001), (4, 8, 16)))

# Kuhn's: corners of a cube by the bits of their numbers, x first
CUBE = ((0, 1, 3, 7), (0, 1, 5, 7), (0, 4, 5, 7), (0, 2, 3, 7), (0, 4, 6, 7), (0, 2, 6, 7))


def write_mesh(path: Path, dimension: int, n: int) -> None:
    """[-1, 1] x [0, 1] (x [0, 1]) in Gmsh's format 2.2. `held` is y = 0 < x; x < 0 = y is free, as are the ends in z."""
    counts = (2 * n, n, n)[:dimension]
    grids = np.meshgrid(*(np.arange(count + 1) for count in reversed(counts)), indexing="ij")
    numbers = np.stack([grid.ravel() for grid in reversed(grids)], axis=1)
    points = np.zeros((len(numbers), 3))
    points[:, :dimension] = numbers / n - np.array((1.0, 0.0, 0.0))[:dimension]
    strides = np.cumprod([1, *(count + 1 for count in counts[:-1])])
    inner = np.all(numbers < counts, axis=1)
    corner = np.nonzero(inner)[0]
    simplices = ((0, 1, 3), (0, 2, 3)) if dimension == 2 else CUBE
    offsets = [sum(int(strides[axis]) for axis in range(dimension) if bits >> axis & 1) for bits in range(8)]
    cells = np.concatenate([corner[:, None] + [offsets[bits] for bits in cell] for cell in simplices])
    facets: dict[str, list[Array]] = {"held": [], "around": []}
    for left_out in range(dimension + 1):
        sides = np.delete(cells, left_out, axis=1)
        x = points[sides]
        low = np.all(x[:, :, 1] == 0, axis=1)
        facets["held"].append(sides[low & (x[:, :, 0].mean(axis=1) > 0)])
        outside = np.any([np.all(x[:, :, a] == v, axis=1) for a, v in ((0, -1), (0, 1), (1, 1))], axis=0)
        facets["around"].append(sides[outside])
    parts = [(np.concatenate(facets["held"]), 1), (np.concatenate(facets["around"]), 2), (cells, 3)]
    kinds = {2: 1, 3: 2, 4: 4}
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "3", f'{dimension - 1} 1 "held"']
    lines += [f'{dimension - 1} 2 "around"', f'{dimension} 3 "body"', "$EndPhysicalNames", "$Nodes"]
    lines += [
        str(len(points)),
        *(f"{i + 1} {x:.17g} {y:.17g} {z:.17g}" for i, (x, y, z) in enumerate(points)),
    ]
    lines += ["$EndNodes", "$Elements", str(sum(len(rows) for rows, _ in parts))]
    number = 0
    for rows, group in parts:
        for row in rows:
            number += 1
            corners = " ".join(str(vertex + 1) for vertex in row)
            lines.append(f"{number} {kinds[rows.shape[1]]} 2 {group} {group} {corners}")
    path.write_text("\n".join([*lines, "$EndElements", ""]), encoding="ascii")


def exact_gradient(x: Array) -> Array:
    """Of r^(1/2) sin(phi/2)."""
    r, phi = np.hypot(x[..., 0], x[..., 1]), np.arctan2(x[..., 1], x[..., 0])
    slope = 0.5 / np.sqrt(np.maximum(r, 1e-300))
    zero = np.zeros_like(r)
    return np.stack([-slope * np.sin(phi / 2), slope * np.cos(phi / 2), zero], axis=-1)


def rule(dimension: int, points: int = 6) -> tuple[Array, Array]:
    """Barycentric points and weights of a conical product of Gauss's rules: its points crowd toward the first corner."""
    nodes, weights = np.polynomial.legendre.leggauss(points)
    s, w = (nodes + 1) / 2, weights / 2
    grids = np.meshgrid(*([s] * dimension), indexing="ij")
    volumes = np.meshgrid(*([w] * dimension), indexing="ij")
    u = np.stack([grid.ravel() for grid in grids], axis=1)
    weight = np.prod(np.stack([volume.ravel() for volume in volumes]), axis=0)
    if dimension == 2:
        places = np.stack([1 - u[:, 0], u[:, 0] * (1 - u[:, 1]), u[:, 0] * u[:, 1]], axis=1)
        return places, weight * u[:, 0] * 2
    a, b, c = u.T
    places = np.stack([1 - a, a * (1 - b), a * b * (1 - c), a * b * c], axis=1)
    return places, weight * a**2 * b * 6


# ends of the edges in the order of VTK's nodes
EDGES = {3: ((0, 1), (1, 2), (0, 2)), 4: ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3))}


def true_error(grid: vtu.Grid, degree: int) -> float:
    """||grad(theta - theta_h)|| / ||grad(theta)||; the corner nearest to the singular place comes first."""
    corners = vtu.VERTICES[grid.cell_type]
    dimension = corners - 1
    nearest = np.hypot(*grid.points[grid.cells[:, :corners], :2].transpose(2, 0, 1)).argmin(axis=1)
    places, weights = rule(dimension)
    errors = sizes = 0.0
    for first in range(corners):
        cells = grid.cells[nearest == first]
        x = grid.points[cells[:, :corners], :dimension]
        edges = x[:, 1:] - x[:, :1]
        slopes = np.linalg.inv(edges).transpose(0, 2, 1)  # of the coordinates 1..d: [cells, d, axis]
        slopes = np.concatenate([-slopes.sum(axis=1, keepdims=True), slopes], axis=1)
        volume = np.abs(np.linalg.det(edges)) / (2 if dimension == 2 else 6)
        theta = np.asarray(grid.point_data["temperature"]).ravel()[cells]
        turned = np.roll(places, first, axis=1)  # the first column belongs to the corner `first`
        if degree == 1:
            gradient = np.einsum("cv,cvi->ci", theta, slopes)[:, None]
        else:
            shapes = [(4 * turned[:, v] - 1)[None, :, None] * slopes[:, v][:, None] for v in range(corners)]
            for a, b in EDGES[corners]:
                along = turned[:, a][None, :, None] * slopes[:, b][:, None]
                shapes.append(4 * (along + turned[:, b][None, :, None] * slopes[:, a][:, None]))
            gradient = np.einsum("nc,ncqi->cqi", theta.T, np.stack(shapes))
        exact = exact_gradient(np.einsum("qv,cvi->cqi", turned, x))[..., :dimension]
        for difference, name in ((exact - gradient, "error"), (exact, "size")):
            square = float(np.einsum("cqi,cqi,q,c->", difference, difference, weights, volume))
            errors, sizes = (errors + square, sizes) if name == "error" else (errors, sizes + square)
    return float(np.sqrt(errors / sizes))


def solve(driver: Path, folder: Path, series: Series, tolerance: float | None, n: int) -> Point:
    folder.mkdir(parents=True)
    write_mesh(folder / "body.msh", series.dimension, n)
    refinement = "" if tolerance is None else REFINEMENT.format(tolerance)
    scene = folder / "scene.toml"
    scene.write_text(SCENE.format(refinement=refinement, degree=series.degree), encoding="ascii")
    subprocess.run([driver, "run", scene, "--quiet", "--output", folder], check=True)
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    error = true_error(vtu.read_grid(folder / "fields" / "body_000001.vtu"), series.degree)
    told = summary["mesh"].get("refinement", {}).get("last_error")
    return Point(series, tolerance, summary["mesh"]["unknowns"]["temperature"], error, told)


def order(points: Sequence[Point]) -> float:
    """Of the error in the unknowns, fitted."""
    logs = np.log([[point.unknowns, point.error] for point in points])
    return -float(np.polyfit(logs[:, 0], logs[:, 1], 1)[0])


def faults(series: Series, adaptive: Sequence[Point], uniform: Sequence[Point]) -> list[str]:
    found = []
    for what, points, expected in (
        ("adaptive", adaptive, series.order),
        ("uniform", uniform, 0.5 / series.dimension),
    ):
        found_order = order(points)
        # meshes of loose tolerances have cells that only the base mesh asks for: adaptive orders come out above theory's
        if found_order < expected - OFF or (what == "uniform" and found_order > expected + OFF):
            found.append(f"{series.name}, {what}: order {order(points):.3f}, expected {expected:.3f}")
    for point in adaptive:
        assert point.estimate is not None and point.tolerance is not None
        if point.estimate > point.tolerance:
            found.append(f"{series.name}: tolerance {point.tolerance} not met: {point.estimate:.3g}")
        if abs(point.estimate / point.error - 1) > FAITHFUL:
            found.append(f"{series.name}: estimate {point.estimate:.3g} of an error {point.error:.3g}")
    return found


def picture(folder: Path, points: Sequence[Point]) -> None:
    """A panel a dimension, a colour a degree; adaptive drawn through, uniform dashed, theory's slopes dotted."""
    dimensions = sorted({point.series.dimension for point in points})
    with styled():
        figure, grid = panels(1, len(dimensions), 5.2, 4.4, sharey=True)
        for axes, dimension in zip(grid[0], dimensions):
            for series in dict.fromkeys(p.series for p in points if p.series.dimension == dimension):
                for adaptive in (True, False):
                    some = [p for p in points if p.series == series and (p.tolerance is not None) == adaptive]
                    draw_series(axes, series, some, adaptive)
            axes.set_xlim(right=30 * max(axes.get_xlim()[1] / 10, 1e3))  # room for the words
            axes.set_xlabel("unknowns")
            axes.set_title(f"{'in the plane' if dimension == 2 else 'in space'}; dotted: theory's orders")
            axes.grid(True, which="major", color="#ececec", linewidth=0.6)
        grid[0, 0].set_ylabel("relative error of the heat flux")
        Album(folder, small=True).save(figure, "refinement")


def draw_series(axes: Any, series: Series, points: Sequence[Point], adaptive: bool) -> None:
    colour = {1: "#0072B2", 2: "#D55E00"}[series.degree]
    x, y = np.array([(point.unknowns, point.error) for point in points]).T
    axes.loglog(x, y, "o-" if adaptive else "s--", color=colour, markersize=5)
    expected = series.order if adaptive else 0.5 / series.dimension
    ends = np.array([x[-1] / 16, x[-1]])
    axes.loglog(ends, 0.8 * y[-1] * (x[-1] / ends) ** expected, ":", color=colour, linewidth=1.4)
    what = f"degree {series.degree}, {'adaptive' if adaptive else 'uniform'}:\norder {order(points):.2f}"
    up = 0 if adaptive else 9 if series.degree == 1 else -9
    said = {"textcoords": "offset points", "va": "center", "color": colour, "fontsize": 9}
    axes.annotate(what, (x[-1], y[-1]), (8, up), **said)


def main(arguments: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(description="Adaptive against uniform meshes.")
    parser.add_argument("--output", type=Path)
    parser.add_argument("--small", action="store_true")
    parser.add_argument("--driver", type=Path, default=HERE.parent / "build" / "thermocontact")
    options = parser.parse_args(arguments)
    points: list[Point] = []
    found: list[str] = []
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        for series in SMALL if options.small else SERIES:
            adaptive = [
                solve(options.driver, folder / f"{series.name}-{tolerance}", series, tolerance, 2)
                for tolerance in series.tolerances
            ]
            uniform = [
                solve(options.driver, folder / f"{series.name}-uniform-{n}", series, None, n)
                for n in series.uniform
            ]
            for point in (*adaptive, *uniform):
                aim = "uniform" if point.tolerance is None else f"{point.tolerance:g}"
                told = "" if point.estimate is None else f"{point.estimate:.4g}"
                print(f"{series.name:16s} {aim:>8s} {point.unknowns:8d} {point.error:.4g} {told}")
            print(
                f"{series.name}: order {order(adaptive):.3f} adaptive, {order(uniform):.3f} uniform",
                flush=True,
            )
            found += faults(series, adaptive, uniform)
            points += [*adaptive, *uniform]
    if options.output:
        options.output.mkdir(parents=True, exist_ok=True)
        with (options.output / "refinement.csv").open("w", encoding="ascii", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(["series", "tolerance", "unknowns", "error", "estimate"])
            writer.writerows([p.series.name, p.tolerance, p.unknowns, p.error, p.estimate] for p in points)
        picture(options.output, points)
    for fault in found:
        print(f"refinement: {fault}", file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
