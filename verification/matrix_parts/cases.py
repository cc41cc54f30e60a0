"""A case: one scene that driver and oracle both run, and the base scene that it must, or must not, differ from."""

from dataclasses import dataclass
from typing import Any

from matrix_parts.scenes import ABSENT, BASES, Flat, changed


@dataclass(frozen=True)
class Case:
    group: str  # the key that varies, or the family of scenes
    label: str
    scene: Flat
    base: str | None = None
    same: str = ""  # why the result is that of the base; empty: it must differ


@dataclass(frozen=True)
class Variation:
    """A base scene with changes, declared for one key."""

    base: str
    changes: Flat
    same: str = ""

    def case(self, key: str) -> Case:
        return Case(
            key, describe(self.changes, key), changed(BASES[self.base], self.changes), self.base, self.same
        )


def vary(base: str, key: str, *values: Any, same: str = "", beside: Flat | None = None) -> list[Variation]:
    """One variation for each value; `beside` are further changes that it needs."""
    return [Variation(base, {**(beside or {}), key: value}, same) for value in values]


def describe(changes: Flat, key: str) -> str:
    """The key's own change first, by the last part of its name."""
    own = [name for name in changes if generic(name) == key or name == key]
    rest = [name for name in changes if name not in own]
    return ", ".join(f"{_short(name)} {_text(changes[name])}" for name in own + rest)


def generic(key: str) -> str:
    """The key as the schema writes it."""
    parts = key.split(".")
    return ".".join(["boundary", "NAME", *parts[2:]]) if parts[0] == "boundary" else key


def _short(key: str) -> str:
    parts = key.split(".")
    return f"{parts[1]}.{parts[-1]}" if parts[0] == "boundary" and len(parts) > 2 else parts[-1]


def _text(value: Any) -> str:
    return "absent" if value is ABSENT else str(value).replace("'", "")


def base_cases() -> list[Case]:
    return [Case("base", name, scene) for name, scene in BASES.items()]
