"""Equations of motion by the Lagrangian approach: every step shown, every result checked."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from lagrangian.comparison import Comparison, compare
    from lagrangian.derivation import Derivation
    from lagrangian.errors import Error, MissingExtra, ModelError, ParseError, Place, RunError
    from lagrangian.running.ensemble import Ensemble
    from lagrangian.running.events import Event, event
    from lagrangian.running.trajectory import Trajectory
    from lagrangian.system import System, load, loads
else:  # imported where first used: whoever asks for the version, or for one name, does not wait for all of them
    _ROOMS = {
        "comparison": ("Comparison", "compare"),
        "derivation": ("Derivation",),
        "errors": ("Error", "MissingExtra", "ModelError", "ParseError", "Place", "RunError"),
        "running.ensemble": ("Ensemble",),
        "running.events": ("Event", "event"),
        "running.trajectory": ("Trajectory",),
        "system": ("System", "load", "loads"),
    }
    _WHERE = {name: room for room, names in _ROOMS.items() for name in names}

    def __getattr__(name: str) -> object:
        if name not in _WHERE:
            raise AttributeError(f"module 'lagrangian' has no attribute '{name}'")
        from importlib import import_module

        globals()[name] = found = getattr(import_module(f"lagrangian.{_WHERE[name]}"), name)
        return found


__all__ = [
    "Comparison",
    "Derivation",
    "Ensemble",
    "Error",
    "Event",
    "MissingExtra",
    "ModelError",
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
