"""Linear solvers of the oracle: MUMPS, or Krylov's methods with PETSc's smoothed aggregation multigrid.

The multigrid is set up as its documentation advises for elasticity: rigid motions as near-nullspace, blocks of the
space's dimension, the hierarchy of the first matrix kept for all that follow (contact changes a few rows of it), the
squared graph for two levels and the weakest couplings dropped. Conjugate gradients where the matrix is symmetric,
GMRES where friction makes it otherwise. Newton's corrections are solved to CORRECTION, a balance that is linear
to EXACT: verification/benchmark.py --study multigrid says what other values cost.
"""

from typing import Any

import numpy as np
from petsc4py import PETSc

CORRECTION = 1e-4
EXACT = 1e-11
MOST_ITERATIONS = 1000


def mumps(matrix: Any) -> Any:
    solver = PETSc.KSP().create(matrix.comm)
    solver.setOperators(matrix)
    solver.setType(PETSc.KSP.Type.PREONLY)
    solver.getPC().setType(PETSc.PC.Type.LU)
    solver.getPC().setFactorSolverType(PETSc.Mat.SolverType.MUMPS)
    return solver


def multigrid(matrix: Any, unknown: Any, symmetric: bool, newton: bool) -> Any:
    """`unknown` is a function of the space; `newton`: the solutions are corrections of an iteration."""
    size = unknown.function_space.dofmap.index_map_bs
    if size > 1:
        matrix.setNearNullSpace(rigid_motions(matrix, unknown.function_space, size))
    solver = PETSc.KSP().create(matrix.comm)
    solver.setOptionsPrefix(f"oracle_{size}_")
    options = PETSc.Options(f"oracle_{size}_")
    options["pc_gamg_aggressive_coarsening"] = 2
    options["pc_gamg_threshold"] = 0.01
    solver.setOperators(matrix)
    solver.setType(PETSc.KSP.Type.CG if symmetric else PETSc.KSP.Type.GMRES)
    if not symmetric:
        solver.setGMRESRestart(60)
        solver.setPCSide(PETSc.PC.Side.RIGHT)
    solver.setNormType(PETSc.KSP.NormType.UNPRECONDITIONED)
    solver.setTolerances(rtol=CORRECTION if newton else EXACT, max_it=MOST_ITERATIONS)
    solver.getPC().setType(PETSc.PC.Type.GAMG)
    solver.getPC().setReusePreconditioner(True)
    solver.setFromOptions()
    return solver


def rigid_motions(matrix: Any, space: Any, dimension: int) -> Any:
    """Translations and rotations, orthonormal."""
    vectors = [matrix.createVecRight() for _ in range(3 if dimension == 2 else 6)]
    owned = vectors[0].getLocalSize() // dimension
    x = space.tabulate_dof_coordinates()[:owned]
    planes = [(0, 1)] if dimension == 2 else [(0, 1), (1, 2), (2, 0)]
    for axis in range(dimension):
        vectors[axis].array.reshape(-1, dimension)[:, axis] = 1.0
    for vector, (i, j) in zip(vectors[dimension:], planes):
        values = vector.array.reshape(-1, dimension)
        values[:, i], values[:, j] = -x[:, j], x[:, i]
    basis: list[Any] = []
    for vector in vectors:  # Gram and Schmidt, twice: rotations about a far origin are nearly translations
        for _ in range(2):
            for other in basis:
                vector.axpy(-float(np.real(other.dot(vector))), other)
        vector.normalize()
        basis.append(vector)
    return PETSc.NullSpace().create(vectors=basis, comm=matrix.comm)
