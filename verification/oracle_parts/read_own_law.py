"""Laws of the scene's own files, with the numbers that its tables give them."""

from pathlib import Path

import numpy as np

from oracle_parts.errors import SceneError
from oracle_parts.own_laws import FUNCTIONS, OwnLaw
from oracle_parts.tables import Table, number

OwnLaws = dict[str, OwnLaw]  # by kind
Numbers = dict[str, float]  # by key


def law_files(table: Table | None, path: Path) -> OwnLaws:
    """The law files, by the law that they take the place of."""
    if table is None:
        return {}
    names = {kind: table.optional(kind, str) for kind in FUNCTIONS}
    table.close()
    return {kind: OwnLaw(kind, path.parent / name) for kind, name in names.items() if name is not None}


def own_law(table: Table, kind: str, files: OwnLaws, before: Numbers | None = None) -> OwnLaw | None:
    """The law of a file with the numbers of this table, over those `before`; None: the built-in law."""
    law = files.get(kind)
    if law is None:
        return None
    numbers = dict(before or {})
    for declared in law.declarations():
        if declared.key in numbers and declared.key not in table:
            continue
        if declared.default is not None and declared.key not in table:
            numbers[declared.key] = float(declared.default)
            if np.isfinite(declared.default):
                table.take(declared.key, number, declared.default)
            continue
        numbers[declared.key] = table.take(declared.key, number)
        if not declared.admits(numbers[declared.key]):
            raise SceneError(f"{table.key(declared.key)} is out of its range")
    return OwnLaw(kind, law.path, numbers)


def own_law_of(
    table: Table | None, kind: str, files: OwnLaws, before: Numbers | None = None
) -> OwnLaw | None:
    if table is None:
        return None
    own = own_law(table, kind, files, before)
    table.close()
    return own
