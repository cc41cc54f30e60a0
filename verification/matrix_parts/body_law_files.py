"""Laws of the body from files: elasticity, viscosity, heat source and body force, of both tables of variations."""

from pathlib import Path

from matrix_parts.cases import Variation
from matrix_parts.scenes import ABSENT, Flat, base_name

LAWS = Path(__file__).resolve().parents[2] / "scenes" / "laws"

FIBRES: Flat = {
    "forms.elasticity": str(LAWS / "fibres.py"),
    "material.elasticity": ABSENT,
    "material.elasticity.young": 3.0,
    "material.elasticity.poisson": 0.2,
    "material.elasticity.fibres": 8.0,
    "material.elasticity.angle": 35.0,
    "material.elasticity.gradient": 0.7,
}
PLANE: Flat = {"material.elasticity.plane": "strain"}
ABSORBER: Flat = {
    "forms.viscosity": str(LAWS / "absorber.py"),
    "material.viscosity": ABSENT,
    "material.viscosity.shear": 0.3,
    "material.viscosity.growth": 6.0,
    "material.viscosity.start": 0.4,
}
SPOT: Flat = {
    "forms.source": str(LAWS / "laser-spot.py"),
    "heat.source": ABSENT,
    "heat.source.power": 3.0,
    "heat.source.radius": 0.2,
    "heat.source.depth": 0.3,
    "heat.source.surface": 0.8,
    "heat.source.speed": 4.0,
}
SPIN: Flat = {
    "forms.body_force": str(LAWS / "spin.py"),
    "load.body_force": ABSENT,
    "load.body_force.density": 2.0,
    "load.body_force.angular_velocity": 1.5,
    "load.body_force.spin_up": 0.1,
    "load.body_force.axis": 0.2,
}
SECOND: Flat = {"space.degree": 2}
TENSOR_CELLS: Flat = {"mesh.cell": "tensor"}


def body_law_files(shape: str = "rectangle") -> dict[str, list[Variation]]:
    base, mechanics, heat = (base_name(shape, name) for name in ("contact bottom", "mechanics", "heat"))
    fibres = {**FIBRES, **(PLANE if shape == "rectangle" else {})}
    everything = {**fibres, **ABSORBER, **SPOT, **SPIN}
    return {
        "forms.elasticity": [
            Variation(base, fibres),
            Variation(base, {**fibres, **SECOND, **TENSOR_CELLS}),
            Variation(base, {**fibres, "solver.strategy": "newton-krylov", "time.scheme": "bdf2"}),
            *(
                [
                    Variation(
                        mechanics, {**fibres, "mesh.refinement.tolerance": 0.2, "mesh.refinement.every": 1}
                    )
                ]
                if shape == "rectangle"
                else []
            ),
        ],
        "forms.viscosity": [
            Variation(base, ABSORBER),
            Variation(mechanics, {**ABSORBER, **SECOND, "time.scheme": "midpoint"}),
            Variation(base, {**ABSORBER, "material.elasticity": ABSENT}),
        ],
        "forms.source": [
            Variation(base, SPOT),
            Variation(heat, {**SPOT, **SECOND, "time.scheme": "generalized-alpha"}),
            Variation(base, {**SPOT, **TENSOR_CELLS, "time.tolerance": 0.05}),
        ],
        "forms.body_force": [
            Variation(base, SPIN),
            Variation(mechanics, {**SPIN, **SECOND, "time.scheme": "bdf2"}),
            Variation(base, {**everything, **TENSOR_CELLS, "time.coupling": "iterated"}),
            Variation(base, {**everything, **SECOND, "time.scheme": "generalized-alpha"}),
        ],
    }
