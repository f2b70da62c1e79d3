"""Equations of motion by the Lagrangian approach: every step shown, every result checked."""

from lagrangian.derivation import Derivation
from lagrangian.errors import Error, MissingExtra, ModelError, ParseError, Place, RunError
from lagrangian.system import System, load, loads

__all__ = [
    "Derivation",
    "Error",
    "MissingExtra",
    "ModelError",
    "ParseError",
    "Place",
    "RunError",
    "System",
    "load",
    "loads",
]
__version__ = "0.1.0"
