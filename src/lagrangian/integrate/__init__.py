"""Program → trajectories: integrators in machine code, events, ensembles. Knows no mechanics."""

from typing import TYPE_CHECKING

from lagrangian.lazily import lazily

if TYPE_CHECKING:
    from .methods import METHODS
    from .problem import Events, Signals
    from .solution import STATUS, Solution
    from .solver import Solver
else:
    __getattr__ = lazily(
        __name__,
        {"methods": "METHODS", "problem": "Events Signals", "solution": "STATUS Solution", "solver": "Solver"},
    )

__all__ = ["METHODS", "STATUS", "Events", "Signals", "Solution", "Solver"]
