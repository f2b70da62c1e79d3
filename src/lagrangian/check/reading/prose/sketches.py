"""Sets sketches aside that are drawn with letters and signs, in which nothing is an equation.

wall |-k1-[m1]=k2,c1=[m2]-k3-| wall        o--/\\/\\/--[ m ]--->F        |~~~(M)~~~(m)
"""

from __future__ import annotations

import re

from lagrangian.check.reading.markup import blank
from lagrangian.check.reading.prose.words import Words
from lagrangian.check.reading.prose.words_or_mathematics import moves

_BOX = r"(?:\[[ \t]?\w{1,8}[ \t]?\]|\([ \t]?\w{1,8}[ \t]?\))"
_LINE = r"[-=~_–—─═]"
_DRAWN = re.compile(
    rf"{_LINE}{_BOX}{_LINE}|{_LINE}{_BOX}(?=\s|$)"
    rf"|\|{_LINE}{{2}}|{_LINE}{{2}}\||\|{_LINE}\w|\w{_LINE}\||/\\/|\\/\\|~~~|-{{2,40}}+>|<--+"
)
"""What is drawn: a box on a line, a wall, a spring, an arrow."""
_BOXED = re.compile(rf"{_LINE}{_BOX}|{_BOX}{_LINE}")

LEAST = 3
"""The fewest such pieces of a sketch; at least one is a box, a wall or a spring."""


def without_sketches(text: str, words: Words) -> str:
    """Return a plain text without the lines that are drawn, which notes tell."""
    at = 0
    for line in text.splitlines(keepends=True):
        bare = line.rstrip("\r\n")
        if _is_drawn(bare):
            told = " ".join(bare.split())
            words.names.notes.setdefault(f"'{told}' was not judged: it is a sketch.")
            text = blank(text, at, at + len(bare))
        at += len(line)
    return text


def _is_drawn(line: str) -> bool:
    found = [m.group() for m in _DRAWN.finditer(line)]
    if moves(line):
        return False
    solid = any(_BOXED.search(x) or "|" in x or "/\\" in x or "\\/" in x for x in found)
    return len(found) >= LEAST and solid
