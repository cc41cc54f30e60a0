"""The ways a run of the oracle can end badly, one type for each exit code of the interface."""


class SceneError(Exception):
    """The scene or the command line is wrong (exit code 2)."""


class NumericsError(Exception):
    """No convergence, a singular system or a non-finite value (exit code 3)."""
