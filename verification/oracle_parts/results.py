"""What a run leaves behind as it goes: fields at the output steps, and a row of history per step.

Fields are gathered on rank 0, which alone writes; with `output.fields = []` nothing is gathered.
"""

import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, TextIO

import numpy as np
import numpy.typing as npt
import ufl
from dolfinx import fem
from dolfinx.fem import petsc as fem_petsc

from oracle_parts import vtu
from oracle_parts.contact import ContactSide
from oracle_parts.domain import Body, node_points
from oracle_parts.portability import cell_nodes, lagrange_space
from oracle_parts.scene import Scene

Array = npt.NDArray[Any]


class Stopwatch:
    """Seconds of wall time by purpose."""

    def __init__(self) -> None:
        self.start = time.perf_counter()
        self.seconds = {"setup": 0.0, "factor": 0.0, "steps": 0.0, "output": 0.0}

    @contextmanager
    def timing(self, purpose: str) -> Iterator[None]:
        start = time.perf_counter()
        yield
        self.seconds[purpose] += time.perf_counter() - start

    def totals(self) -> dict[str, float]:
        return {**self.seconds, "total": time.perf_counter() - self.start}


class CellStress:
    """Cell means of the stress: xx, yy, zz, xy, yz, xz."""

    def __init__(self, body: Body, parts: Sequence[tuple[Any, Any, Any]]) -> None:
        """`parts`: sigma (d x d), sigma_zz of a body in 2D, and the measure of the cells where they hold."""
        q, r = (ufl.TestFunction(lagrange_space(body.mesh, 0, size)) for size in (6, 1))
        integrals = 0
        for sigma, sigma_zz, dx in parts:
            zero = 0.0 * sigma_zz
            if body.mesh.topology.dim == 3:
                shears = (sigma[0, 1], sigma[1, 2], sigma[0, 2])
                components = (sigma[0, 0], sigma[1, 1], sigma[2, 2], *shears)
            else:
                components = (sigma[0, 0], sigma[1, 1], sigma_zz, sigma[0, 1], zero, zero)
            integrals += ufl.dot(ufl.as_vector(components), q) * dx
        self.form = fem.form(integrals)
        volumes = fem_petsc.assemble_vector(fem.form(r * body.dx()))
        self.volumes = volumes.array.copy()
        volumes.destroy()

    def means(self) -> Array:
        vector = fem_petsc.assemble_vector(self.form)
        result = vector.array.reshape(-1, 6) / self.volumes[:, None]
        vector.destroy()
        return result


def von_mises(stress: Array) -> Array:
    """Of tensors with the six components xx, yy, zz, xy, yz, xz."""
    xx, yy, zz, xy, yz, xz = stress.T
    normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2
    return np.sqrt(0.5 * normal + 3.0 * (xy**2 + yz**2 + xz**2))


