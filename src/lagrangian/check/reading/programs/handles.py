"""Reads functions of MATLAB that have no body of their own: f = @(t, z) [z(2); (F - k*z(1))/m].

f = @(t, z) [z(2); …];        function dz = f(t, z)⏎ dz = [z(2); …];        the rates of a state
A = @(z) [a, b; c, d];        A = [a, b; c, d];                             what depends on the state
… A(z)\\h(z)                   … A\\h
"""

from __future__ import annotations

import re
from itertools import islice

from lagrangian.check.reading.traced_text import Edit, TracedText, apart

_NAME = r"[^\W\d]\w{0,23}+"
_HANDLE = re.compile(
    rf"^(?P<indent>[ \t]*+)(?P<name>{_NAME})[ \t]*+=[ \t]*+@\((?P<of>[\w ,~]{{1,60}}+)\)[ \t]*+(?P<list>\[)?",
    re.MULTILINE,
)
_CALL = re.compile(rf"(?<![\w.@])(?P<name>{_NAME})\((?P<of>[\w ,]{{1,60}}+)\)")
_TIMES = frozenset(["t", "~", "tt", "time", "T", "tau"])
MOST = 60
"""The most functions, and the most calls of these, that are looked at."""


def without_handles(written: TracedText) -> TracedText:
    """Return an answer in which such functions are what they return; that of the rates of a state has a first line."""
    text, edits = written.text, list[Edit]()
    given: dict[str, list[str]] = {}
    rates = False
    for match in islice(_HANDLE.finditer(text), MOST):
        of, end = _names(match["of"]), match.end() - len(match["list"] or "")
        if match["list"] and len(of) > 1 and of[0] in _TIMES and not rates:
            rates = True
            head = f"function d{of[1]} = {match['name']}({', '.join(of)})\n{match['indent']}d{of[1]} = "
            edits.append((match.start("name"), end, head))
        elif match["name"] not in given:
            given[match["name"]] = of
            edits.append((match.start("name"), end, f"{match['name']} = "))
    calls = (m for m in islice(_CALL.finditer(text), 10 * MOST) if given.get(m["name"]) == _names(m["of"]))
    edits += [(m.end("name"), m.end(), "") for m in calls]
    return written.edited(apart(sorted(edits)))


def _names(listed: str) -> list[str]:
    return [x.strip() for x in listed.split(",")]
