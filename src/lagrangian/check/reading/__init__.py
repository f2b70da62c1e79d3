"""Reads answers in plain text or LaTeX: equations, energies, generalized forces, whole derivations by hand."""

from lagrangian.check.reading.answer import Answer, AnswerLine, Kind, Unknown
from lagrangian.check.reading.choices import reads_flipped
from lagrangian.check.reading.file_text import decode_answer, read_text
from lagrangian.check.reading.limits import MAX_ANSWER
from lagrangian.check.reading.own_slopes import OwnCoordinates, named, replaced_by
from lagrangian.check.reading.placeholders import ENERGIES, generalized_force, is_placeholder
from lagrangian.check.reading.read import parse_answer
from lagrangian.check.reading.stated import of_coordinate

__all__ = [
    "ENERGIES",
    "MAX_ANSWER",
    "Answer",
    "AnswerLine",
    "Kind",
    "OwnCoordinates",
    "Unknown",
    "decode_answer",
    "generalized_force",
    "is_placeholder",
    "named",
    "of_coordinate",
    "parse_answer",
    "read_text",
    "reads_flipped",
    "replaced_by",
]
