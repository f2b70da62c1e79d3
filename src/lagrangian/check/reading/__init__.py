"""Reads answers in plain text or LaTeX: equations, energies, generalized forces, whole derivations by hand."""

from lagrangian.check.reading.answer import Answer, AnswerLine, Kind, Unknown
from lagrangian.check.reading.file_text import decode_answer
from lagrangian.check.reading.placeholders import ENERGIES, generalized_force
from lagrangian.check.reading.read import MAX_ANSWER, parse_answer

__all__ = [
    "ENERGIES",
    "MAX_ANSWER",
    "Answer",
    "AnswerLine",
    "Kind",
    "Unknown",
    "decode_answer",
    "generalized_force",
    "parse_answer",
]
