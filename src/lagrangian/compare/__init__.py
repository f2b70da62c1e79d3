"""Two derivations side by side: the same motion in other coordinates, or where they differ."""

from lagrangian.compare.compare import compare
from lagrangian.compare.comparison import Comparison, comparison_report
from lagrangian.compare.rows import Difference, ParameterDifference, Rewritten, Row, Side

__all__ = [
    "Comparison",
    "Difference",
    "ParameterDifference",
    "Rewritten",
    "Row",
    "Side",
    "compare",
    "comparison_report",
]
