"""Reads functions of MATLAB that have no body of their own: f = @(t, z) [z(2); (F - k*z(1))/m].

f = @(t, z) [z(2); …];        function dz = f(t, z)⏎ dz = [z(2); …];        the rates of a state
ode45(@(t, z) [z(2); …], …)   the same, as for f = lambda t, z: […] and solve_ivp(lambda t, z: […], …)
A = @(z) [a, b; c, d];        A = [a, b; c, d];                             what depends on the state
… A(z)\\h(z)                   … A\\h
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import islice

from lagrangian.check.reading.programs.sessions import closes
from lagrangian.check.reading.traced_text import Edit, TracedText, apart

_NAME = r"[^\W\d]\w{0,23}+"
_HANDLE = re.compile(
    rf"^(?P<indent>[ \t]*+)(?P<name>{_NAME})[ \t]*+=[ \t]*+@\((?P<of>[\w ,~]{{1,60}}+)\)[ \t]*+(?P<list>\[)?",
    re.MULTILINE,
)
_UNNAMED = re.compile(
    rf"^(?P<indent>[ \t]*+)(?:(?P<name>{_NAME})[ \t]*+=[ \t]*+(?=lambda)|[^\n=]{{0,60}}=[ \t]*+(?:\w{{1,12}}\.){{0,2}}"
    r"(?P<solver>ode\w{1,6}|solve_ivp)\([ \t]*+)"
    r"(?:@\((?P<of>[\w ,~]{1,60}+)\)|lambda[ \t]++(?P<to>[\w ,]{1,60}+):)"
    r"[ \t]*+(?P<array>(?:\w{1,8}\.)?array\()?(?=\[)",
    re.MULTILINE,
)
"""A function of Python in one line, or one that a solver is given."""
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
        times = len(of) > 1 and re.match(rf"\w{{1,24}}+[ ]?\*[ ]?{re.escape(of[1])}(?!\w)", text[match.end() :][:60])
        if (match["list"] or times) and len(of) > 1 and of[0] in _TIMES and not rates:
            rates = True
            head = f"function d{of[1]} = {match['name']}({', '.join(of)})\n{match['indent']}d{of[1]} = "
            edits.append((match.start("name"), end, head))
        elif match["name"] not in given:
            given[match["name"]] = of
            edits.append((match.start("name"), end, f"{match['name']} = "))
    calls = (m for m in islice(_CALL.finditer(text), 10 * MOST) if given.get(m["name"]) == _names(m["of"]))
    edits += [(m.end("name"), m.end(), "") for m in calls]
    if not edits and (unnamed := _UNNAMED.search(text)) is not None:
        edits += _named(text, unnamed)
    return written.edited(apart(sorted(edits)))


def _named(text: str, match: re.Match[str]) -> Iterator[Edit]:
    """The edits that give a function of time and a state a first line; what else a solver is given is left out."""
    of = _names(match["of"] or match["to"])
    close = closes(text, match.end() - 1 if match["array"] else match.end())
    if len(of) < 2 or of[0] not in _TIMES or close < 0:
        return
    name, indent = match["name"] or "rates", match["indent"]
    matlab = f"{indent}function d{of[1]} = {name}({', '.join(of)})\n{indent}d{of[1]} = "
    head = matlab if match["of"] else f"{indent}def {name}({', '.join(of)}):\n{indent}    return "
    yield *match.span(), f"{head}{match['array'] or ''}"
    line = text.find("\n", close)
    if match["solver"]:
        yield close + 1, len(text) if line < 0 else line, ""


def _names(listed: str) -> list[str]:
    return [x.strip() for x in listed.split(",")]
