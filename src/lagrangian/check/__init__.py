"""Checks an answer: whether it is right, in what sense, or where it is wrong and why."""

from lagrangian.check.check import check
from lagrangian.check.in_numbers import check_in_numbers
from lagrangian.check.lines import lines_from, lines_of
from lagrangian.check.verdict import AnsweredLine, Finding, Mistake, Status, TermDifference, TermOrigin, Verdict
from lagrangian.check.words import report

__all__ = [
    "AnsweredLine",
    "Finding",
    "Mistake",
    "Status",
    "TermDifference",
    "TermOrigin",
    "Verdict",
    "check",
    "check_in_numbers",
    "lines_from",
    "lines_of",
    "report",
]
