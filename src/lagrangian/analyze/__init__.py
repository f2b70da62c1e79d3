"""Is it right? Verification by independent routes, and dimensions."""

from lagrangian.analyze.dimensions import check_dimensions
from lagrangian.analyze.verify import verify

__all__ = ["check_dimensions", "verify"]
