"""Compare the numbers that `thermocontact check` prints with those of dolfinx's matrices and SciPy's eigenvalues.

    theory_constants.py SCENE.toml [--set KEY=VALUE]... [--driver PROGRAM]

They are the constants of (2.12)-(2.15) on the scene's mesh, the quotients r_a and r_d that weigh the contact laws against
the body's operators, and the bounds of densities and tensors over all regions. Exits 0 if all agree to the six digits
printed, 1 if not, 2 if the driver could not run.
"""

import argparse
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import basix
import numpy as np
import scipy.sparse
import scipy.sparse.linalg
import ufl
from dolfinx import fem
from dolfinx.fem import petsc as fem_petsc
from mpi4py import MPI

from oracle_parts.body_laws import measure, stress
from oracle_parts.domain import Body, Prescribed, Side, create_body
from oracle_parts.portability import lagrange_space
from oracle_parts.problem import Piece, pieces_of, strain
from oracle_parts.read_scene import read_scene
from oracle_parts.scene import Contact, Scene, Tensor4

HERE = Path(__file__).resolve().parent
PRINTED_DIGITS = 1e-5  # relative; six digits are printed
CONSTANTS = ("s1", "s2", "c_k", "c_f", "r_a", "r_d")
BOUNDS = ("rho", "c", "m_b", "M_b", "m_a", "M_a", "m_d", "M_d", "|M|", "|R|")


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
        return self.quotient([ufl.inner(self.trial, self.test) * measure for measure in measures])

    def quotient(self, numerator: list[Any]) -> float:
        """Of the sum of these forms; scaled to a matrix of order 1, for SciPy's tolerances."""
        matrix = sum(self.matrix(form) for form in numerator)
        scale = abs(matrix).max() / abs(self.gram).max()
        values = scipy.sparse.linalg.eigsh(
            matrix / scale, k=1, M=self.gram, which="LA", return_eigenvectors=False
        )
        return float(scale * values[0])


def lipschitz(contact: Contact) -> float:
    """L_nu + L_tau."""
    assert contact.compliance
    if contact.compliance.exponent != 1:
        return np.inf
    friction = contact.friction.coefficient if contact.friction else 0.0
    return contact.compliance.stiffness * (1 + friction)


def own_matrices(body: Body, scene: Scene, tensor: Tensor4) -> Any:
    """Voigt matrices of a law file's tensor at every point of its rule, [points][s][s]."""
    d = scene.dimension
    pairs = [(i, i) for i in range(d)] + ([(1, 2), (0, 2), (0, 1)] if d == 3 else [(0, 1)])

    def unit(i: int, j: int) -> Any:
        e = np.zeros((d, d))
        e[i, j] += 0.5
        e[j, i] += 0.5
        return ufl.as_matrix(e.tolist())

    columns = [stress(body.mesh, tensor, unit(*pair))[0] for pair in pairs]
    entries = ufl.as_vector([sigma[pair] for pair in pairs for sigma in columns])
    degree = body.full_rule.get("quadrature_degree", 2 * scene.degree + 2)
    cell = getattr(basix.CellType, body.mesh.topology.cell_name())
    points, _ = basix.make_quadrature(cell, degree)
    cells = np.arange(body.mesh.topology.index_map(d).size_local, dtype=np.int32)
    return fem.Expression(entries, points).eval(cells).reshape(-1, len(pairs), len(pairs))


def bounds(scene: Scene, body: Body, pieces: list[Piece]) -> dict[str, float]:
    """Of densities and tensors over all pieces: the least of ellipticity, the greatest of norms."""
    found: dict[str, float] = {"rho": 0.0, "c": 0.0}  # of what is not modelled

    def note(name: str, values: Any, choose: Any) -> None:
        found[name] = float(choose(values))

    def eigenvalues(matrix: Any, shear_from: int) -> Any:
        """Of a fourth-order tensor on symmetric ones: Voigt's form, its engineering shear scaled by sqrt(2) twice."""
        scale = np.where(np.arange(len(matrix)) < shear_from, 1.0, np.sqrt(2.0))
        return np.linalg.eigvalsh(scale[:, None] * matrix * scale)

    if scene.material:
        note("rho", [piece.material.density or 0.0 for piece in pieces], min)
        for index, law in (("b", "viscosity"), ("a", "elasticity")):
            tensors = [getattr(piece.material, law) for piece in pieces]
            if tensors[0]:
                is_own = tensors[0].own is not None
                matrices = (
                    own_matrices(body, scene, tensors[0]) if is_own else [tensor.voigt for tensor in tensors]
                )
                spectra = [eigenvalues(matrix, scene.dimension) for matrix in matrices]
                note(f"m_{index}", [spectrum[0] for spectrum in spectra], min)
                note(f"M_{index}", [np.abs(spectrum).max() for spectrum in spectra], max)
    if scene.heat:
        note("c", [piece.heat.capacity or 0.0 for piece in pieces], min)
        if scene.heat.conductivity is not None:
            spectra = [np.linalg.eigvalsh(piece.heat.conductivity) for piece in pieces]
            note("m_d", [spectrum[0] for spectrum in spectra], min)
            note("M_d", [np.abs(spectrum).max() for spectrum in spectra], max)
        for letter, law in (("M", "thermal_stress"), ("R", "strain_heating")):
            if getattr(scene.heat, law) is not None:
                note(f"|{letter}|", [np.linalg.norm(getattr(piece.heat, law)) for piece in pieces], max)
    return found


