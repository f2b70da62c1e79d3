"""Two derivations side by side: the same motion in other coordinates, or where they differ."""

from lagrangian.analyze.compare.compare import compare
from lagrangian.analyze.compare.comparison import Comparison, comparison_report
from lagrangian.analyze.compare.rows import Difference, ParameterDifference, Rewritten, Row, Side

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
