"""Compares two derivations: are they the same motion in other coordinates, or where do they differ?"""

from lagrangian.compare.compare import compare
from lagrangian.compare.comparison import Comparison, comparison_report
from lagrangian.compare.pictures import PicturePair
from lagrangian.compare.rows import ComparedSystem, Difference, EquationRow, ParameterDifference, Rewritten

__all__ = [
    "ComparedSystem",
    "Comparison",
    "Difference",
    "EquationRow",
    "ParameterDifference",
    "PicturePair",
    "Rewritten",
    "compare",
    "comparison_report",
]
