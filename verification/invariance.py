"""The same scene said otherwise must have the same answer: other units, mirrored, turned, shifted, in a frame that moves,
listed in another order.

    invariance.py [--driver PROGRAM] [--list] [NAME...]

Units: length, time, mass and temperature each by 1e-9 ... 1e9, from the units that `schema` states for the keys, so that
every tolerance inside the program is seen to be relative. Every field at the last step may differ by TOLERANCE of its
largest value: numbers are rounded otherwise in other units, and the scenes' systems have condition numbers below 1e5
(small cells, stiff contact), which carries 1e-16 to 1e-11.

Exit codes: 0 all agree, 1 one does not, or a run fails.
"""

import argparse
import sys
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from invariance_parts import mesh_file
from invariance_parts.compared import Carry, difference
from invariance_parts.motions import BOOSTS, PLANE, SPACE, Motion, orders, turned
from invariance_parts.units import FIELDS, Keys, systems
from matrix_parts.runs import Driver
from matrix_parts.scenes import BASES, Flat, without, write

TOLERANCE = 1e-10


@dataclass(frozen=True)
class Saying:
    """Another way to say a base scene; a mesh file is rewritten by `mesh`."""

    name: str
    base: str
    scene: Flat
    carry: Carry
    mesh: Callable[[Path], None] | None = None


def _bases() -> dict[str, Flat]:
    plane = {f"contact {side}": BASES[f"contact {side}"] for side in ("bottom", "left")}
    box = {
        **BASES["contact bottom"],
        "mesh.shape": "box",
        "mesh.cell": "tensor",
        "mesh.upper": [1.0, 0.8, 0.9],
        "mesh.cells": [3, 2, 2],
        "load.body_force": [0.3, -1.0, 0.2],
        "initial.displacement": ["0.004*x*y", -0.005, "0.003*z"],
        "initial.velocity": ["0.1*x - 0.05*y", -0.05, "0.05*z"],
        "boundary.top.displacement": ["0.02*t", "-(0.01 + 0.05*t)", 0.0],
        "boundary.left.traction": [0.8, 0.2, 0.1],
        "boundary.bottom.contact.gap": "0.004*cos(5*x + 3*z) - 0.004",
        "heat.conductivity": [[0.7, 0.1, 0.0], [0.1, 0.8, 0.2], [0.0, 0.2, 0.9]],
    }
    krylov = {**plane["contact bottom"], "solver.strategy": "newton-krylov"}
    contact = "boundary.bottom.contact"
    belt: Flat = {
        **plane["contact bottom"],
        "heat.strain_rate_heating": [[-0.4, 0.1], [0.1, 0.3]],
        f"{contact}.foundation_velocity": ["0.5 - x + 2*t", "0.2*y"],
        f"{contact}.friction.heat_share": 0.7,
        "boundary.right.convection.coefficient": 1.5,
        "boundary.right.convection.ambient_temperature": "2 + y - 3*t",
        "boundary.right.spring.stiffness": [[4.0, 1.0], [1.0, 2.0]],
        "boundary.right.spring.anchor": ["0.1*t", "0.02*y - 0.05*t*t"],
    }
    exact: Flat = {**belt, f"{contact}.friction.regularisation": 0.0}
    belts = {"belt": belt, "belt, exact friction": exact}
    # bisected twice in the first step, from 24 cells to 392. In the plane only: mirrored tetrahedra of a box are other ones;
    # and not renumbered: of edges equally long the numbers of their ends decide which is cut
    refined: Flat = {
        **plane["contact bottom"],
        "mesh.refinement.tolerance": 0.15,
        "mesh.refinement.every": 1,
    }
    return {
        **plane,
        **belts,
        "newton-krylov": krylov,
        "box": box,
        "refined": refined,
        "by tensors": _by_tensors(),
        "mesh file": _ring(),
        "regions": _ring() | REGIONS,
    }


# A second material, of every quantity that a region may have
REGIONS: Flat = {
    "region.bush.material.density": 2.5,
    "region.bush.material.elasticity.young": 9.0,
    "region.bush.material.elasticity.poisson": 0.2,
    "region.bush.material.viscosity.trace": 0.3,
    "region.bush.material.viscosity.shear": 0.8,
    "region.bush.heat.capacity": 0.7,
    "region.bush.heat.conductivity": 1.9,
    "region.bush.heat.source": "1 + 20*x",
    "region.bush.heat.thermal_stress": 0.5,
    "region.bush.heat.strain_heating": 0.2,
}


def _by_tensors() -> Flat:
    """Laws with exponent and limit, stiffness that squares keep, and steps that adapt."""
    contact = "boundary.bottom.contact"
    scene = without(BASES["contact bottom"], ["material.elasticity", "material.viscosity"])
    return {
        **scene,
        "material.elasticity.tensor": [[6.0, 2.0, 0.0], [2.0, 6.0, 0.0], [0.0, 0.0, 2.5]],
        "material.viscosity.tensor": [[0.8, 0.2, 0.0], [0.2, 0.8, 0.0], [0.0, 0.0, 0.4]],
        f"{contact}.compliance.stiffness": 4000.0,
        f"{contact}.compliance.exponent": 2.0,
        f"{contact}.conductance.limit": 2.0,
        "time.scheme": "bdf2",
        "time.tolerance": 1e-2,
    }


