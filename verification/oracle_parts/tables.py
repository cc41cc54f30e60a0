"""TOML tables read key by key: what is missing takes its default, what is left over is an error."""

import tomllib
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, TypeVar

from oracle_parts.errors import SceneError
from oracle_parts.expressions import Expression

T = TypeVar("T")
REQUIRED: Any = object()


class Table:
    """One table of the scene. `resolved` collects what was read, defaults included, for the summary."""

    def __init__(self, data: dict[str, Any], path: str = "") -> None:
        self.path = path
        self.left = dict(data)
        self.resolved: dict[str, Any] = {}

    def key(self, name: str) -> str:
        return f"{self.path}.{name}" if self.path else name

    def __contains__(self, name: str) -> bool:
        return name in self.left

    def take(self, name: str, convert: Callable[[Any], T], default: Any = REQUIRED) -> T:
        raw = self.left.pop(name, default)
        if raw is REQUIRED:
            raise SceneError(f"{self.key(name)} is required")
        try:
            value = convert(raw)
        except (TypeError, ValueError, SceneError) as problem:
            raise SceneError(f"{self.key(name)} = {raw!r}: {problem}") from problem
        self.resolved[name] = raw
        return value

    def optional(self, name: str, convert: Callable[[Any], T]) -> T | None:
        return self.take(name, convert) if name in self.left else None

    def table(self, name: str) -> "Table | None":
        """The sub-table of that name, or None where the scene has none."""
        if name not in self.left:
            return None
        data = self.left.pop(name)
        if not isinstance(data, dict):
            raise SceneError(f"{self.key(name)} must be a table")
        child = Table(data, self.key(name))
        self.resolved[name] = child.resolved
        return child

    def defaulted(self, name: str) -> "Table":
        """The sub-table of that name; an empty one, which has the defaults, where the scene has none."""
        self.left.setdefault(name, {})
        child = self.table(name)
        assert child is not None
        return child

    def close(self) -> None:
        for name in self.left:
            raise SceneError(f"{self.key(name)} is not a key that the oracle knows")


def load_toml(path: Path, settings: Sequence[str]) -> dict[str, Any]:
    """The scene file with each `--set KEY=VALUE` on top."""
    try:
        data = tomllib.loads(path.read_text(encoding="utf-8"))
        for setting in settings:
            key, found, value = setting.partition("=")
            if not found:
                raise SceneError(f"--set {setting}: expected KEY=VALUE")
            _assign(data, key.strip().split("."), tomllib.loads(f"value = {value}")["value"])
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as problem:
        raise SceneError(f"{path}: {problem}") from problem
    return data


def _assign(data: dict[str, Any], keys: Sequence[str], value: Any) -> None:
    for key in keys[:-1]:
        data = data.setdefault(key, {})
        if not isinstance(data, dict):
            raise SceneError(f"--set {'.'.join(keys)}: {key} is not a table")
    data[keys[-1]] = value


def number(raw: Any) -> float:
    if isinstance(raw, bool) or not isinstance(raw, (int, float)):
        raise ValueError("expected a number")
    return float(raw)


def positive(raw: Any) -> float:
    if not number(raw) > 0.0:
        raise ValueError("expected a positive number")
    return float(raw)


def ratio(raw: Any) -> float:
    if not 1.0 <= number(raw) < float("inf"):
        raise ValueError("expected a number, at least 1")
    return float(raw)


def not_negative(raw: Any) -> float:
    if not number(raw) >= 0.0:
        raise ValueError("expected a number that is not negative")
    return float(raw)


def count(raw: Any) -> int:
    if isinstance(raw, bool) or not isinstance(raw, int) or raw < 1:
        raise ValueError("expected a whole number, at least 1")
    return raw


def one_of(*choices: Any) -> Callable[[Any], Any]:
    def convert(raw: Any) -> Any:
        if raw not in choices or isinstance(raw, bool):
            raise ValueError(f"expected one of {', '.join(map(repr, choices))}")
        return raw

    return convert


def list_of(convert: Callable[[Any], T], length: int | None = None) -> Callable[[Any], list[T]]:
    def convert_list(raw: Any) -> list[T]:
        if not isinstance(raw, list) or length not in (None, len(raw)):
            raise ValueError(f"expected a list of {'' if length is None else f'{length} '}values")
        return [convert(entry) for entry in raw]

    return convert_list


def expression(raw: Any) -> Expression:
    return Expression(raw if isinstance(raw, str) else number(raw))
