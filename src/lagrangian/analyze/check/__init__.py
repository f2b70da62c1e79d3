"""Is this answer right? Right in which shape, or wrong where, and why."""

from lagrangian.analyze.check.check import check
from lagrangian.analyze.check.lines import lines_from, lines_of
from lagrangian.analyze.check.verdict import Difference, Finding, Line, Mistake, Origin, Status, Verdict
from lagrangian.analyze.check.words import report

__all__ = [
    "Difference",
    "Finding",
    "Line",
    "Mistake",
    "Origin",
    "Status",
    "Verdict",
    "check",
    "lines_from",
    "lines_of",
    "report",
]
