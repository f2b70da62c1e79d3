"""Reads braces that group a sum in plain text as round brackets: cos θ {m l (R + l sin θ) + (J - C) sin θ}; so do
square ones behind d/dt: d/dt[[J + m r²] φ'].

Braces of lists, indices and labels stay: {theta, 2}, {a == 0, b == 0}, x_{1}, {1}. Every text keeps its length.
"""

from __future__ import annotations

import re

_PAIRS = {"(": ")", "[": "]", "{": "}"}
_MARK = re.compile(r"[()\[\]{}]|\n[ \t]*\n")
_SUMMED = re.compile(r"[\w)\]'’′″}²][ \t\n]*[-+−–*·/][ \t\n]*[\w(\[{√]")
_LISTED = re.compile(r"[,;:=<>]")
_RATE = re.compile(r"d/dt ?\[")
_NEAR, MOST = 20, 200
"""How far what stands beside a brace is sought, and the most braces that are looked at."""


def with_round_brackets(text: str) -> str:
    """Return a text in which braces around sums and products are round brackets."""
    if not 0 < text.count("{") + len(_RATE.findall(text)) <= MOST:
        return text
    letters = list(text)
    opened: list[tuple[str, int]] = []
    for match in _MARK.finditer(text):
        mark, at = match.group(), match.start()
        if mark in _PAIRS:
            opened.append((mark, at))
        elif not opened or _PAIRS[opened[-1][0]] != mark:
            opened = []  # a paragraph ends, or what closes is not what was opened
        else:
            opens, start = opened.pop()
            rated = opens == "[" and text[max(0, start - 5) : start].rstrip().endswith("d/dt")
            if (opens == "{" or rated) and _groups(text, start, at):
                letters[start], letters[at] = "(", ")"
    return "".join(letters)


def _groups(text: str, start: int, end: int) -> bool:
    """Whether braces hold a sum or a product, and are neither an index nor an entry of a list."""
    before = text[max(0, start - _NEAR) : start].rstrip(" \t\n")[-1:]
    behind = text[end + 1 : end + 1 + _NEAR].lstrip(" \t\n")[:1]
    entry = before in ("{", ",") and behind in ("}", ",")
    listed = entry or before == "_" or _LISTED.search(text, start + 1, end) is not None
    return not listed and _SUMMED.search(text, start + 1, end) is not None
