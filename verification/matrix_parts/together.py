"""Scenes in which several things meet that a change of one key does not bring together."""

from typing import Any

from matrix_parts import variations_in_space as in_space
from matrix_parts.cases import Case
from matrix_parts.scenes import ABSENT, BASES, Flat, changed, contact_laws
from matrix_parts.values import CONDUCTOR, COUPLING, ELASTIC_TENSOR, VISCOUS_TENSOR

BASE, BASE_IN_SPACE = "contact bottom", "box contact bottom"
ANISOTROPIC: Flat = {
    "material.elasticity": ABSENT,
    "material.viscosity": ABSENT,
    "material.elasticity.tensor": ELASTIC_TENSOR,
    "material.viscosity.tensor": VISCOUS_TENSOR,
    "heat.conductivity": CONDUCTOR,
    "heat.thermal_stress": [[0.3, 0.1], [0.1, 0.2]],
    "heat.strain_heating": COUPLING,
}
ANISOTROPIC_IN_SPACE: Flat = {
    "material.elasticity": ABSENT,
    "material.viscosity": ABSENT,
    "material.elasticity.tensor": in_space.ELASTIC_TENSOR,
    "material.viscosity.tensor": in_space.VISCOUS_TENSOR,
    "heat.conductivity": in_space.CONDUCTOR,
    "heat.thermal_stress": [[0.3, 0.1, 0.0], [0.1, 0.2, 0.05], [0.0, 0.05, 0.25]],
    "heat.strain_heating": in_space.COUPLING,
}
SOFT_RIGHT: Flat = {
    "boundary.right.contact.gap": "0.01*y - 0.006",
    "boundary.right.contact.quadrature": "vertex",
    "boundary.right.contact.compliance.stiffness": 300.0,
    "boundary.right.contact.compliance.exponent": 2.0,
    "boundary.right.contact.conductance.coefficient": 0.7,
    "boundary.right.contact.conductance.onset": 1e-3,
    "boundary.right.contact.conductance.foundation_temperature": -1.0,
    "boundary.right.contact.conductance.limit": 0.9,
}
ONLY_HEAT_LEFT: Flat = {
    "boundary.left.contact.gap": "-0.002",
    "boundary.left.contact.conductance.coefficient": 1.5,
    "boundary.left.contact.conductance.onset": 4e-3,
    "boundary.left.contact.conductance.foundation_temperature": "2*t",
}
# Both corners of the lid and one of the foundation, at odds: the later name in the alphabet has the node
CORNERS: Flat = {
    "boundary.top.displacement": ["0.01 + 0.1*t", -0.02],
    "boundary.left.traction": ABSENT,
    "boundary.left.heat_flux": ABSENT,
    "boundary.left.displacement": [-0.01, "0.02*t"],
    "boundary.right.displacement": ["0.03*y", "free"],
    "boundary.left.temperature": "1 + t",
    "boundary.right.temperature": -1.0,
}


