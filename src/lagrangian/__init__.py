"""Equations of motion by the Lagrangian approach: every step shown, every result checked."""

from lagrangian.comparison import Comparison, compare
from lagrangian.derivation import Derivation
from lagrangian.errors import Error, MissingExtra, ModelError, ParseError, Place, RunError
from lagrangian.running.ensemble import Ensemble
from lagrangian.running.events import Event, event
from lagrangian.running.trajectory import Trajectory
from lagrangian.system import System, load, loads

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
