"""Reads rates in words: theta dot, phi double dot, x zwei Punkte.

d1 = phi dot, e1 = phi double dot      d1 = phi', e1 = phi''
u = x deux points                      u = x''

A name that moves in front of the word, or one that the answer defines, has a rate; r dot r is a product of vectors.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from lagrangian.check.reading.traced_text import TracedText

_NAME = r"[^\W\d_]\w{0,15}+"
_TWICE = r"(?:(?P<twice>double|two|second|zwei|doppel|deux|dos)[ \t-]?)?"
_DOTS = re.compile(
    rf"(?<![\w\\.'’′])(?P<name>{_NAME})[ \t-]{_TWICE}(?P<d>d)?(?:dots?|punkte?)(?![\w(.:'’′]\w|\()"
    r"(?![ \t]+(?P=name)(?![\w'’′]))",
    re.IGNORECASE,
)
_POINTS = re.compile(
    rf"(?<==)(?P<gap>[ \t]*+)(?P<name>{_NAME})[ \t]{_TWICE}(?:points?|puntos?)(?=[ \t]*(?:[,;.)]|$))",
    re.IGNORECASE | re.MULTILINE,
)
"""A rate in French or Spanish, which is a whole value: these words also name points."""


def with_spoken_dots(written: TracedText, changes: Callable[[str], bool]) -> TracedText:
    """Return an answer in plain text in which such rates have primes; ``changes`` says whether a name moves."""

    def moves(name: str) -> bool:
        defined = len(name) < 3 and re.search(rf"(?<!\w){re.escape(name)}[ \t]*=(?!=)", written.text) is not None
        return defined or changes(name)

    def primed(match: re.Match[str]) -> str:
        found = match.groupdict()
        primes = "''" if found["twice"] or found.get("d") else "'"
        return f"{found.get('gap') or ''}{found['name']}{primes}" if moves(found["name"]) else match.group()

    return written.sub(_DOTS, primed).sub(_POINTS, primed)
