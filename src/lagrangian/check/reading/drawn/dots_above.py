"""Dots of rates that stand on the line above the letters, as they are typed in a mail.

   ..     .2
m  x + k θ   = F         m x'' + k θ'^2 = F
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from itertools import pairwise

from lagrangian.check.reading.traced_text import Edit, TracedText

_DOTS = re.compile(r"[ ]*+(?:(?:\.{1,2}\d?|\d)(?:[ ]++|\Z)){1,60}")
"""A line of dots and powers alone."""
_MARK = re.compile(r"(?P<dots>\.{0,2})(?P<power>\d?)")
_WORD = re.compile(r"[^\W\d]\w{0,23}")
_LONGEST = 400
"""The longest line with dots above it."""


def with_dots_above(written: TracedText, moves: Callable[[str], bool]) -> TracedText:
    """Return an answer in which every dot above a coordinate, for whose name ``moves`` is true, is a prime behind it,
    and every power above the line stands in it. A line above which dots stand that are above no coordinate stays."""
    return written.edited(_edits(written.text, moves)) if ".\n" in written.text or ". " in written.text else written


def _edits(text: str, moves: Callable[[str], bool]) -> Iterator[Edit]:
    lines = text.split("\n")
    at = 0
    for above, line in pairwise(lines):
        below = at + len(above) + 1
        bare = above.rstrip()
        if "." in bare and len(line) <= _LONGEST >= len(bare) and "=" in line and _DOTS.fullmatch(bare):
            marks = [_behind(m, line, moves) for m in _MARK.finditer(bare) if m.group()]
            if all(m is not None for m in marks):
                yield at, below - 1, " " * len(above)
                for end, mark in (m for m in marks if m is not None):
                    gap = len(line) - end - len(line[end:].lstrip(" "))
                    yield below + end, below + end + gap, f"{mark} "
        at = below


def _behind(mark: re.Match[str], line: str, moves: Callable[[str], bool]) -> tuple[int, str] | None:
    """Where in a line the mark of a rate or a power belongs, and how it is written there; None if to nothing."""
    power = f"^{mark['power']}" if mark["power"] else ""
    if not mark["dots"]:
        end = mark.start()
        return (end, power) if line[:end].rstrip()[-1:].isalnum() or line[:end].rstrip().endswith(")") else None
    name = _name_at(line, range(mark.start("dots"), mark.end("dots")), moves)
    return (name, "'" * len(mark["dots"]) + power) if name is not None else None


def _name_at(line: str, columns: range, moves: Callable[[str], bool]) -> int | None:
    """The end of the longest name of a coordinate that stands at one of some columns."""
    for word in _WORD.finditer(line):
        inside = [k for k in columns if word.start() <= k < word.end()]
        pieces = (
            (end - start, end)
            for k in inside
            for start in range(word.start(), k + 1)
            for end in range(k + 1, word.end() + 1)
            if moves(line[start:end])
        )
        if (longest := max(pieces, default=None)) is not None:
            return longest[1]
    return None
