"""Whether a statement in plain text ends where its line does: brackets that are open, an operator at the end."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import islice

OPEN_END = re.compile(r"(?:[-+*/×·=(\[,^−]|\.\.\.|…|\\)\s*\Z")
"""The end of a line that must go on."""

EMPTY_SIDE = re.compile(r"[\s&]*+(\\?[^\W\d][\w{}*^]{0,16}+)[\s&]*+=[\s&\\]*+(?:\?{1,3}|…|\.{2,4}|_{2,9})?+\s*+")
"""A name with nothing behind its equals sign, or with dots or a question mark."""
_STATED = re.compile(
    r"[\s&]*+(?:(?P<T>T(?:\^?\*)?|E_?\{?kin\}?)|(?P<V>V|U|E_?\{?pot\}?)|(?P<L>L|ℒ|\\mathcal\{L\})|(?P<D>D)"
    r"|(?:\\?Xi|Ξ|Q)(?P<force>_?\w{1,12}|_\{\w{1,12}\}))[\s&]*+=(?![=>])"
)
"""What begins with an energy, or a generalized force."""

MAX_LIST = 60
"""The most lines of a list of equations in brackets."""

_LISTING = {"{": "}", "[": "]"}
_CLOSED = {"(": ")", "[": "]"}
_STAR_END = re.compile(r"(?<!\w)T[₀-₉]*\*\s*\Z")

FEWEST_WORDS = 2
"""The fewest words that make a sentence of what has no equals sign."""
NEAR = 60
"""The characters before a point among which these words stand."""
_LONG_WORD = re.compile(r"[^\W\d_]{3,}")
NAME_NEXT = re.compile(r"[ \t]*+[^\W\d]\w{0,23}+['’′″]{0,2}[ \t]*+=(?![=>])")
"""A name that gets a value."""
_INTRODUCES = re.compile(
    r"[ \t]++(?:with|where|let|here|using|setting|putting|mit|wobei|sei|hier|avec|où|soit)(?=[ \t])", re.IGNORECASE
)
"""A word in front of a name that gets a value."""
MOST = 60
"""The most sides over several lines that are looked at."""
_SIDE_OF_LINES = re.compile(
    r"^[ \t]*+[^\s=+−–-][^\n=]*+\n(?:[ \t]*+[-+−–][ \t][^\n=]*+\n){1,12}(?=[ \t]*+=(?![=>]))", re.MULTILINE
)
"""A side over several lines, each with a sign in front, and = in front of the other side."""


def missing_brackets(text: str) -> str:
    """The brackets that are missing at the end of a statement, or "?" for one that is closed wrongly or nowhere on its
    side."""
    stack: list[str] = []
    for c in text:
        if c in _CLOSED:
            stack.append(_CLOSED[c])
        elif (c in ")]" and (not stack or stack.pop() != c)) or (c == "=" and stack):
            return "?"
    return "".join(reversed(stack))


def incomplete(text: str, below: str = "") -> bool:
    """Whether the statement must continue: it ends with an operator, or a bracket is open; not where nothing stands
    behind T = and the line ``below`` states something else, V = …"""
    empty, stated = EMPTY_SIDE.fullmatch(text), _STATED.match(below)
    label = _STATED.match(text) if empty is not None and stated is not None else None
    if label is not None and stated is not None and label.groups() != stated.groups():
        return False
    return bool(OPEN_END.search(text) and not _STAR_END.search(text)) or open_brackets(text) > 0


def open_brackets(text: str) -> int:
    """How many more brackets a text opens than it closes."""
    return sum(map(text.count, "([")) - sum(map(text.count, ")]"))


def defines_behind(text: str, first: int, stop: tuple[int, int]) -> bool:
    """Whether a sentence ends at a point, and a name gets a value behind it: the force N in y. s = sin(alpha). A word
    may introduce it: (H accelerates). With ω = φ' + ψ'."""
    introduced = _INTRODUCES.match(text, stop[1])
    if NAME_NEXT.match(text, introduced.end() if introduced else stop[1]) is None:
        return False
    words = islice(_LONG_WORD.finditer(text, max(first, stop[0] - NEAR), stop[0]), FEWEST_WORDS)
    return sum(1 for _ in words) == FEWEST_WORDS


def within_sums(text: str) -> set[int]:
    """Where lines begin that only add to a side: each begins with a sign, below one without, and = stands in front of
    the line behind them."""
    return {
        m.start() + line.start()
        for m in islice(_SIDE_OF_LINES.finditer(text), MOST)
        for line in re.finditer(r"^(?=[ \t]*[-+−–])", m.group(), re.MULTILINE)
    }


def whole_lists(text: str) -> Iterator[str]:
    """The lines of a text; those of one list in brackets, {a == b,↵ c == d} or [a = b,↵ c = d], together."""
    waiting: list[str] = []
    opens = closes = ""
    for line in text.split("\n"):
        if not waiting and (opens := line.lstrip()[:1]) in _LISTING:
            closes = _LISTING[opens]
        if waiting or (opens in _LISTING and line.count(opens) > line.count(closes)):
            waiting.append(line)
        whole = "\n".join(waiting)
        if not waiting:
            yield line
        elif not line.strip() or len(waiting) > MAX_LIST:
            yield from waiting
            waiting = []
        elif whole.count(opens) <= whole.count(closes):
            yield whole
            waiting = []
    yield from waiting