class FieldWriter:
    """Writes the body and its contact sides at output steps, and the collection over time."""

    def __init__(
        self,
        directory: Path,
        scene: Scene,
        mesh: Any,
        scalar_space: Any,
        state: dict[str, Any],
        stress: CellStress | None,
        contacts: Sequence[ContactSide],
    ) -> None:
        """`state` holds the functions displacement, velocity, temperature that the scene has."""
        self.directory, self.names, self.comm = directory, scene.fields, mesh.comm
        self.state, self.stress, self.space = state, stress, scalar_space
        self.contacts = contacts if "contact" in self.names else []
        self.datasets: list[vtu.DataSet] = []
        if not self.names:
            return
        if self.comm.rank == 0:
            (directory / "fields").mkdir(parents=True, exist_ok=True)
        self.owned_nodes = scalar_space.dofmap.index_map.size_local
        tdim = mesh.topology.dim
        nodes = cell_nodes(scalar_space, mesh.topology.index_map(tdim).size_local)
        numbers = scalar_space.dofmap.index_map.local_to_global(nodes.ravel()).reshape(nodes.shape)
        self.dimension = tdim
        self.kind, order = vtu.VTK_CELLS[mesh.topology.cell_name(), nodes.shape[1]]
        self.cells = self._gather(numbers[:, order])
        self.points = self._gather(node_points(scalar_space, scene)[: self.owned_nodes])
        self.order = {
            name: _node_order(function.function_space, nodes)
            for name, function in state.items()
            if name != "temperature"
        }

    def write(self, step: int, now: float) -> None:
        if not self.names:
            return
        self._write_grid(step, now, 0, "body", self._body())
        if self.contacts:
            self._write_grid(step, now, 1, "contact", self._contact_grid())
        if self.comm.rank == 0:
            vtu.write_collection(self.directory / "fields.pvd", self.datasets)

    def _write_grid(self, step: int, now: float, part: int, stem: str, grid: vtu.Grid | None) -> None:
        if grid is None:
            return
        file = f"fields/{stem}_{step:06d}.vtu"
        vtu.write_grid(self.directory / file, grid)
        self.datasets.append(vtu.DataSet(now, part, file))

    def _gather(self, local: Array) -> Array:
        """Rows of all processes in their order, on rank 0; empty elsewhere."""
        parts = self.comm.gather(local, root=0)
        return np.concatenate(parts) if parts is not None else local[:0]

    def _body(self) -> vtu.Grid | None:
        point_data, cell_data = {}, {}
        for name in ("displacement", "velocity", "temperature"):
            if name in self.names:
                point_data[name] = self._gather(self._node_values(name))
        if self.stress and ("stress" in self.names or "von_mises" in self.names):
            stress = self._gather(self.stress.means())
            everything = {"stress": stress, "von_mises": von_mises(stress)}
            cell_data = {name: everything[name] for name in everything if name in self.names}
        if self.comm.rank != 0:
            return None
        return vtu.Grid(self.points, self.cells, self.kind, point_data, cell_data)

    def _node_values(self, name: str) -> Array:
        """The owned rows in the scalar space's numbering; vectors with three components."""
        values = self.state[name].x.array
        if name == "temperature":
            return values[: self.owned_nodes].copy()
        return _three_components(values.reshape(-1, self.dimension)[self.order[name][: self.owned_nodes]])

    def _contact_grid(self) -> vtu.Grid | None:
        functions = [self.state.get(name) for name in ("displacement", "velocity", "temperature")]
        sides = [side.nodal(*functions) for side in self.contacts]
        shapes = {name: values.shape[2:] for side in sides for name, values in side.items()}
        data: dict[str, Array] = {}
        for name in sorted(shapes):
            rows = []
            for side, values in zip(self.contacts, sides):
                shape = side.scalar_nodes.shape + shapes[name]
                rows.append(values.get(name, np.zeros(shape)).reshape((-1, *shapes[name])))
            joined = np.concatenate(rows)
            data[name] = self._gather(_three_components(joined) if shapes[name] else joined)
        data["state"] = data["state"].astype(np.int32)
        points = self._gather(np.concatenate([side.points.reshape(-1, 3) for side in self.contacts]))
        boundary = [np.full(len(side.cells), side.index, dtype=np.int32) for side in self.contacts]
        marks = self._gather(np.concatenate(boundary))
        if self.comm.rank != 0:
            return None
        cells = np.arange(len(points)).reshape(len(marks), -1)
        kind, order = vtu.VTK_CELLS[self.contacts[0].facet, cells.shape[1]]
        return vtu.Grid(points, cells[:, order], kind, data, {"boundary": marks})


def _three_components(values: Array) -> Array:
    return np.pad(values, ((0, 0), (0, 3 - values.shape[1])))


def _node_order(space: Any, scalar_cells: Array) -> Array:
    """For each local node of the scalar space, the same node of the vector space."""
    order = np.empty(scalar_cells.max(initial=-1) + 1, dtype=np.int64)
    order[scalar_cells] = cell_nodes(space, len(scalar_cells))
    return order


class History:
    """history.csv: a row a step, each on disk before the next step begins."""

    def __init__(self, directory: Path, comm: Any) -> None:
        self.path, self.write_here = directory / "history.csv", comm.rank == 0
        self.file: TextIO | None = None
        self.iterations: list[int] = []
        self.last: dict[str, float] = {}

    def append(self, step: int, now: float, iterations: int, values: dict[str, float]) -> None:
        self.iterations.append(iterations)
        self.last = {"time": now, **values}
        if not self.write_here:
            return
        if self.file is None:
            self.file = self.path.open("w", encoding="ascii")
            self.file.write(",".join(("step", "time", "newton_iterations", *values)) + "\n")
        numbers = [f"{value:.17g}" for value in (now, *values.values())]
        self.file.write(",".join((str(step), numbers[0], str(iterations), *numbers[1:])) + "\n")
        self.file.flush()

    def close(self) -> None:
        if self.file:
            self.file.close()
