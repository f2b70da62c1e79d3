"""Writes out calls of functions that an answer in Mathematica defines by what they differentiate.

EL[q_] := D[D[L, q'[t]], t] - D[L, q[t]];        EL[x] == F   is   (D[D[L, x'[t]], t] - D[L, x[t]]) == F
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import islice

from lagrangian.check.reading.programs.session_lists import entries_in
from lagrangian.check.reading.programs.sessions import closes
from lagrangian.check.reading.traced_text import Edit, TracedText, apart

MOST, MOST_UNCLOSED, MOST_LETTERS = 60, 4, 10_000
"""The most calls that are looked at, and those of them that do not end, and the most characters that are added."""

_NAME = r"[A-Za-z][A-Za-z0-9]{0,23}"
_DEFINED = re.compile(
    rf"^[ \t]*+(?P<name>{_NAME})\[(?P<given>{_NAME}_(?:,[ ]?{_NAME}_){{0,3}})\][ \t]*+:?=(?!=)[ \t]*+"
    r"(?P<body>[^\n;]{3,400}?)[ \t]*+;?[ \t]*+$",
    re.MULTILINE,
)
"""A function of anything, on one line."""


def with_templates_applied(written: TracedText) -> TracedText:
    """Return an answer in which the calls of such functions are what they stand for."""
    if "_]" not in written.text and "_," not in written.text:
        return written
    return written.edited(apart(sorted(_calls(written.text))))


def _calls(text: str) -> Iterator[Edit]:
    added, left, unclosed = 0, MOST, 0
    for match in islice(_DEFINED.finditer(text), MOST):
        given = [x.strip().rstrip("_") for x in match["given"].split(",")]
        if given == ["t"] or not re.search(r"\bD\[|\bDt\[", match["body"]):
            continue
        for call in islice(re.finditer(rf"(?<!\w){match['name']}\[", text), left):
            left -= 1
            end = closes(text, call.end() - 1)
            unclosed += end < 0
            if unclosed > MOST_UNCLOSED:
                return
            listed = [text[a:b] for a, b in entries_in(text, call.end(), end)] if end > 0 else []
            if match.start() <= call.start() < match.end() or len(listed) != len(given):
                continue
            made = _put(match["body"], dict(zip(given, listed, strict=True)))
            added += len(made)
            if added > MOST_LETTERS:
                return
            yield call.start(), end + 1, made if "==" in made else f"({made})"


def _put(body: str, values: dict[str, str]) -> str:
    """A body with values for its names; a sum is put in brackets."""

    def value(match: re.Match[str]) -> str:
        found = values[match.group()]
        return found if re.fullmatch(r"[\w\[\]']+", found) else f"({found})"

    return re.sub(rf"(?<!\w)(?:{'|'.join(map(re.escape, values))})(?!\w)", value, body)
