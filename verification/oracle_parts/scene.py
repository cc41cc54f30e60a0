"""The scene as plain data: what the keys of the interface say that the oracle verifies."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from oracle_parts.expressions import Expression
from oracle_parts.own_laws import OwnLaw

Matrix = npt.NDArray[np.float64]
SIDES = (("left", "right"), ("bottom", "top"), ("front", "back"))  # of each axis


@dataclass(frozen=True)
class Tensor4:
    """Voigt matrix with engineering shear, and in 2D sigma_zz = out_of_plane * tr(strain); or a law file.

    The order is xx, yy, xy in 2D and xx, yy, zz, yz, xz, xy in 3D.
    """

    voigt: Matrix  # empty where `own` says
    out_of_plane: float = 0.0
    own: OwnLaw | None = None
    plane_strain: bool = False  # of `own`: strains have their components out of the plane


@dataclass(frozen=True)
class Material:
    density: float | None
    elasticity: Tensor4 | None
    viscosity: Tensor4 | None
    plane_strain: bool  # there is an out-of-plane stress to report


@dataclass(frozen=True)
class Heat:
    capacity: float | None
    conductivity: Matrix | None
    source: Expression | OwnLaw | None
    thermal_stress: Matrix | None
    thermal_stress_zz: float
    strain_heating: Matrix | None
    strain_rate_heating: Matrix | None


@dataclass(frozen=True)
class Compliance:
    stiffness: float  # nan where `own` says
    exponent: float
    own: OwnLaw | None


@dataclass(frozen=True)
class Friction:
    coefficient: float  # nan where `own` says
    regularisation: float
    own: OwnLaw | None
    heat_share: float


@dataclass(frozen=True)
class Conductance:
    coefficient: float  # nan where `own` says
    onset: float
    foundation_temperature: Expression
    limit: float | None
    own: OwnLaw | None


@dataclass(frozen=True)
class Convection:
    coefficient: float
    ambient_temperature: Expression


@dataclass(frozen=True)
class Spring:
    stiffness: Matrix
    anchor: list[Expression] | None  # None: the far ends are fixed


@dataclass(frozen=True)
class Contact:
    gap: Expression
    quadrature: int | str
    foundation_velocity: list[Expression] | None
    compliance: Compliance | None
    friction: Friction | None
    conductance: Conductance | None


@dataclass(frozen=True)
class Boundary:
    """One named side; a component of the displacement that is None is free."""

    displacement: list[Expression | None] | None
    traction: list[Expression] | None
    spring: Spring | None
    temperature: Expression | None
    heat_flux: Expression | None
    convection: Convection | None
    contact: Contact | None


@dataclass(frozen=True)
class Shape:
    """A rectangle or box of simplices or tensor cells; `grading` has the ratios at the two sides of each axis."""

    lower: list[float]
    upper: list[float]
    cells: list[int]
    cell: str
    diagonal: str
    grading: list[tuple[float, float]]


@dataclass(frozen=True)
class Scene:
    dimension: int
    shape: Shape | None  # None: the mesh is that of `file`
    file: Path | None
    degree: int
    end: float
    steps: int
    radius: float | None  # spectral radius of the scheme; None: backward Euler
    coupling_tolerance: float | None  # None: lagged
    adapts: bool  # the steps' sizes to time.tolerance
    adapts_mesh: bool  # to mesh.refinement.tolerance
    material: Material | None
    heat: Heat | None
    regions: dict[str, tuple[Material | None, Heat | None]]  # those that differ from the two above
    body_force: list[Expression] | OwnLaw | None
    initial_displacement: list[Expression]
    initial_velocity: list[Expression]
    initial_temperature: Expression
    boundaries: dict[str, Boundary]  # in alphabetical order
    tolerance: float
    max_iterations: int
    every: int
    fields: list[str]
    resolved: dict[str, Any]
    places: Any = None  # of a mesh that is followed: where its nodes are, exactly

    @property
    def step(self) -> float:
        return self.end / self.steps

    @property
    def contacts(self) -> dict[str, Contact]:
        return {name: side.contact for name, side in self.boundaries.items() if side.contact}
