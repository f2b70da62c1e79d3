"""Reads the p of a point: where an answer in plain text has thp and thpp beside th, they are th' and th''."""

from __future__ import annotations

import re
from collections.abc import Callable

from lagrangian.check.reading.traced_text import TracedText

_TWICE = re.compile(r"(?:(?<![\w.\\])|(?<=/d)|(?<=/∂))(?P<stem>[^\W\d]\w{0,15}?)pp(?!\w)")
_DEFINED = r"(?m)^[ \t]*+{0}(?:p|pp)[ \t]*:?=(?!=)|(?<!\w){0}pp?(?!\w)[^\n]{{0,60}}(?:velocit|accelerations?\b)"
"""A line that says what such a name is, xp = …, or that lists it among velocities or accelerations."""
MOST = 12
"""The most names with such ends."""


def with_p_as_points(written: TracedText, moves: Callable[[str], bool], taken: Callable[[str], bool]) -> TracedText:
    """Return an answer in which such names have primes; ``moves`` says whether a name changes with time, ``taken``
    whether it belongs to the system. Both rates must stand there, and no line says what they are."""
    stems = list(dict.fromkeys(m["stem"] for m in _TWICE.finditer(written.text)))[:MOST]
    for stem in stems:
        name = re.escape(stem)
        once = re.search(rf"(?:(?<![\w.])|(?<=/d)|(?<=/∂)){name}p(?!\w)", written.text)
        own = taken(f"{stem}p") or taken(f"{stem}pp") or re.search(_DEFINED.format(name), written.text)
        if moves(stem) and once and not own:
            form = re.compile(rf"(?:(?<![\w.\\])|(?<=/d)|(?<=/∂)){name}(?P<ends>pp?)(?!\w)")
            written = written.sub(form, lambda m, stem=stem: f"{stem}{chr(39) * len(m['ends'])}")
    return written
