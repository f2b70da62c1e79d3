"""Headings before statements, which are blanked: the number of an exercise, and words that an equals sign ends."""

from __future__ import annotations

import re

_ENDED = re.compile(
    r"^(?P<said>[ \t]*+[^\W\d_]{2,20}+(?:[ \t]++[^\W\d_]\w{0,20}+['’′]{0,2}){1,8}+)[ \t]*+=[ \t]*\n(?=[^\n]*=)",
    re.MULTILINE,
)
"""Words before an equals sign that ends a line, where the next line is an equation."""
_NUMBERED = re.compile(
    r"^[ \t]*+[^\W\d_]{4,20}[ \t]++\d{1,3}[a-z]?[ \t]*+\([^\W\d_]{3,30}(?:[ -][^\W\d_]{2,30}){0,5}\)[ \t]*+[-–—:]"
    r"(?=[ \t]+[^\W\d_]{3})",
    re.MULTILINE,
)
"""The number and the name of an exercise before more words: Exercise 6 (cone) – solution with c = cos γ."""


def without_headings(text: str) -> str:
    """Return an answer without words that end with an equals sign before an equation: Equation for x = ⏎ m x'' = F;
    and without the number of an exercise whose name follows in brackets."""
    for heading in (_ENDED, _NUMBERED):
        text = heading.sub(lambda m: re.sub(r"[^\n]", " ", m.group()), text)
    return text
