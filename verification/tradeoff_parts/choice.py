"""What the study turns: a choice for every source of error, and the settings of the scene that make it."""

from dataclasses import dataclass, fields
from typing import Any

from tradeoff_parts.facts import Facts

Settings = dict[str, Any]


@dataclass(frozen=True)
class Space:
    """`cells` None: as in the mesh's file. `grading`: the ratio at each side, 1 where the mesh is not finer there; None: as
    in the scene."""

    cells: tuple[int, ...] | None
    degree: int
    grading: tuple[float, ...] | None = None

    def settings(self, facts: Facts) -> Settings:
        chosen: Settings = {"space.degree": self.degree}
        if self.cells:
            chosen["mesh.cells"] = list(self.cells)
        if self.grading is not None and facts.gradable:
            chosen |= {f"mesh.grading.{side}": ratio for side, ratio in zip(facts.sides, self.grading)}
        return chosen


@dataclass(frozen=True)
class Time:
    """With a tolerance, `steps` are those that are adapted."""

    scheme: str
    steps: int
    tolerance: float | None = None

    def settings(self, facts: Facts) -> Settings:
        length: Settings = {"time.steps": self.steps}
        if facts.states_step:
            length = {"time.step": facts.end / self.steps}
        adapted = {} if self.tolerance is None else {"time.tolerance": self.tolerance}
        return {"time.scheme": self.scheme, **length, **adapted}


@dataclass(frozen=True)
class Regularisation:
    """The scene's own, on every side, times a factor."""

    factor: float

    def settings(self, facts: Facts) -> Settings:
        law = "boundary.{}.contact.friction.regularisation"
        return {law.format(side): self.factor * own for side, own in facts.regularisation.items()}


@dataclass(frozen=True)
class Quadrature:
    """Of the contact integrals; None: as in the scene."""

    rule: int | str | None

    def settings(self, facts: Facts) -> Settings:
        if self.rule is None:
            return {}
        return {f"boundary.{side}.contact.quadrature": self.rule for side in facts.contacts}


@dataclass(frozen=True)
class Coupling:
    """Of momentum and heat: lagged, or iterated to a tolerance."""

    tolerance: float | None

    def settings(self, facts: Facts) -> Settings:
        if not facts.coupled:
            return {}
        if self.tolerance is None:
            return {"time.coupling": "lagged"}
        return {"time.coupling": "iterated", "time.coupling_tolerance": self.tolerance}


@dataclass(frozen=True)
class Solver:
    tolerance: float
    strategy: str
    factor: str = "auto"

    def settings(self, facts: Facts) -> Settings:
        return {
            "solver.tolerance": self.tolerance,
            "solver.strategy": self.strategy,
            "solver.factor": self.factor,
        }


@dataclass(frozen=True)
class Choice:
    """The fields are the sources of error, in the order in which a chain makes them the reference's."""

    solver: Solver
    coupling: Coupling
    time: Time
    regularisation: Regularisation
    quadrature: Quadrature
    space: Space

    def settings(self, facts: Facts) -> Settings:
        chosen: Settings = {}
        for source in SOURCES:
            chosen |= getattr(self, source).settings(facts)
        return chosen


SOURCES = tuple(field.name for field in fields(Choice))


def present(facts: Facts) -> list[str]:
    """The sources that the scene has."""
    has = {"coupling": facts.coupled, "regularisation": bool(facts.regularisation)}
    has["quadrature"] = bool(facts.contacts)
    return [source for source in SOURCES if has.get(source, True)]
