"""What runs are judged against: references of their own, and by how much these may be off."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from lattice_errors import NORMS, Array, Body, Solution, read
from plan_parts.calls import Program, Settings
from tradeoff_parts.bounds import Bound, bound

INSTANTS = 8
SIDES = ("left", "right", "bottom", "top", "front", "back")
HALVED = (2.0, 4.0)
TIGHTER = 8.0  # of tolerances: errors of schemes of second order go with the power 2/3, a fourth
IN_SPACE, IN_TIME, IN_TOLERANCE = (
    2.0,
    2.0,
    2.0 / 3.0,
)  # theory: of the strain, degree 2; schemes of second order
COMPONENTS = dict(zip(("velocity", "strain", "temperature"), NORMS))
FIELDS = {"velocity": "velocity", "strain": "displacement", "temperature": "temperature"}


@dataclass(frozen=True)
class Fine:
    """Of degree 2, on quadrilaterals or hexahedra where it is graded, else on the scene's own cells."""

    cells: tuple[int, ...]  # (): those of a file
    scheme: str
    steps: int
    tolerance: float | None = None
    grading: tuple[float, ...] = ()  # ratios at SIDES
    end: float | None = None  # of a scene that states its step

    def settings(self) -> Settings:
        words = [f'time.scheme="{self.scheme}"', "space.degree=2"]
        words += [f"mesh.cells={json.dumps(self.cells)}"] if self.cells else []
        words += ['mesh.cell="tensor"'] if self.grading else []
        words += [f"mesh.grading.{side}={ratio:g}" for side, ratio in zip(SIDES, self.grading)]
        words += [f"time.tolerance={self.tolerance:.13g}"] if self.tolerance else []
        words += [f"time.step={self.end / self.steps:.13g}" if self.end else f"time.steps={self.steps}"]
        return Settings(words, self.steps)

    def coarser_in_space(self, by: int) -> "Fine":
        """An axis with one cell keeps it."""
        return replace(self, cells=tuple(max(1, count // by) for count in self.cells))

    def coarser_in_time(self, level: int) -> "Fine":
        if self.tolerance:
            return replace(self, tolerance=self.tolerance * TIGHTER**level)
        return replace(self, steps=self.steps // 2**level)


# of the scenes of README: as fine as a minute or two allow
REFERENCES = {
    "paper": Fine((128, 128), "generalized-alpha", 256),
    # in adaptive steps: errors of equal ones fall no faster than k, as contact opens within them
    "paper-isotropic": Fine((256, 64), "bdf2", 16, 1e-4, (4, 4, 8, 40)),
    "impact": Fine((64, 64), "generalized-alpha", 1024, grading=(4, 4, 4, 4)),
    "box": Fine((16, 16, 8), "generalized-alpha", 96, grading=(16, 16, 4, 4, 1, 4)),
}


def finer_than(settings: Settings, ratio: int) -> Fine:
    """Of a scene that is not in the table: the run's own kind of mesh, by a scheme of second order."""
    cells = tuple(count * ratio if count > 1 else 1 for count in settings.cells)
    found = [settings.value(f"mesh.grading.{side}") for side in SIDES]
    grading = tuple(float(value) for value in found if value is not None)
    step, tolerance = settings.value("time.step"), settings.value("time.tolerance")
    own = json.loads(settings.value("time.scheme") or '"bdf2"')
    scheme = "bdf2" if own == "backward-euler" else own
    end = float(step) * settings.steps if step else None
    if tolerance:
        return Fine(cells, scheme, settings.steps, float(tolerance) / TIGHTER**2, grading, end)
    return Fine(cells, scheme, 4 * settings.steps, None, grading, end)


@dataclass(frozen=True)
class Judged:
    """The largest error of all components, relative to the largest norm of each, and where it lies whatever the
    reference errs by."""

    error: float
    least: float
    most: float

    @property
    def bound(self) -> float:
        return max(self.error - self.least, self.most - self.error)


class Reference:
    """The reference of one scene and the bounds of its error: its mesh twice coarsened alone, and, on the first of these
    meshes, its steps. tradeoff_parts/bounds.py says what follows."""

    def __init__(self, program: Program, scene: str, fine: Fine, components: Sequence[str]) -> None:
        self.program, self.scene = program, scene
        self.columns = [NORMS.index(COMPONENTS[name]) for name in components]
        self.names = [FIELDS[name] for name in components]
        self.solution = self.fields(fine.settings())
        self.body = Body(self.solution.mesh)
        self.size = self.body.norms(self.solution).max(axis=0)[self.columns]
        self.bounds: Mapping[str, list[Bound]] = self._bounds(fine)

    def fields(self, settings: Settings) -> Solution:
        """At the instants, without the initial state: it is the same in all runs but for the mesh."""
        with TemporaryDirectory() as name:
            self.program.run(self.scene, Path(name), settings.at_instants(INSTANTS), self.names)
            solution = read(Path(name))
        return Solution(solution.mesh, solution.times[1:], solution.frames[1:])

    def apart(self, one: Solution, two: Solution) -> Array:
        found: Array = self.body.norms(one, two).max(axis=0)[self.columns]
        return np.divide(found, self.size, out=np.zeros_like(found), where=self.size > 0)

    def _of_chain(self, source: str, chain: Sequence[Solution], ratio: float, order: float) -> list[Bound]:
        first, second = (self.apart(coarse, fine) for fine, coarse in zip(chain, chain[1:]))
        return [
            bound(source, (ratio, ratio**2), order, (float(a), float(b))) for a, b in zip(first, second)
        ]

    def _bounds(self, fine: Fine) -> Mapping[str, list[Bound]]:
        found = {}
        if fine.cells:
            meshes = [self.fields(fine.coarser_in_space(int(by)).settings()) for by in HALVED]
            found["space"] = self._of_chain("space", [self.solution, *meshes], HALVED[0], IN_SPACE)
            base, first = fine.coarser_in_space(int(HALVED[0])), meshes[0]
        else:
            base, first = fine, self.solution
        times = [self.fields(base.coarser_in_time(level).settings()) for level in (1, 2)]
        ratio, order = (TIGHTER, IN_TOLERANCE) if fine.tolerance else (HALVED[0], IN_TIME)
        found["time"] = self._of_chain("time", [first, *times], ratio, order)
        return found

    @property
    def own(self) -> Array:
        """By component."""
        return np.array([[entry.value for entry in of] for of in self.bounds.values()]).sum(axis=0)

    def judge(self, run: Solution) -> Judged:
        errors = self.apart(run, self.solution)
        self.body.kept.clear()  # the operators of a mesh that does not come again
        return Judged(*(float(np.max(errors + sign * self.own)) for sign in (0, -1, 1)))
