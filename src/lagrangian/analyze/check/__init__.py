"""Is this answer right? Right in which shape, or wrong where, and why."""

from lagrangian.analyze.check.check import check
from lagrangian.analyze.check.verdict import Difference, Finding, Line, Mistake, Origin, Status, Verdict

__all__ = ["Difference", "Finding", "Line", "Mistake", "Origin", "Status", "Verdict", "check"]