def _tables() -> dict[str, Flat]:
    sides: tuple[Any, ...] = ("left", "right", "top")
    return {
        "two contacts, different laws": SOFT_RIGHT,
        "three contacts, one only for heat": {**SOFT_RIGHT, **ONLY_HEAT_LEFT},
        "contact on all sides, nothing prescribed": {
            "boundary.top": ABSENT,
            **{key: value for side in sides for key, value in contact_laws(side).items()},
        },
        "corners at odds": CORNERS,
        "corners at odds, degree 2": {**CORNERS, "space.degree": 2, "mesh.diagonal": "left"},
        "anisotropic, all couplings": ANISOTROPIC,
        "anisotropic, two contacts, degree 2, crossed": {
            **ANISOTROPIC,
            **SOFT_RIGHT,
            "space.degree": 2,
            "mesh.diagonal": "crossed",
            "mesh.lower": [-0.5, 0.2],
        },
        "anisotropic, quasi-static, stationary heat": {
            **ANISOTROPIC,
            "material.density": ABSENT,
            "initial.velocity": ABSENT,
            "heat.capacity": ABSENT,
        },
        "traction and heat flux beside contact": {
            "boundary.bottom.traction": ["0.5*x", "0.2 + t"],
            "boundary.bottom.heat_flux": "1 - x*t",
        },
        "one component prescribed under contact": {"boundary.bottom.displacement": ["0.1*t", "free"]},
        "contact opens and closes": {
            "boundary.bottom.contact.gap": "0.03*sin(20*t)",
            "time.end": 0.5,
            "time.steps": 5,
        },
        "a bump travels below": {"boundary.bottom.contact.gap": "0.02 - 0.05*exp(-20*(x - 3*t)^2)"},
        "thin body, fine friction": {
            "mesh.upper": [4.0, 0.5],
            "mesh.cells": [6, 4],
            "boundary.bottom.contact.friction.regularisation": 1e-6,
        },
        "every function of expressions": {
            "heat.source": "sin(x) + cos(y) + tan(t) + asin(x/2) + acos(y/2) + atan(t) + sinh(x) + cosh(y) + tanh(t)"
            " + exp(-x) + ln(1 + y) + log10(2 + t) + sqrt(x) + abs(y - 0.4) + min(x, y, t) + max(x, y, t) + pi*e",
            "load.body_force": [
                "x <= 0.5 && y < 0.5 ? 1 : -x^2^0.5",
                "x > 0.5 || y >= 0.4 ? t : (x != y) + (x == y)",
            ],
        },
    }


def _tables_in_space() -> dict[str, Flat]:
    sides: tuple[Any, ...] = ("left", "right", "top", "front", "back")
    hexahedra = {"mesh.cell": "tensor", "space.degree": 2}
    two_sides = {
        "boundary.back.contact.gap": "0.01*y - 0.006 + 0.01*t*x",
        "boundary.back.contact.quadrature": "vertex",
        "boundary.back.contact.compliance.stiffness": 300.0,
        "boundary.back.contact.compliance.exponent": 2.0,
        "boundary.back.contact.friction.coefficient": 0.6,
        "boundary.back.contact.friction.regularisation": 2e-3,
        "boundary.back.contact.conductance.coefficient": 0.7,
        "boundary.back.contact.conductance.onset": 1e-3,
        "boundary.back.contact.conductance.foundation_temperature": -1.0,
        "boundary.back.contact.conductance.limit": 0.9,
    }
    edges = {
        "boundary.top.displacement": ["0.01 + 0.1*t", -0.02, "0.01*x"],
        "boundary.left.traction": ABSENT,
        "boundary.left.heat_flux": ABSENT,
        "boundary.left.displacement": [-0.01, "0.02*t", "free"],
        "boundary.back.displacement": ["free", "0.03*y", -0.01],
        "boundary.left.temperature": "1 + t",
        "boundary.back.temperature": -1.0,
    }
    return {
        "two contacts, different laws": two_sides,
        "two contacts, different laws, hexahedra of degree 2": {**two_sides, **hexahedra},
        "contact on all sides, nothing prescribed": {
            "boundary.top": ABSENT,
            **{key: value for side in sides for key, value in contact_laws(side, "box").items()},
        },
        "edges and corners at odds": edges,
        "edges and corners at odds, degree 2": {**edges, "space.degree": 2},
        "anisotropic, two contacts, hexahedra": {**ANISOTROPIC_IN_SPACE, **two_sides, "mesh.cell": "tensor"},
        "anisotropic, quasi-static, stationary heat": {
            **ANISOTROPIC_IN_SPACE,
            "material.density": ABSENT,
            "initial.velocity": ABSENT,
            "heat.capacity": ABSENT,
        },
        "planes of symmetry": {
            "boundary.front.displacement": ["free", "free", 0.0],
            "boundary.right.displacement": [0.0, "free", "free"],
        },
        "contact opens and closes": {
            "boundary.bottom.contact.gap": "0.03*sin(20*t) + 0.01*z",
            "time.end": 0.5,
            "time.steps": 5,
        },
    }


def together_cases() -> list[Case]:
    tables = {BASE: _tables(), BASE_IN_SPACE: _tables_in_space()}
    return [
        Case("together", label, changed(BASES[base], changes), base)
        for base, table in tables.items()
        for label, changes in table.items()
    ]
