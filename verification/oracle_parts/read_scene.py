"""The scene file, read table by table."""

from collections.abc import Sequence
from pathlib import Path

from oracle_parts.errors import SceneError
from oracle_parts.read_body import read_body_force, read_heat, read_material, read_regions
from oracle_parts.read_boundary import read_boundary
from oracle_parts.read_mesh import adapts_mesh, read_mesh
from oracle_parts.read_own_law import law_files
from oracle_parts.scene import Scene
from oracle_parts.tables import Table, count, expression, list_of, load_toml, number, one_of, positive
from oracle_parts.time_steps import RADII

FIELDS = ("displacement", "velocity", "temperature", "stress", "von_mises", "contact")


def read_scene(path: Path, settings: Sequence[str]) -> Scene:
    root = Table(load_toml(path, settings))
    root.take("title", str, "")
    mesh, time, initial = root.defaulted("mesh"), root.defaulted("time"), root.defaulted("initial")
    space, solver, output = root.defaulted("space"), root.defaulted("solver"), root.defaulted("output")
    load = root.table("load")
    dimension, shape, file = read_mesh(mesh, path)
    files = law_files(root.table("forms"), path)
    material = read_material(root.table("material"), dimension, files)
    heat = read_heat(root.table("heat"), material, dimension, files)
    regions = read_regions(root.defaulted("region"), material, heat, dimension, files)
    if material is None and heat is None:
        raise SceneError("a scene needs [material], [heat] or both")
    radius, coupling_tolerance = _scheme(time), _coupling(time)
    solver.take("strategy", one_of("auto", "condensed", "newton-krylov"), "auto")
    solver.take("factor", one_of("auto", "double", "single"), "auto")
    if "velocity" in initial and (material is None or material.density is None):
        raise SceneError("initial.velocity needs material.density: a quasi-static scene has no inertia")
    sides = root.defaulted("boundary")
    end = time.take("end", positive)
    scene = Scene(
        dimension=dimension,
        shape=shape,
        file=file,
        degree=space.take("degree", one_of(1, 2), 1),
        end=end,
        steps=_steps(time, end),
        radius=radius,
        coupling_tolerance=coupling_tolerance,
        adapts=time.optional("tolerance", positive) is not None,
        adapts_mesh=adapts_mesh(mesh),
        material=material,
        heat=heat,
        regions=regions,
        body_force=read_body_force(load, dimension, files) if load else None,
        initial_displacement=initial.take("displacement", list_of(expression, dimension), dimension * [0.0]),
        initial_velocity=initial.take("velocity", list_of(expression, dimension), dimension * [0.0]),
        initial_temperature=initial.take("temperature", expression, 0.0),
        boundaries={
            name: read_boundary(sides, name, material, heat, dimension, files) for name in sorted(sides.left)
        },
        tolerance=solver.take("tolerance", positive, 1e-12),
        max_iterations=solver.take("max_iterations", count, 50),
        every=output.take("every", count, 1),
        fields=[],
        resolved=root.resolved,
    )
    scene.fields.extend(_fields(output, scene))
    output.optional("checkpoint_every", count)  # the oracle does not restart
    for table in (mesh, time, initial, space, solver, output, load, sides, root):
        if table:
            table.close()
    return scene


def _steps(time: Table, end: float) -> int:
    if "steps" in time:
        return time.take("steps", count)
    step = time.take("step", positive)
    steps = round(end / step)
    if steps < 1 or abs(steps * step - end) > 1e-12 * end:
        raise SceneError("time.step must divide time.end")
    return steps


def _scheme(time: Table) -> float | None:
    """The spectral radius at infinite frequency, or None for backward Euler."""
    scheme = time.take("scheme", one_of(*RADII, "generalized-alpha"), "backward-euler")
    if scheme == "generalized-alpha":
        return time.take("spectral_radius", number, 0.5)
    return RADII[scheme]


def _coupling(time: Table) -> float | None:
    if time.take("coupling", one_of("lagged", "iterated"), "lagged") == "lagged":
        return None
    return time.take("coupling_tolerance", positive, 1e-10)


def _fields(output: Table, scene: Scene) -> list[str]:
    absent = set() if scene.material else {"displacement", "velocity", "stress", "von_mises"}
    absent |= set() if scene.heat else {"temperature"}
    absent |= set() if scene.contacts else {"contact"}
    fields = [name for name in FIELDS if name not in absent]
    return output.take("fields", list_of(one_of(*fields)), fields)
