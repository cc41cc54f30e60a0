"""Results of the oracle, kept from run to run where THERMOCONTACT_ORACLE_RESULTS names a folder.

mutate.py runs the same tests again and again with a changed driver, while the oracle's answers stay the same. Results
are found by what they follow from: the scene with its mesh file and settings, the adaptive steps that it followed, the
number of processes, and the oracle's own sources. Without the variable nothing is kept and nothing found.
"""

import hashlib
import os
import shutil
import tomllib
from collections.abc import Sequence
from pathlib import Path

VARIABLE = "THERMOCONTACT_ORACLE_RESULTS"
HERE = Path(__file__).resolve().parent


def fetch(
    scene: Path, directory: Path, settings: Sequence[str] = (), ranks: int = 1, followed: Path | None = None
) -> bool:
    """Make `directory` a link to the kept results; False where there are none."""
    place = _place(scene, settings, ranks, followed)
    if place is None or not place.exists():
        return False
    directory.symlink_to(place, target_is_directory=True)
    return True


def keep(
    scene: Path, directory: Path, settings: Sequence[str] = (), ranks: int = 1, followed: Path | None = None
) -> None:
    """Keep the results of a run that succeeded."""
    place = _place(scene, settings, ranks, followed)
    if place is not None:
        beside = place.with_name(f"{place.name}-{os.getpid()}")
        shutil.copytree(directory, beside)
        shutil.rmtree(beside) if place.exists() else beside.rename(place)


def _place(scene: Path, settings: Sequence[str], ranks: int, followed: Path | None) -> Path | None:
    folder = os.environ.get(VARIABLE)
    if not folder or any(setting.startswith("mesh.file") for setting in settings):
        return None
    digest = hashlib.sha256(repr((list(settings), ranks)).encode())
    for file in (HERE / "oracle.py", *sorted((HERE / "oracle_parts").glob("*.py")), scene, *_mesh(scene)):
        digest.update(file.read_bytes())
    if followed is not None and (followed / "steps.csv").exists():
        digest.update((followed / "steps.csv").read_bytes())
    if followed is not None and "refinement" in scene.read_text(encoding="utf-8") + " ".join(settings):
        for file in sorted((followed / "fields").glob("body_*")):
            digest.update(file.read_bytes())
    Path(folder).mkdir(parents=True, exist_ok=True)
    return Path(folder).resolve() / digest.hexdigest()[:32]


def _mesh(scene: Path) -> list[Path]:
    name = tomllib.loads(scene.read_text(encoding="utf-8")).get("mesh", {}).get("file")
    return [scene.parent / name] if name else []
