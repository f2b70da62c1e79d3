"""Reads D and D2 as operators that differentiate by time: Maple, Simulink, and letters in which D stands for d/dt.

D(x)   D(D(x))   D2(x)   D(D(x))(t)        x'  x''  x''  x''
D(m*D(x))                                  d/dt(m*D(x))
where D(z) = dz/dt, D2 = d²/dt²            nothing: what the operators are
Dt = Differential(t)                       the same in Julia
"""

from __future__ import annotations

import re
from collections.abc import Callable

from lagrangian.check.reading.traced_text import Edit, TracedText

_NAME = r"[^\W\d]\w{0,23}+(?:\(t\))?"
MOST = 400
"""The most operators in an answer."""

_D = r"(?<![\w.\\/])"
_DERIVATIVE = r"d[ ]?(?:\^?2|²)?[ ]?\w{0,8}[ ]?/[ ]?dt[ ]?(?:\^?2|²)?|\w{1,8}['’′]{1,2}"
_LEAD = (
    r"(?:[,;(]?[ \t]*+(?:where|with|and|here|wobei|mit|und|avec|où)[ \t]++|(?<=[,;])[ \t]*+"
    r"|^[ \t]*+(?:#+|%+|//)?[ \t]*+)"
)
_CALLED = (
    r"(?:(?:the|die|la)[ ])?(?:(?:second[ ])?(?:time|total)[ ]derivative|time[ ]differentiation"
    r"|(?:zweite[ ])?(?:Zeitableitung|Ableitung[ ]nach[ ]der[ ]Zeit)|dérivée[ ]temporelle)"
)
_SAID = re.compile(
    rf"{_LEAD}D2?(?:\([ \t]*\w{{0,8}}[ \t]*\))?[ \t]*+"
    r"(?:=|:|is|denotes|means|stands[ ]for|ist|bezeichnet|est)[ \t]*+"
    rf"(?:{_DERIVATIVE}|{_CALLED})(?![\w*/^(+-])(?:[ ]of[ ]\w{{1,8}})?",
    re.MULTILINE,
)
"""A statement that says what the operators are."""
_JULIA = re.compile(
    r"^[ \t]*+(?P<name>[^\W\d]\w{0,7})[ \t]*+=[ \t]*+Differential\([ ]?t[ ]?\)[ \t;]*+(?:#[^\n]*+)?$", re.MULTILINE
)
"""The name that Julia's operator gets: Dt = Differential(t)."""
_TWICE = re.compile(
    rf"{_D}(?:D2\([ \t]*(?P<of>{_NAME})[ \t]*\)|D\([ \t]*D\([ \t]*(?P<inner>{_NAME})[ \t]*\)[ \t]*\))(?:\(t\))?"
)
_ONCE = re.compile(rf"(?:{_D}|(?<=/d)|(?<=/∂))D\([ \t]*(?P<of>{_NAME})[ \t]*\)(?:\(t\))?(?![ \t]*\()")
_BEGINS = re.compile(rf"{_D}D\(")
_OWN = re.compile(r"(?:^|[;,:])[ \t]*+D(?:\([^()\n]{0,40}['’′\u0307d][^()\n]{0,40}\))?[ \t]*+=(?!=)", re.MULTILINE)
"""The dissipation function, or a constant, which the answer calls D."""


def without_operators(written: TracedText, taken: Callable[[str], bool]) -> TracedText:
    """Return an answer in plain text with primes for these operators, unless D is a name of it or of the system.

    ``taken`` says whether a name belongs to the system.
    """
    if (named := _JULIA.search(written.text)) is not None:
        written = written.edited([(*named.span(), "")])
        written = written.sub(re.compile(rf"(?<![\w.]){named['name']}(?=\()"), lambda m: "D")
    if "D(" not in written.text and "D2(" not in written.text:
        return written
    bare = written.sub(_SAID, lambda m: "")
    if taken("D") or _OWN.search(bare.text):
        return written
    found = [m for form in (_TWICE, _ONCE) for m in form.finditer(bare.text)]
    if not found or len(found) > MOST:
        return written
    bare = bare.sub(_TWICE, lambda m: (m["of"] or m["inner"]).removesuffix("(t)") + "''")
    bare = bare.sub(_ONCE, lambda m: m["of"].removesuffix("(t)") + "'")
    begins: list[Edit] = [
        (m.start(), m.end(), "d/dt(") for m in _BEGINS.finditer(bare.text) if _has_one(bare.text, m.end())
    ]
    return bare.edited(begins)


def _has_one(text: str, at: int) -> bool:
    """Whether one argument stands in the bracket that opens in front of a place."""
    depth = 1
    for k in range(at, min(len(text), at + 2_000)):
        depth += (text[k] in "([{") - (text[k] in ")]}")
        if depth == 0:
            return True
        if text[k] in ",=\n" and depth == 1:
            return False
    return False
