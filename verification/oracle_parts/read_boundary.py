"""[boundary.NAME]: what holds, pulls, warms and touches one side."""

from typing import Any

import numpy as np

from oracle_parts.errors import SceneError
from oracle_parts.expressions import Expression
from oracle_parts.read_body import conductor
from oracle_parts.read_own_law import OwnLaws, own_law
from oracle_parts.scene import (
    Boundary,
    Compliance,
    Conductance,
    Contact,
    Convection,
    Friction,
    Heat,
    Material,
    Spring,
)
from oracle_parts.tables import Table, count, expression, list_of, not_negative, number, positive


def _free_or_expression(raw: Any) -> Expression | None:
    return None if raw == "free" else expression(raw)


def read_boundary(
    sides: Table,
    name: str,
    material: Material | None,
    heat: Heat | None,
    dimension: int,
    files: OwnLaws,
) -> Boundary:
    table = sides.table(name)
    assert table is not None
    boundary = Boundary(
        displacement=table.optional("displacement", list_of(_free_or_expression, dimension)),
        traction=table.optional("traction", list_of(expression, dimension)),
        spring=_spring(table.table("spring"), dimension),
        temperature=table.optional("temperature", expression),
        heat_flux=table.optional("heat_flux", expression),
        convection=_convection(table.table("convection")),
        contact=_contact(table.table("contact"), dimension, files),
    )
    table.close()
    contact = boundary.contact
    held_or_pulled = boundary.displacement or boundary.traction or boundary.spring
    mechanical = held_or_pulled or (contact and contact.compliance)
    rubs_warm = contact and contact.friction and contact.friction.heat_share > 0.0
    conducts = contact and contact.conductance
    thermal = boundary.temperature or boundary.heat_flux or boundary.convection or conducts or rubs_warm
    if (mechanical and material is None) or (thermal and heat is None):
        raise SceneError(f"boundary.{name} has a condition on a field that the scene does not model")
    if boundary.temperature and (boundary.heat_flux or boundary.convection or conducts):
        raise SceneError(f"boundary.{name}: temperature excludes heat_flux, convection and conductance")
    return boundary


def _finite(value: float | None) -> float | None:
    """An infinite limit is no limit: the law stays linear."""
    return None if value is None or np.isinf(value) else value


def _compliance(table: Table, files: OwnLaws) -> Compliance:
    if own := own_law(table, "compliance", files):
        return Compliance(np.nan, np.nan, own)
    return Compliance(table.take("stiffness", positive), table.take("exponent", positive, 1.0), None)


def _convection(table: Table | None) -> Convection | None:
    if table is None:
        return None
    convection = Convection(
        table.take("coefficient", not_negative), table.take("ambient_temperature", expression)
    )
    table.close()
    return convection


def _spring(table: Table | None, dimension: int) -> Spring | None:
    if table is None:
        return None
    spring = Spring(
        table.take("stiffness", conductor(dimension)),
        table.optional("anchor", list_of(expression, dimension)),
    )
    table.close()
    return spring


def _friction(table: Table, files: OwnLaws) -> Friction:
    own = own_law(table, "friction", files)
    coefficient = np.nan if own else table.take("coefficient", number)
    return Friction(
        coefficient,
        table.take("regularisation", not_negative),
        own,
        table.take("heat_share", not_negative) if "heat_share" in table else 0.0,
    )


def _conductance(table: Table, files: OwnLaws) -> Conductance:
    own = own_law(table, "conductance", files)
    foundation = table.take("foundation_temperature", expression)
    if own:
        return Conductance(np.nan, np.nan, foundation, None, own)
    return Conductance(
        coefficient=table.take("coefficient", number),
        onset=table.take("onset", positive),
        foundation_temperature=foundation,
        limit=_finite(table.optional("limit", positive)),
        own=None,
    )


def _contact(table: Table | None, dimension: int, files: OwnLaws) -> Contact | None:
    if table is None:
        return None
    compliance, friction = table.table("compliance"), table.table("friction")
    conductance = table.table("conductance")
    if friction and compliance is None:
        raise SceneError(f"{table.path}.friction needs compliance")
    contact = Contact(
        gap=table.take("gap", expression, 0.0),
        foundation_velocity=table.optional("foundation_velocity", list_of(expression, dimension)),
        quadrature=table.take("quadrature", lambda raw: raw if raw == "vertex" else count(raw), 4),
        compliance=_compliance(compliance, files) if compliance else None,
        friction=_friction(friction, files) if friction else None,
        conductance=_conductance(conductance, files) if conductance else None,
    )
    for part in (table, compliance, friction, conductance):
        if part:
            part.close()
    return contact
