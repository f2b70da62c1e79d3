"""Equations of motion by the Lagrangian approach: every step shown, every result checked."""

from lagrangian.comparison import Comparison, compare
from lagrangian.derivation import Derivation
from lagrangian.errors import Error, MissingExtra, ModelError, ParseError, Place, RunError
from lagrangian.events import Event, event
from lagrangian.runs import Ensemble
from lagrangian.system import System, load, loads
from lagrangian.trajectory import Trajectory

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
