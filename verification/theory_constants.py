"""Compare the constants that `thermocontact check` prints with those of dolfinx's matrices and SciPy's eigenvalues.

    theory_constants.py SCENE.toml [--set KEY=VALUE]... [--driver PROGRAM]

The constants are those of (2.12)-(2.15) on the scene's mesh. Exits 0 if all agree to the six digits printed, 1 if not,
2 if the driver could not run.
"""

import argparse
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import scipy.sparse
import scipy.sparse.linalg
import ufl
from dolfinx import fem
from dolfinx.fem import petsc as fem_petsc
from mpi4py import MPI

from oracle_parts.domain import Prescribed, Side, create_body
from oracle_parts.portability import lagrange_space
from oracle_parts.scene import Scene, read_scene

HERE = Path(__file__).resolve().parent
PRINTED_DIGITS = 1e-5  # relative; six digits are printed


class Space:
    """A space of fields that vanish where values are prescribed, with a norm of its own."""

    def __init__(self, space: Any, prescribed: Prescribed, norm: Any) -> None:
        self.free = np.setdiff1d(
            np.arange(space.dofmap.index_map.size_local * space.dofmap.index_map_bs), prescribed.dofs
        )
        self.trial, self.test = ufl.TrialFunction(space), ufl.TestFunction(space)
        self.gram = self.matrix(norm(self.trial, self.test))

    def matrix(self, form: Any) -> Any:
        assembled = fem_petsc.assemble_matrix(fem.form(form))
        assembled.assemble()
        rows, columns, values = assembled.getValuesCSR()
        full = scipy.sparse.csr_matrix((values, columns, rows), shape=assembled.getSize())
        return full[self.free][:, self.free].tocsc()

    def largest(self, *measures: Any) -> float:
        """max ||v||^2 / |v|^2, the first norm in L2 of all measures together."""
        numerator = sum(self.matrix(ufl.inner(self.trial, self.test) * measure) for measure in measures)
        values = scipy.sparse.linalg.eigsh(numerator, k=1, M=self.gram, which="LA", return_eigenvectors=False)
        return float(values[0])


def expected(scene: Scene) -> dict[str, float]:
    """The constants by name, of a body that is held."""
    body = create_body(MPI.COMM_SELF, scene)
    mesh = body.mesh
    sides = {name: Side(body, name) for name in scene.boundaries}
    found: dict[str, float] = {}
    if scene.material:
        space = lagrange_space(mesh, scene.degree, scene.dimension)
        prescribed = Prescribed(space, scene)
        for name, boundary in scene.boundaries.items():
            for component, value in enumerate(boundary.displacement or []):
                if value is not None:
                    prescribed.add(sides[name], component, value)
        V = Space(
            space, prescribed, lambda u, v: ufl.inner(ufl.sym(ufl.grad(u)), ufl.sym(ufl.grad(v))) * ufl.dx
        )
        found["c_k"] = (1 + V.largest(ufl.dx)) ** -0.5
        contact = [sides[name].ds() for name, law in scene.contacts.items() if law.compliance]
        if contact:
            found["s1"] = V.largest(*contact) ** 0.5
    if scene.heat:
        space = lagrange_space(mesh, scene.degree)
        prescribed = Prescribed(space, scene)
        for name, boundary in scene.boundaries.items():
            if boundary.temperature:
                prescribed.add(sides[name], 0, boundary.temperature)
        Q = Space(space, prescribed, lambda u, v: ufl.inner(ufl.grad(u), ufl.grad(v)) * ufl.dx)
        found["c_f"] = Q.largest(ufl.dx) ** -0.5
        contact = [sides[name].ds() for name, law in scene.contacts.items() if law.conductance]
        if contact:
            found["s2"] = Q.largest(*contact) ** 0.5
    return found


def printed(text: str) -> dict[str, float]:
    """The constants in the driver's answer."""
    lines = re.findall(r"^  (s1|s2|c_k|c_f) *= (\S+)", text, flags=re.MULTILINE)
    return {name: float(value) for name, value in lines}


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("scene", type=Path)
    parser.add_argument("--set", action="append", default=[], dest="overrides", metavar="KEY=VALUE")
    parser.add_argument("--driver", default=str(HERE.parent / "build" / "thermocontact"))
    arguments = parser.parse_args()
    settings = [word for setting in arguments.overrides for word in ("--set", setting)]
    driver = subprocess.run(
        [arguments.driver, "check", str(arguments.scene), *settings], capture_output=True, text=True
    )
    if driver.returncode != 0:
        print(driver.stderr, file=sys.stderr)
        return 2
    found, wanted = printed(driver.stdout), expected(read_scene(arguments.scene, arguments.overrides))
    agree = found.keys() == wanted.keys()
    print(f"{'':5} {'driver':>14} {'dolfinx, SciPy':>18}")
    for name in sorted(found.keys() | wanted.keys()):
        here, there = found.get(name, float("nan")), wanted.get(name, float("nan"))
        close = abs(here - there) <= PRINTED_DIGITS * abs(there)
        agree = agree and close
        print(f"{name:5} {here:14.6g} {there:18.12g}{'' if close else '   differs'}")
    return 0 if agree else 1


if __name__ == "__main__":
    sys.exit(main())