def _ring() -> Flat:
    """The quarter ring of the press fit, all data smooth functions of the place."""
    laws = {
        key.replace("bottom", "bore"): value
        for key, value in BASES["contact bottom"].items()
        if ".contact." in key
    }
    body = without(BASES["contact bottom"], ["mesh", "boundary", "initial"])
    return {
        **body,
        **laws,
        "mesh.file": "ring.msh",
        "boundary.bore.contact.gap": "2e-4*cos(100*x) - 3e-4",
        "boundary.bore.contact.conductance.onset": 1e-4,
        "boundary.mantle.displacement": ["1e-4*t", "-2e-4*t"],
        "boundary.mantle.temperature": "0.5 + 10*x",
        "boundary.along-x.traction": [0.02, "0.1*x"],
        "boundary.along-y.heat_flux": 0.6,
    }


SCENES = _bases()
RING = Path(__file__).resolve().parents[1] / "scenes" / "meshes" / "press-fit.msh"
STILL = Motion("", ((1, 0), (0, 1)))


def sayings(keys: Keys) -> Iterator[Saying]:
    for base, scene in SCENES.items():
        for system in systems():
            factor = {name: system.factor(unit) for name, unit in FIELDS.items()}
            carry = Carry(lambda points, m=system.m: points * m, factor=factor.__getitem__)  # type: ignore[misc]
            mesh = rewriting(Motion("", ((system.m, 0), (0, system.m))), False)
            yield Saying(f"{base}: {system.name}", base, keys.in_units(scene, system), carry, mesh)
        for motion in {"box": SPACE, "mesh file": (), "regions": ()}.get(base, PLANE):
            yield Saying(f"{base}: {motion.name}", base, motion.scene(scene), motion.carry())
        for boost in (
            BOOSTS if base in ("contact bottom", "contact left", "belt", "belt, exact friction") else ()
        ):
            carry = boost.carry(scene["time.end"])
            yield Saying(f"{base}: {boost.name}", base, boost.scene(scene), carry)
        for name, ordered in orders(scene):
            yield Saying(f"{base}: {name}", base, ordered(), Carry(), rewriting(STILL, False))
    for motion, renumber in ((STILL, True), (turned(30), False), (turned(137), True)):
        name = ", ".join(word for word in (motion.name, "renumbered" if renumber else "") if word)
        scene = motion.scene(SCENES["mesh file"])
        yield Saying(f"mesh file: {name}", "mesh file", scene, motion.carry(), rewriting(motion, renumber))


def rewriting(motion: Motion, renumber: bool) -> Callable[[Path], None]:
    return lambda file: mesh_file.rewritten(RING, file, motion.embedded(), renumber)


def run(
    driver: Driver, folder: Path, name: str, scene: Flat, mesh: Callable[[Path], None] | None = None
) -> Path:
    """Raises RuntimeError where the driver fails."""
    file, directory = folder / f"{name}.toml", folder / name
    if "mesh.file" in scene and mesh is not None:
        scene = {**scene, "mesh.file": f"{name}.msh"}
        mesh(folder / f"{name}.msh")
    write(file, scene)
    if problem := driver.run(file, directory):
        raise RuntimeError(problem)
    return directory


def check(driver: Driver, folder: Path, chosen: list[Saying]) -> int:
    """Print a row for each; the number of those that differ."""
    bases: dict[str, Path] = {}
    failures = 0
    for number, saying in enumerate(chosen):
        try:
            if saying.base not in bases:
                base = SCENES[saying.base]
                bases[saying.base] = run(driver, folder, f"base-{len(bases)}", base, rewriting(STILL, False))
            result = run(driver, folder, f"said-{number}", saying.scene, saying.mesh)
            found, where = difference(bases[saying.base], result, saying.carry)
        except (RuntimeError, ValueError) as problem:
            found, where = float("inf"), str(problem)
        fails = not found <= TOLERANCE
        failures += fails
        print(f"{'FAILED ' if fails else ''}{saying.name:<44} {found:.1e} in {where}", flush=True)
    return failures


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    built = Path(__file__).resolve().parents[1] / "build" / "thermocontact"
    parser.add_argument("--driver", type=Path, default=built)
    parser.add_argument("--list", action="store_true", help="name every way of saying")
    parser.add_argument("names", nargs="*", metavar="NAME", help="those that have this in their names")
    options = parser.parse_args()
    driver = Driver(options.driver.resolve())
    chosen = [
        saying
        for saying in sayings(Keys(driver.schema()))
        if not options.names or any(name in saying.name for name in options.names)
    ]
    if options.list:
        print("\n".join(saying.name for saying in chosen))
        return 0
    with tempfile.TemporaryDirectory(prefix="invariance-") as folder:
        failures = check(driver, Path(folder), chosen)
    print(
        f"\n{failures} of {len(chosen)} differ" if failures else f"\nall {len(chosen)} agree to {TOLERANCE}"
    )
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
