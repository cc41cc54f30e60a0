"""[material], [heat], [region.NAME] and [load]: what the body is made of and what acts inside of it."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from oracle_parts.errors import SceneError
from oracle_parts.expressions import Expression
from oracle_parts.own_laws import OwnLaw
from oracle_parts.read_own_law import OwnLaws, own_law, own_law_of
from oracle_parts.scene import Heat, Material, Matrix, Tensor4
from oracle_parts.tables import Table, expression, list_of, number, one_of, positive


def isotropic(trace: float, shear: float, dimension: int) -> Matrix:
    """Voigt matrix of tau -> trace tr(tau) I + shear tau."""
    size = dimension * (dimension + 1) // 2
    matrix = shear / 2 * np.eye(size)
    matrix[:dimension, :dimension] = trace + shear * np.eye(dimension)
    return matrix


def _voigt(raw: Any) -> Matrix:
    """3 x 3 or 6 x 6, which the form that it enters will check against the dimension."""
    matrix = np.array(list_of(list_of(number, len(raw)), len(raw))(raw))
    if len(matrix) not in (3, 6):
        raise ValueError("expected a Voigt matrix")
    if not np.array_equal(matrix, matrix.T):
        raise ValueError("expected a symmetric matrix")
    return matrix


def conductor(dimension: int) -> Callable[[Any], Matrix]:
    """Reads a symmetric d x d matrix; the scalar s means s I."""

    def convert(raw: Any) -> Matrix:
        if not isinstance(raw, list):
            return number(raw) * np.eye(dimension)
        matrix = np.array(list_of(list_of(number, dimension), dimension)(raw))
        if not np.array_equal(matrix, matrix.T):
            raise ValueError("expected a symmetric matrix")
        return matrix

    return convert


def read_regions(
    tables: Table, material: Material | None, heat: Heat | None, dimension: int, files: OwnLaws
) -> dict[str, tuple[Material | None, Heat | None]]:
    """Each region's laws: its own where it has some, else the scene's."""
    regions = {}
    for name in sorted(tables.left):
        table = tables.table(name)
        assert table is not None
        own_material, own_heat = material, heat
        if (part := table.table("material")) is not None and material is not None:
            own_material = _region_material(part, material, dimension, files)
        if (part := table.table("heat")) is not None and heat is not None:
            own_heat = _region_heat(part, heat, material, dimension, files)
        table.close()
        regions[name] = (own_material, own_heat)
    return regions


def _region_material(table: Table, general: Material, dimension: int, files: OwnLaws) -> Material:
    elasticity, viscosity = table.table("elasticity"), table.table("viscosity")
    plane = "strain" if general.plane_strain else "stress"
    if elasticity is not None and ("young" in elasticity or "elasticity" in files) and dimension == 2:
        elasticity.left.setdefault("plane", plane)
    own = Material(
        table.optional("density", positive),
        _elasticity(elasticity, dimension, files, general.elasticity),
        _viscosity(viscosity, general.plane_strain, dimension, files, general.viscosity),
        general.plane_strain,
    )
    table.close()
    return Material(
        own.density if own.density is not None else general.density,
        own.elasticity or general.elasticity,
        own.viscosity or general.viscosity,
        general.plane_strain,
    )


def _region_heat(
    table: Table, general: Heat, material: Material | None, dimension: int, files: OwnLaws
) -> Heat:
    own = _heat_laws(table, material, dimension, files, general.source)
    zz = own.thermal_stress_zz if own.thermal_stress is not None else general.thermal_stress_zz
    given = {name: value for name, value in vars(own).items() if value is not None}
    return replace(general, **{**given, "thermal_stress_zz": zz})


def read_material(table: Table | None, dimension: int, files: OwnLaws) -> Material | None:
    if table is None:
        return None
    density = table.optional("density", positive)
    elasticity, viscosity = table.table("elasticity"), table.table("viscosity")
    table.close()
    if elasticity is None and viscosity is None:
        raise SceneError("material needs elasticity, viscosity or both")
    plane_strain = bool(elasticity and elasticity.left.get("plane") == "strain")
    return Material(
        density,
        _elasticity(elasticity, dimension, files),
        _viscosity(viscosity, plane_strain, dimension, files),
        plane_strain,
    )


def _own_tensor(
    table: Table, kind: str, files: OwnLaws, plane_strain: bool, general: Tensor4 | None
) -> Tensor4:
    before = general.own.numbers if general and general.own else {}
    own = own_law(table, kind, files, before)
    table.close()
    return Tensor4(np.empty(0), own=own, plane_strain=plane_strain)


def _elasticity(
    table: Table | None, dimension: int, files: OwnLaws, general: Tensor4 | None = None
) -> Tensor4 | None:
    if table is None:
        return None
    if "elasticity" in files:
        plane = table.take("plane", one_of("stress", "strain"), "stress") if dimension == 2 else "none"
        return _own_tensor(table, "elasticity", files, plane == "strain", general)
    tensor = table.optional("tensor", _voigt)
    if tensor is not None:
        table.close()
        return Tensor4(tensor)
    young, poisson = table.take("young", positive), table.take("poisson", number)
    plane = table.take("plane", one_of("stress", "strain"), "stress") if dimension == 2 else "none"
    table.close()
    shear = young / (1 + poisson)
    if plane == "stress":
        return Tensor4(isotropic(young * poisson / (1 - poisson**2), shear, 2))
    lame = young * poisson / ((1 + poisson) * (1 - 2 * poisson))
    return Tensor4(isotropic(lame, shear, dimension), lame)


def _viscosity(
    table: Table | None, plane_strain: bool, dimension: int, files: OwnLaws, general: Tensor4 | None = None
) -> Tensor4 | None:
    if table is None:
        return None
    if "viscosity" in files:
        return _own_tensor(table, "viscosity", files, plane_strain, general)
    tensor = table.optional("tensor", _voigt)
    if tensor is not None:
        table.close()
        return Tensor4(tensor)
    trace, shear = table.take("trace", number), table.take("shear", number)
    table.close()
    return Tensor4(isotropic(trace, shear, dimension), trace if plane_strain else 0.0)


def read_heat(table: Table | None, material: Material | None, dimension: int, files: OwnLaws) -> Heat | None:
    if table is None:
        return None
    heat = _heat_laws(table, material, dimension, files)
    if heat.capacity is None and heat.conductivity is None:
        raise SceneError("heat needs capacity, conductivity or both")
    couplings = (heat.thermal_stress, heat.strain_heating, heat.strain_rate_heating)
    if material is None and any(coupling is not None for coupling in couplings):
        raise SceneError("heat.thermal_stress, strain_heating and strain_rate_heating need [material]")
    return heat


def _source(table: Table, files: OwnLaws, general: Any) -> Expression | OwnLaw | None:
    if "source" not in files:
        return table.optional("source", expression)
    before = general.numbers if isinstance(general, OwnLaw) else {}
    return own_law_of(table.table("source"), "source", files, before)


def _heat_laws(
    table: Table, material: Material | None, dimension: int, files: OwnLaws, general: Any = None
) -> Heat:
    symmetric = conductor(dimension)
    out_of_plane = (
        material and material.plane_strain and not isinstance(table.left.get("thermal_stress"), list)
    )
    thermal_stress = table.optional("thermal_stress", symmetric)
    heat = Heat(
        capacity=table.optional("capacity", positive),
        conductivity=table.optional("conductivity", symmetric),
        source=_source(table, files, general),
        thermal_stress=thermal_stress,
        thermal_stress_zz=float(thermal_stress[0, 0]) if thermal_stress is not None and out_of_plane else 0.0,
        strain_heating=table.optional("strain_heating", symmetric),
        strain_rate_heating=table.optional("strain_rate_heating", symmetric),
    )
    table.close()
    return heat


def read_body_force(load: Table, dimension: int, files: OwnLaws) -> list[Expression] | OwnLaw | None:
    if "body_force" not in files:
        return load.optional("body_force", list_of(expression, dimension))
    return own_law_of(load.table("body_force"), "body_force", files)
