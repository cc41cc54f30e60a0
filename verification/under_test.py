"""The build under test, as ctest says: which program it is and how much slower than a release build."""

import os
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
DRIVER = Path(os.environ.get("THERMOCONTACT_DRIVER", ROOT / "build" / "thermocontact"))
SLOWER = float(os.environ.get("THERMOCONTACT_SLOWER", "1"))


def patience(seconds: float) -> float:
    """How long to wait for what must be done in so many seconds by a release build."""
    return seconds * SLOWER


def reserves_addresses() -> bool:
    """Whether the program is built with the address sanitizer, which reserves terabytes of addresses at its start."""
    return b"__asan_init" in DRIVER.read_bytes()
