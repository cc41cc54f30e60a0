"""The build that the tests of documents ask, as ctest says."""

import json
import os
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("THERMOCONTACT_BUILD", ROOT / "build"))
DRIVER = Path(os.environ.get("THERMOCONTACT_DRIVER", BUILD / "thermocontact"))


def declarations() -> dict[str, Any]:
    """What the program declares of itself."""
    declared: dict[str, Any] = json.loads((BUILD / "declarations.json").read_text())
    return declared
