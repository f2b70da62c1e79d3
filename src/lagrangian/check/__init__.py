"""Is this answer right? Right in which shape, or wrong where, and why."""

from lagrangian.check.check import check
from lagrangian.check.lines import lines_from, lines_of
from lagrangian.check.verdict import Difference, Finding, Line, Mistake, Origin, Status, Verdict
from lagrangian.check.words import report

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
