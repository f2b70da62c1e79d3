"""Answers that people typed or wrote in LaTeX: equations, energies, generalized forces, whole hand derivations."""

from lagrangian.read.answers.answer import Answer, AnswerLine, Kind, Unknown
from lagrangian.read.answers.placeholders import ENERGIES, generalized_force
from lagrangian.read.answers.read import MAX_ANSWER, parse_answer

__all__ = ["ENERGIES", "MAX_ANSWER", "Answer", "AnswerLine", "Kind", "Unknown", "generalized_force", "parse_answer"]
