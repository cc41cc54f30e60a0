"""What law files are written with: `from law import parameter, positive_part`.

A law file (laws/, or one of the user's) holds a law alone, as a function of UFL expressions; the weak forms that it
enters are in this folder. Its constants are parameters, each of which is a key of the scene.
"""

import math

import space
import ufl
from space import positive_part

__all__ = ["parameter", "positive_part"]

_declared = {}  # what parameter() was told, by the constant's count


def parameter(
    key,
    *,
    meaning,
    unit="",
    default=None,
    example=None,
    above=None,
    at_least=None,
    below=None,
    at_most=None,
    width=False,
):
    """A constant of the law that the scene sets under `key` in the law's table, within the bounds given.

    Required unless there is a default; a default of infinity may be left out of the scene and means no limit. A `width`
    is a temperature difference over which a conductance turns round, linear where it is large: a step that Newton's
    method does not solve is solved with it widened, and then narrowed rung by rung.
    """
    for name, text in (("key", key), ("meaning", meaning), ("unit", unit)):
        if not isinstance(text, str):
            raise TypeError(f"parameter: {name} must be a string, found {text!r}")
    if not key.isidentifier():
        raise ValueError(f"parameter: a key has letters, digits and _, found {key!r}")
    numbers = {"above": above, "at_least": at_least, "below": below, "at_most": at_most}
    for name, number in {**numbers, "default": default, "example": example}.items():
        if number is not None and (isinstance(number, bool) or not isinstance(number, (int, float))):
            raise TypeError(f"parameter {key}: {name} must be a number, found {number!r}")
    if (above is not None and at_least is not None) or (below is not None and at_most is not None):
        raise ValueError(f"parameter {key}: two bounds on one side")
    low, high = (at_least if above is None else above), (at_most if below is None else below)
    if low is not None and high is not None and not low < high:
        raise ValueError(f"parameter {key}: no number lies between its bounds")
    facts = {
        "key": key,
        "meaning": meaning,
        "unit": unit,
        "low": low,
        "low_open": above is not None,
        "high": high,
        "high_open": below is not None,
        "infinite": default == math.inf,
        "required": default is None,
        "default": None if default == math.inf else default,
        "example": _example(default, example, low, high),
        "width": bool(width),
    }
    if width and (low is None or low < 0):
        raise ValueError(f"parameter {key}: a width is above 0")
    for name in ("default", "example"):
        if not _admits(facts, facts[name]):
            raise ValueError(f"parameter {key}: its {name} {facts[name]} is out of its range")
    constant = ufl.Constant(space.mesh)
    _declared[constant.count()] = facts
    return constant


def declared_as(value):
    """What parameter() was told of this constant; None of anything else."""
    return _declared.get(value.count()) if isinstance(value, ufl.Constant) else None


def _example(default, example, low, high):
    """The number to show and to try the law with."""
    if example is not None or (default is not None and math.isfinite(default)):
        return float(default if example is None else example)
    if low is not None and high is not None:
        return (low + high) / 2
    return low + 1.0 if low is not None else high - 1.0 if high is not None else 1.0


def _admits(facts, number):
    if number is None:
        return True
    low, high = facts["low"], facts["high"]
    above = low is None or (number > low if facts["low_open"] else number >= low)
    return (
        math.isfinite(number)
        and above
        and (high is None or (number < high if facts["high_open"] else number <= high))
    )
