"""Equations of motion by the Lagrangian approach: every step shown, every result checked."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from lagrangian.analyze.compare import Comparison, compare
    from lagrangian.derivation import Derivation
    from lagrangian.errors import Error, MissingExtra, ModelError, Notice, ParseError, Place, RunError
    from lagrangian.running.ensemble import Ensemble
    from lagrangian.running.events import Event, event
    from lagrangian.running.trajectory import Trajectory
    from lagrangian.system import System, load, loads
else:
    from lagrangian.lazily import lazily

    __getattr__ = lazily(
        __name__,
        {
            "analyze.compare": "Comparison compare",
            "derivation": "Derivation",
            "errors": "Error MissingExtra ModelError Notice ParseError Place RunError",
            "running.ensemble": "Ensemble",
            "running.events": "Event event",
            "running.trajectory": "Trajectory",
            "system": "System load loads",
        },
    )

__all__ = [
    "Comparison",
    "Derivation",
    "Ensemble",
    "Error",
    "Event",
    "MissingExtra",
    "ModelError",
    "Notice",
    "ParseError",
    "Place",
    "RunError",
    "System",
    "Trajectory",
    "compare",
    "event",
    "load",
    "loads",
]
__version__ = "0.1.0"


def __dir__() -> list[str]:
    return sorted([*__all__, *(name for name in globals() if name.startswith("__"))])
