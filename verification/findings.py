"""What comparing two result directories finds."""

from dataclasses import dataclass


class Unusable(Exception):
    """The two directories cannot be compared."""


@dataclass
class Worst:
    """The largest relative difference of one field, where and when."""

    name: str
    relative: float = 0.0
    time: float | None = None
    place: str = ""
