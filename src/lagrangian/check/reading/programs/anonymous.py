"""Reads functions without a name of MATLAB that a program calls as it defines them: I = @(theta) J + m*cos(theta)^2.

I = @(theta) m*L^2/3;  wdot = @(theta, w) M./I(theta);      I = m*L^2/3;  wdot = M./I;

Every call has the names of the definition, so that the name alone says the same. Programs that integrate or
differentiate are carried out instead.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import islice

from lagrangian.check.reading.name_patterns import IDENT
from lagrangian.check.reading.traced_text import Edit, TracedText

MOST = 40
"""The most such functions, and calls of one."""

_FUNCTION = re.compile(
    rf"^[ \t]*+(?P<name>{IDENT})[ \t]*+=[ \t]*+"
    rf"(?P<head>@\([ \t]*+(?P<given>{IDENT}(?:[ \t]*+,[ \t]*+{IDENT}){{0,8}})[ \t]*+\))"
    r"(?P<body>[^\n@\[\]{}:=%]{2,2000}+)(?=%|$)",
    re.MULTILINE,
)
_RUNS = re.compile(
    r"\bode\d|\blsode\b|^[ \t]*+syms\b|\bdiff\(|\bjacobian\(|\bfsolve\b|^[ \t]*+function\b", re.MULTILINE
)
_CALL = r"(?<![\w.@]){}[ ]?\((?P<given>[^()\n]{{0,200}})\)"
_SPACE = re.compile(r"\s")


def without_anonymous_functions(written: TracedText, taken: Callable[[str], bool]) -> TracedText:
    """Return an answer in which such functions are values of names; ``taken`` says whether a name belongs to the
    system."""
    text = written.text
    if "@(" not in text or _RUNS.search(text) is not None:
        return written
    found = list(islice(_FUNCTION.finditer(text), MOST))
    names = [m["name"] for m in found]
    if len(set(names)) < len(names) or len(found) != text.count("@("):
        return written
    edits: list[Edit] = []
    for match in found:
        given = _SPACE.sub("", match["given"])
        if taken(match["name"]) or not any(map(taken, given.split(","))):
            return written
        edits.append((*match.span("head"), ""))
        for call in islice(re.finditer(_CALL.format(match["name"]), text), MOST):
            if _SPACE.sub("", call["given"]) != given:
                return written
            edits.append((call.start("given") - 1, call.end(), ""))
    return written.edited(edits)
