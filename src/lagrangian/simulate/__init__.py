"""Program → trajectories: integrators in machine code, events, ensembles. Knows no mechanics."""

from .integrators import METHODS
from .problem import Events, Signals
from .solution import STATUS, Solution
from .solver import Solver

__all__ = ["METHODS", "STATUS", "Events", "Signals", "Solution", "Solver"]
