"""One step's equation A x + c(x) = b, with c acting on contact facets only: Newton with a line search.

A is constant in time and assembled once. A Newton step copies it and assembles the contact Jacobian on top; the
sparsity pattern never changes, so that MUMPS analyses it once. Without contact terms the factors are kept too.
"""

import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt
from dolfinx.fem import petsc as fem_petsc
from petsc4py import PETSc

from oracle_parts.errors import NumericsError
from oracle_parts.linear import multigrid, mumps
from oracle_parts.portability import petsc_vector

# Round-off can stop the residual above solver.tolerance; a standstill below this, relative to the terms, is accepted.
STANDSTILL = 1e-11
SMALLEST_STEP = 2.0**-12
SUFFICIENT_DECREASE = 1e-4


class Term(Protocol):
    """A part of c(x): what one law gives on one contact side, and its derivative without rows and columns of `bcs`."""

    def add_residual(self, vector: Any) -> None:
        ...

    def add_jacobian(self, matrix: Any, bcs: Sequence[Any]) -> None:
        ...


@dataclass(frozen=True)
class CompiledTerm:
    """Both as compiled forms."""

    residual: Any
    jacobian: Any

    def add_residual(self, vector: Any) -> None:
        fem_petsc.assemble_vector(vector, self.residual)

    def add_jacobian(self, matrix: Any, bcs: Sequence[Any]) -> None:
        fem_petsc.assemble_matrix(matrix, self.jacobian, bcs)  # type: ignore[arg-type]


@dataclass(frozen=True)
class Tolerances:
    relative: float
    max_iterations: int


class StepEquation:
    def __init__(
        self,
        name: str,
        matrix: Any,
        constrained_matrix: Any,
        bcs: Sequence[Any],
        constrained: npt.NDArray[np.int32],
        unknown: Any,
        terms: Sequence[Term],
        nonlinear: bool,
        tolerances: Tolerances,
        solver: str = "direct",
        symmetric: bool = False,
    ) -> None:
        """`solver`: "direct" or "amg", see `linear`; `symmetric`: whether the derivatives of the terms are."""
        self.name, self.matrix, self.constant = name, matrix, constrained_matrix
        self.bcs, self.unknown, self.terms = list(bcs), unknown, terms
        self.nonlinear, self.tolerances = nonlinear, tolerances
        self.x = petsc_vector(unknown)
        self.residual, self.applied = matrix.createVecLeft(), matrix.createVecLeft()
        self.contact = self.x.duplicate()  # ghosted, unlike the two above
        self.correction = matrix.createVecRight()
        self.jacobian = constrained_matrix.copy() if terms else constrained_matrix
        self.constrained = constrained[constrained < self.residual.getLocalSize()]
        # a correction that is solved for approximately says less about the error than the residual does
        self.exact = solver == "direct"
        if solver == "amg":
            self.solver = multigrid(self.jacobian, unknown, symmetric, nonlinear)
        else:
            self.solver = mumps(self.jacobian)
        self.solver_seconds = 0.0

    def solve(self, b: Any, polish: bool = False) -> int:
        """Improve the guess in `unknown`, whose constrained values must be set. Returns the Newton iterations.

        With `polish` also a guess that needs none, by one iteration, which is not counted.
        """
        if not self.nonlinear:
            self._evaluate(b)
            self._correct()
            self._move(-1.0)
            if not np.isfinite(self.x.norm()):
                raise NumericsError(f"{self.name}: the linear solver returned a non-finite value")
            return 0
        return self._newton(b, polish and self.exact)

    def _newton(self, b: Any, polish: bool) -> int:
        """Converged where the residual is small beside its terms, or the correction beside the unknown.

        The second matters where the terms themselves cancel, as in a body that moves almost rigidly: their
        round-off then keeps the residual up, and not the error.
        """
        tolerance = self.tolerances.relative
        norm, scale = self._evaluate(b)
        if not np.isfinite(norm):
            raise NumericsError(f"{self.name}: the residual is not finite")
        for iteration in range(1, self.tolerances.max_iterations + 1):
            if norm <= tolerance * scale:
                if polish and iteration == 1 and norm > 0:
                    self._polish(b, norm)
                return iteration - 1
            self._correct()
            self._move(-1.0)
            new_norm, scale = self._evaluate(b)
            change = self.correction.norm()
            size = self.x.norm()
            if self.exact and change <= tolerance * size:
                return iteration
            standstill = new_norm <= STANDSTILL * scale or change <= STANDSTILL * size
            if standstill and new_norm > 0.5 * norm:
                return iteration
            norm, scale = self._line_search(b, norm, new_norm, scale)
        if norm <= tolerance * scale:
            return self.tolerances.max_iterations
        raise NumericsError(
            f"{self.name}: no convergence in {self.tolerances.max_iterations} Newton iterations"
        )

    def _polish(self, b: Any, norm: float) -> None:
        self._correct()
        self._move(-1.0)
        if not self._evaluate(b)[0] < norm:
            self._move(1.0)

    def _line_search(self, b: Any, norm: float, new_norm: float, scale: float) -> tuple[float, float]:
        """Halve the step just taken until the residual falls; its norm and scale there."""
        length = 1.0
        while not new_norm <= (1.0 - SUFFICIENT_DECREASE * length) * norm:
            if length < SMALLEST_STEP:
                raise NumericsError(
                    f"{self.name}: the line search found no decrease (residual {norm:.1e}, its terms {scale:.1e}); "
                    "a larger friction regularisation or more time steps help"
                )
            length /= 2.0
            self._move(length)
            new_norm, scale = self._evaluate(b)
        return new_norm, scale

    def _evaluate(self, b: Any) -> tuple[float, float]:
        """F = A x + c(x) - b; its norm and the sum of the norms of its terms, all on the free unknowns."""
        self.matrix.mult(self.x, self.applied)
        self.applied.array[self.constrained] = 0.0
        b.array[self.constrained] = 0.0
        self.applied.copy(self.residual)
        self.residual.axpy(-1.0, b)
        scale = self.applied.norm() + b.norm() if self.nonlinear else 0.0
        if self.terms:
            with self.contact.localForm() as local:
                local.set(0.0)
            for term in self.terms:
                term.add_residual(self.contact)
            self.contact.ghostUpdate(addv=PETSc.InsertMode.ADD, mode=PETSc.ScatterMode.REVERSE)
            self.contact.array[self.constrained] = 0.0
            self.residual.axpy(1.0, self.contact)
            scale += self.contact.norm()
        return self.residual.norm(), scale

    def _correct(self) -> None:
        if self.terms:
            self.constant.copy(self.jacobian, PETSc.Mat.Structure.SAME_NONZERO_PATTERN)
            for term in self.terms:
                term.add_jacobian(self.jacobian, self.bcs)
                self.jacobian.assemble()
        start = time.perf_counter()
        self.solver.solve(self.residual, self.correction)
        self.solver_seconds += time.perf_counter() - start
        if self.solver.getConvergedReason() < 0:
            raise NumericsError(
                f"{self.name}: the system is singular, or its linear solver does not converge"
            )

    def _move(self, factor: float) -> None:
        self.x.axpy(factor, self.correction)
        self.unknown.x.scatter_forward()
