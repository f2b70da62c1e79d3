"""Is it right, and what does it do? Verification by independent routes, dimensions, linearization."""

from lagrangian.analyze.dimensions import check_dimensions
from lagrangian.analyze.equilibria import Equilibria, Equilibrium, equilibria
from lagrangian.analyze.linearize import Linearization, linearize
from lagrangian.analyze.verify import verify

__all__ = [
    "Equilibria",
    "Equilibrium",
    "Linearization",
    "check_dimensions",
    "equilibria",
    "linearize",
    "verify",
]
