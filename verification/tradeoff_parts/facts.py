"""What the study must know of a scene, and what it must say of it."""

import json
import subprocess
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

OUTPUTS = 8  # times at which results are compared, at most
SIDES = {2: ("left", "right", "bottom", "top"), 3: ("left", "right", "bottom", "top", "front", "back")}
REGULARISATION = "boundary.NAME.contact.friction.regularisation"


class Unfit(Exception):
    """The scene or the driver is not one for this study."""


@dataclass(frozen=True)
class Facts:
    name: str
    dimension: int
    cells: tuple[int, ...] | None  # None: a mesh of Gmsh
    degree: int
    scheme: str
    steps: int
    end: float
    outputs: int
    states_step: bool  # time.step stands in the scene in place of time.steps
    regularisation: Mapping[str, float]  # by side with regularised friction
    exact: bool  # one of these is Coulomb's law itself, regularisation 0
    may_be_exact: bool  # the schema has it
    contacts: tuple[str, ...]
    fields: tuple[str, ...]  # that norms are taken of
    coupled: bool
    iterated: float | None  # the tolerance of the scene's coupling; None: lagged
    solver_tolerance: float
    strategy: str
    factor: str
    schemes: tuple[str, ...]
    graded: bool  # the schema has mesh.grading, and the mesh is no file

    @property
    def gradable(self) -> bool:
        return self.graded and self.cells is not None

    @property
    def sides(self) -> tuple[str, ...]:
        return SIDES[self.dimension]


def keys(driver: Path) -> dict[str, Any]:
    """The schema, by key."""
    words = [str(driver), "schema", "--format", "json"]
    try:
        answer = subprocess.run(words, capture_output=True, text=True, check=True)
    except (OSError, subprocess.CalledProcessError) as failure:
        raise Unfit(f"{driver} does not print a schema: {failure}") from failure
    return {entry["key"]: entry for entry in json.loads(answer.stdout)}


def refused(stated: Mapping[str, Any]) -> str | None:
    """Why a scene as its author wrote it is not one for this study."""
    if "tolerance" in stated.get("time", {}):
        return "time.tolerance: expected equal steps; leave the key out, the study turns it itself"
    return None


def facts_of(
    name: str, stated: Mapping[str, Any], resolved: Mapping[str, Any], schema: Mapping[str, Any]
) -> Facts:
    """Of the scene as its author wrote it and with all defaults. Raises Unfit."""
    if reason := refused(stated):
        raise Unfit(reason)
    mesh, time, solver = resolved["mesh"], resolved["time"], resolved["solver"]
    contacts = {side: of["contact"] for side, of in resolved.get("boundary", {}).items() if "contact" in of}
    frictions = {side: of["friction"]["regularisation"] for side, of in contacts.items() if "friction" in of}
    steps = int(time["steps"]) if "steps" in time else round(time["end"] / time["step"])
    cells = tuple(mesh["cells"]) if "cells" in mesh else None
    moves, warms = "material" in resolved, "heat" in resolved
    iterated = time.get("coupling_tolerance", 1e-10) if time.get("coupling") == "iterated" else None
    return Facts(
        name=name,
        dimension=len(cells) if cells else 0,
        cells=cells,
        degree=resolved["space"]["degree"],
        scheme=time["scheme"],
        steps=steps,
        end=time["end"],
        outputs=max(count for count in range(1, OUTPUTS + 1) if steps % count == 0),
        states_step="step" in stated["time"],
        regularisation={side: epsilon for side, epsilon in frictions.items() if epsilon > 0},
        exact=any(epsilon == 0 for epsilon in frictions.values()),
        may_be_exact=not schema[REGULARISATION]["range"]["low_open"],
        contacts=tuple(contacts),
        fields=("displacement", "velocity") * moves + ("temperature",) * warms,
        coupled=moves and warms,
        iterated=iterated,
        solver_tolerance=solver["tolerance"],
        strategy=solver["strategy"],
        factor=solver["factor"],
        schemes=tuple(schema["time.scheme"]["choices"]),
        graded="mesh.grading.left" in schema,
    )


def stated(scene: Path) -> dict[str, Any]:
    """Raises Unfit where it cannot be read."""
    try:
        return tomllib.loads(scene.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as failure:
        raise Unfit(str(failure)) from failure


def absent(facts: Facts) -> list[str]:
    """The knobs that the scene or this driver does not have, each with the reason."""
    lines = []
    if facts.cells is None:
        lines.append(
            "mesh: the mesh is a file, whose cells are the same in all runs; its error is not measured"
        )
    elif not facts.graded:
        lines.append("grading: this driver has no mesh.grading")
    if not facts.contacts:
        lines.append("contact quadrature: the scene has no contact")
    if not facts.regularisation:
        lines.append("epsilon: the scene has no regularised friction")
    elif not facts.may_be_exact:
        lines.append("exact Coulomb: this driver asks for a regularisation above 0")
    if not facts.coupled:
        lines.append("coupling: the scene has not both momentum and heat")
    return lines


def hindrances(resolved: Mapping[str, Any], fractions: list[float]) -> list[str]:
    """Why theory, which asks for smooth solutions, may not apply; `fractions` of contact over the steps."""
    found = []
    boundary = resolved.get("boundary", {})
    loads = [resolved.get("load", {}).get("body_force"), resolved.get("heat", {}).get("source")]
    loads += [side.get(kind) for side in boundary.values() for kind in ("traction", "heat_flux")]
    foundations = [
        side["contact"]["conductance"].get("foundation_temperature")
        for side in boundary.values()
        if "conductance" in side.get("contact", {})
    ]
    closed = bool(fractions) and fractions[0] > 0
    if any(starts(load) for load in [*loads, *(foundations if closed else [])]):
        found.append("loads that are there at once at t = 0: layers in time, lower orders in k")
    held = [side for side in boundary.values() if "displacement" in side or "temperature" in side]
    if held and len(held) < (2 * len(resolved["mesh"].get("upper", [0, 0]))):
        found.append("corners and edges where prescribed values meet others: lower orders in h")
    if any(a != b for a, b in zip(fractions, fractions[1:])):
        found.append("contact that opens or closes: kinks in space and time")
    if any("conductance" in side.get("contact", {}) for side in boundary.values()):
        found.append("conductance that rises over its onset, far less than a cell: nearly a jump")
    if "velocity" in resolved.get("initial", {}) and fractions and fractions[0] == 0 and max(fractions) > 0:
        found.append("an impact: accelerations that jump, order 1 in k at most after it")
    return found


def starts(load: Any) -> bool:
    """Whether a load given by numbers alone is not 0: such a one is there from the first step on."""
    if isinstance(load, list):
        return any(starts(part) for part in load)
    return isinstance(load, (int, float)) and load != 0
