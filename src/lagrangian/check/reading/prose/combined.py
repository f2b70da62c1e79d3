"""Takes lines off an answer that only say how equations with names are combined.

cos * (horizontal) + sin * (vertical):          m x'' cos(theta) + … = …  below it
cos(theta)·(1) - sin(theta)·(2):
(I) + (II):  m1 x1'' + m2 x2'' = F              its label is taken off, where it stands on the line
(1) - (3)  m1 x1'' = F - c x2'                  so is one of numbers that equations have
"""

from __future__ import annotations

import re

from lagrangian.check.reading.markup import blank
from lagrangian.check.reading.prose.words import Words, function_of

_LINE = re.compile(r"^[^=\n]{3,120}$", re.MULTILINE)
_LABEL = re.compile(r"^[^=:\n]{3,60}:(?=[ \t][^\n]*=)", re.MULTILINE)
_NUMBERS = re.compile(
    r"^[ \t]{0,20}\(\d{1,2}\)(?:[ \t]?[-+−–][ \t]?\(\d{1,2}\)){1,3}[ \t]+(?=[^\n=:]{2,300}=)", re.MULTILINE
)
"""Numbers of equations that are added or subtracted, in front of what this gives."""
_NUMBERED = re.compile(
    r"^[ \t]{0,20}\((?P<before>\d{1,2})\)[ \t]+(?=[^-+−– \t])|\((?P<behind>\d{1,2})\)[ \t.]{0,20}$", re.MULTILINE
)
"""The number of an equation, in front of it or behind it."""
_COUNT = re.compile(r"\d+")
_NAMED = re.compile(r"(?<![^\s*·×+−(-])\((?P<said>[^()=+*/^\n]{1,40})\)")
_NUMBER = re.compile(r"[ \t]?(?:\d{1,2}[a-z]?|[IVX]{1,4}|[A-Z]|\*{1,3})[ \t]?")
_TIMES = re.compile(r"[*·×]")
_WORD = re.compile(r"[^\W\d_]+")
_FEWEST = 2
"""The fewest equations that are combined."""
_SHORTEST = 3
"""The fewest letters of a word that names an equation."""


def without_combinations(text: str, words: Words) -> str:
    """Return an answer without such lines, as a note tells."""
    for match in list(_LINE.finditer(text)):
        line = match.group()
        if _TIMES.search(line) and _combines(line, words):
            words.names.notes.setdefault(f"'{' '.join(line.split())}' was not judged: it says what is combined.")
            text = blank(text, *match.span())
    for match in [m for m in _LABEL.finditer(text) if _combines(m.group(), words)]:
        text = blank(text, *match.span())
    combined = list(_NUMBERS.finditer(text))
    known = {m["before"] or m["behind"] for m in _NUMBERED.finditer(text)} if combined else set[str]()
    for match in combined:
        if set(_COUNT.findall(match.group())) <= known:
            text = blank(text, *match.span())
    return text


def _combines(line: str, words: Words) -> bool:
    """Whether names of equations stand in brackets, at least two, and nothing of the system outside unless a colon
    ends the line."""
    found = [m["said"] for m in _NAMED.finditer(line)]
    spoken = [all(_is_said(x, words) for x in _WORD.findall(said)) and not _NUMBER.fullmatch(said) for said in found]
    named = [a or _NUMBER.fullmatch(said) is not None for a, said in zip(spoken, found, strict=True)]
    ends = line.rstrip().endswith(":")
    if len(found) < _FEWEST or not all(named) or not (ends or all(spoken)):
        return False
    outside = _WORD.findall(_NAMED.sub(" ", line))
    return ends or not any(words.known(x) and function_of(x) is None for x in outside)


def _is_said(written: str, words: Words) -> bool:
    """Whether a word is no name and no product of names."""
    return len(written) >= _SHORTEST and not words.readable(written) and not words.is_product(written)