def expected(scene: Scene) -> dict[str, float]:
    """The numbers by name, of a body that is held."""
    body = create_body(MPI.COMM_SELF, scene)
    mesh = body.mesh
    one = fem.Constant(mesh, 1.0)
    pieces = [piece for piece in pieces_of(body, scene) if fem.assemble_scalar(fem.form(one * piece.dx)) > 0]
    found = bounds(scene, body, pieces)
    sides = {name: Side(body, name) for name in scene.boundaries}
    if scene.material:
        space = lagrange_space(mesh, scene.degree, scene.dimension)
        prescribed = Prescribed(space, scene)
        for name, boundary in scene.boundaries.items():
            for component, value in enumerate(boundary.displacement or []):
                if value is not None:
                    prescribed.add(sides[name], component, value)
        V = Space(space, prescribed, lambda u, v: ufl.inner(strain(u), strain(v)) * ufl.dx)
        found["c_k"] = (1 + V.largest(ufl.dx)) ** -0.5
        mechanical = {name: law for name, law in scene.contacts.items() if law.compliance}
        if mechanical:
            found["s1"] = V.largest(*(sides[name].ds() for name in mechanical)) ** 0.5
            if found.get("m_a", 0.0) > 0:
                found["r_a"] = against_elasticity(
                    space, prescribed, body, scene.degree, pieces, mechanical, sides, scene
                )
    if scene.heat:
        space = lagrange_space(mesh, scene.degree)
        prescribed = Prescribed(space, scene)
        for name, boundary in scene.boundaries.items():
            if boundary.temperature:
                prescribed.add(sides[name], 0, boundary.temperature)
        Q = Space(space, prescribed, lambda u, v: ufl.inner(ufl.grad(u), ufl.grad(v)) * ufl.dx)
        found["c_f"] = Q.largest(ufl.dx) ** -0.5
        thermal = {name: law for name, law in scene.contacts.items() if law.conductance}
        if thermal:
            found["s2"] = Q.largest(*(sides[name].ds() for name in thermal)) ** 0.5
            if found.get("m_d", 0.0) > 1e-14 * found.get("M_d", 0.0):
                found["r_d"] = against_conduction(space, prescribed, pieces, thermal, sides)
    return found


def against_elasticity(
    space: Any,
    prescribed: Prescribed,
    body: Body,
    degree: int,
    pieces: list[Piece],
    contacts: dict[str, Contact],
    sides: dict[str, Side],
    scene: Scene,
) -> float:
    """r_a: max of int (L_nu + L_tau) |v|^2 / ((E eps(v), eps(v)) + int k_s v.v)."""
    if not all(np.isfinite(lipschitz(law)) for law in contacts.values()):
        return np.inf

    def stored(u: Any, v: Any) -> Any:
        tensors = [piece.material.elasticity for piece in pieces]
        return sum(
            ufl.inner(stress(space.mesh, tensor, strain(u))[0], strain(v))
            * measure(body, degree, piece.dx, tensor.own is not None)
            for tensor, piece in zip(tensors, pieces)
        )

    fields = Space(space, prescribed, stored)
    for name, boundary in scene.boundaries.items():
        if boundary.spring:
            k_s = fem.Constant(space.mesh, boundary.spring.stiffness)
            fields.gram += fields.matrix(ufl.inner(k_s * fields.trial, fields.test) * sides[name].ds())
    weighted = [
        lipschitz(law) * ufl.inner(fields.trial, fields.test) * sides[name].ds()
        for name, law in contacts.items()
    ]
    return fields.quotient(weighted)


def against_conduction(
    space: Any,
    prescribed: Prescribed,
    pieces: list[Piece],
    contacts: dict[str, Contact],
    sides: dict[str, Side],
) -> float:
    """r_d: max of int k_c eta^2 / (K grad eta, grad eta)."""

    def conducted(u: Any, v: Any) -> Any:
        tensors = [fem.Constant(space.mesh, piece.heat.conductivity) for piece in pieces]
        return sum(
            ufl.inner(tensor * ufl.grad(u), ufl.grad(v)) * piece.dx for tensor, piece in zip(tensors, pieces)
        )

    fields = Space(space, prescribed, conducted)
    weighted = [
        law.conductance.coefficient * fields.trial * fields.test * sides[name].ds()
        for name, law in contacts.items()
        if law.conductance is not None
    ]
    return fields.quotient(weighted)


def printed(text: str) -> dict[str, float]:
    """The numbers in the driver's answer; those of physics that is absent stand for none."""
    names = "|".join(map(re.escape, CONSTANTS))
    constants = re.findall(rf"^  ({names}) *= (\S+)", text, flags=re.MULTILINE)
    names = "|".join(map(re.escape, BOUNDS))
    hypotheses = text.partition("hypotheses of the theory")[2]
    bounded = re.findall(rf"(?:: |, )({names}) = ([^\s,]+)", hypotheses)
    return {name: float(value) for name, value in [*bounded, *constants]}


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
        close = here == there or abs(here - there) <= PRINTED_DIGITS * abs(there)
        agree = agree and close
        print(f"{name:5} {here:14.6g} {there:18.12g}{'' if close else '   differs'}")
    return 0 if agree else 1


if __name__ == "__main__":
    sys.exit(main())
