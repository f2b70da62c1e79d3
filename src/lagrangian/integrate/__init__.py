"""Integrates Programs: integrators in machine code, events, ensembles; without any mechanics."""

from typing import TYPE_CHECKING

from lagrangian.lazily import lazily

if TYPE_CHECKING:
    from .methods import METHODS
    from .problem import Events, Signals
    from .projection import Drift, Projection
    from .solution import Solution
    from .solver import Solver
    from .status import RunStatus
else:
    __getattr__ = lazily(
        __name__,
        {
            "methods": "METHODS",
            "problem": "Events Signals",
            "projection": "Drift Projection",
            "solution": "Solution",
            "solver": "Solver",
            "status": "RunStatus",
        },
    )

__all__ = ["METHODS", "Drift", "Events", "Projection", "RunStatus", "Signals", "Solution", "Solver"]
