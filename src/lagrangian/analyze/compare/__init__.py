"""Two derivations side by side: the same motion in other coordinates, or where they differ."""

from lagrangian.analyze.compare.compare import compare
from lagrangian.analyze.compare.comparison import Comparison, Difference, ParameterDifference, Rewritten, Row, Side
from lagrangian.analyze.compare.report import comparison_report

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
