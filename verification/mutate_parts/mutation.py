"""One change that makes the code wrong."""

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

KINDS = ("sign", "factor", "index", "missing", "lagged", "range", "state")


@dataclass(frozen=True)
class Mutation:
    """In `file` the one place that holds `text` gets `wrong` in its stead."""

    name: str
    file: str  # from the root of the project
    text: str
    wrong: str
    kind: str  # one of KINDS
    why: str  # what would be wrong then
    equivalent: str = ""  # why no result can change: a survivor that is explained

    @property
    def room(self) -> str:
        """forms, or the folder of src/; what lies in src/ itself belongs to the program."""
        parts = Path(self.file).parts
        return parts[0] if parts[0] != "src" else parts[1] if len(parts) > 2 else "app"

    @property
    def digest(self) -> str:
        """Of what is changed, so that a verdict is not taken for that of another change of the same name."""
        return hashlib.sha256("\0".join((self.file, self.text, self.wrong)).encode()).hexdigest()[:12]


def faults(mutations: Sequence[Mutation], root: Path) -> list[str]:
    """What keeps these mutations from being made in the project at `root`, a line each."""
    found = []
    names = [mutation.name for mutation in mutations]
    for mutation in mutations:
        path = root / mutation.file
        count = path.read_text(encoding="utf-8").count(mutation.text) if path.is_file() else 0
        if count != 1:
            found.append(f"{mutation.name}: {mutation.file} holds {count} times: {mutation.text}")
        if mutation.text == mutation.wrong:
            found.append(f"{mutation.name}: changes nothing")
        if mutation.kind not in KINDS:
            found.append(f"{mutation.name}: {mutation.kind} is no kind; expected one of {', '.join(KINDS)}")
        if names.count(mutation.name) > 1:
            found.append(f"{mutation.name}: names more than one mutation")
    return found
