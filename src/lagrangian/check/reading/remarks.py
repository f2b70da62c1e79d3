"""Tells lines of words, which equations beside them do not need, from statements that must be read.

used sin(2 theta) = 2 sin cos                        an identity in short
phi'' = (tau - ...)/J, in full:                      what is written out below
(d = d/dt, dd = second derivative)                   how rates are spelled
"""

from __future__ import annotations

import re

from lagrangian.check.reading.prose import LINKING
from lagrangian.check.reading.words import Words, function_of

_COMMAND = re.compile(r"\\(?:text|mathrm|textrm|mbox|textit|textbf)\s*(?=\{)|\\([A-Za-z]+)")
_WORD = re.compile(r"[^\W\d_]+")
_DOTS = re.compile(r"\.\.\.|…|⋯|\\[lc]?dots")
_ACCELERATES = re.compile(
    r"['’′]\s?['’′]|[″\"]|\u0308|[ẍÿẅ¨]|\\ddot|ddot|(?<=\w)dd\b|\bD\(\s*\w+\s*,\s*\w+\s*,\s*\w|[∂d]\s?(?:\^\{?2|²|2)|"
    r"\b[Dd]iff\w{0,9}\([^\n]{0,60}2|\bDerivative\b"
)
_TWICE = r"(?:\^?2|²)?"
_OPERATOR = re.compile(
    r"[\s(]*+(?:dd?ot|d{1,2}|['’′]{1,2}|[\"″˙¨])\s*+:?\s?=\s*+\(?\s?"
    rf"d\s?{_TWICE}\s?/\s?\(?dt\s?{_TWICE}[\s).;,]*+"
)
"""How derivatives are spelled: dot = d/dt, '' = d²/dt²."""
_NAMED = re.compile(r"(?<![\w∂/*^+'’′-])([^\W\d]\w{0,24})\s*(?::\s?=|=)(?![=>])")
"""A name alone in front of an equals sign."""

LEAST = 2
"""Common words that make a line one of words."""


def is_remark(text: str, line: str, words: Words) -> bool:
    """Whether a part of a line that cannot be read is of words, or the line is: complete equations can do without it.

    No equation of motion is a remark, unless dots stand in it for what it leaves out, and nothing that may say what a
    name of the system means. A name of the answer's own that only a remark explains stays unknown.
    """
    bare = _COMMAND.sub(" ", text)
    dotted = _DOTS.search(text) is not None
    if _OPERATOR.fullmatch(text) is not None:
        return True
    if _ACCELERATES.search(text) is not None:
        return dotted
    if any(words.names.scope.meanings(x)[0] for x in _NAMED.findall(bare)):
        return False
    listed = _WORD.findall(_COMMAND.sub(" ", line))
    linked = sum(x.lower() in LINKING and not words.is_name(x) for x in listed)
    return dotted or linked >= LEAST or any(_is_word(x, words) for x in listed)


def _is_word(written: str, words: Words) -> bool:
    """Whether a run of letters is neither a name nor a function nor a product of names."""
    known = words.readable(written) or words.is_product(written) or function_of(written) is not None
    return len(written) > LEAST and not known
