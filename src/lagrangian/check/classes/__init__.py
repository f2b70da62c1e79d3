"""Checks the answers of a class: required parts, points, feedback for each student, statistics, tables of grades."""

from lagrangian.check.classes.checked import CheckedClass, check_feedback, feedback_files
from lagrangian.check.classes.counts import ClassCount
from lagrangian.check.classes.judge import Judging
from lagrangian.check.classes.rows import ClassRow
from lagrangian.check.classes.run import answer_files, check_class
from lagrangian.check.classes.scheme import MarkingScheme, scheme_of

__all__ = [
    "CheckedClass",
    "ClassCount",
    "ClassRow",
    "Judging",
    "MarkingScheme",
    "answer_files",
    "check_class",
    "check_feedback",
    "feedback_files",
    "scheme_of",
]
