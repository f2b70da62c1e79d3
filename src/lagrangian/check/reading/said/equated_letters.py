"""Finds letters of constants that an answer equates with coordinates, (a = alpha, b = beta), and that have rates in it.

A constant has no rate: where an answer has a'' and says a = alpha, its a is no length of the system.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from itertools import islice

from lagrangian.read.letters import key, undotted

MOST = 40
"""The largest number of pairs that are looked at."""

_NAME = r"\\?[^\W\d_][^\W_]{0,11}(?:_\w{1,8})?"
_PAIR = re.compile(
    rf"(?:(?<![^\n])|(?<=[(\[,;:.$])|(?<=\b(?:and|und))|(?<=\b(?:with|here))|(?<=\bwhere))[ \t]*[$`]?"
    rf"(?P<pair>(?P<new>{_NAME})[ \t]*(?:=|:=|≙|\bis\b|\bmeans\b|\bstands[ \t]for\b)[ \t]*(?P<own>{_NAME}))"
    r"(?=[$`]?[ \t]*(?:[,;:.)\]\n]|\Z|(?:and|und)\b))",
    re.IGNORECASE,
)
"""A name alone that is equated with another one, in a list or between brackets."""
_DERIVED = re.compile(
    r"(?P<primed>[^\W\d_]\w{0,20})[ \t]?['’′″](?!s\b)|\\d{1,2}ot[ \t]*\{?[ \t]*(?P<dotted>\\?[^\W\d]\w{0,20})"
    r"|(?<!\w)d[ \t]?(?:\^?2|²)?[ \t]?(?P<top>[^\W\d_]\w{0,20})[ \t]?/[ \t]?dt(?!\w)"
    r"|(?<!\w)(?P<spelled>[^\W\d_][^\W_]{0,11})_?d{1,2}ot(?!\w)"
)
"""A name with the sign of a rate."""
_ANY = re.compile(r"[^\W\d_][\w\u0307\u0308]{0,20}")


_SECOND = re.compile(
    r"(?:instead of|in (?:place|lieu) of|rather than|\bfor|\bfür|statt|anstelle(?: von)?)[ \t\n]{1,9}"
    r"(?:(?:the|your|die|den|das|der)[ \t\n])?(?:[^\W\d_]{3,20}[ \t\n]){0,2}\Z",
    re.IGNORECASE,
)
"""What stands in front of a name of the system behind the letter for it."""


def is_second(text: str, at: int) -> bool:
    """Whether the name at a place of a text is one for which a letter was given in front of it: in "u for x, w for y, c
    for k" no list of letters begins with x or with y."""
    return _SECOND.search(text, max(0, at - 60), at) is not None


def equated_letters(
    text: str, is_constant: Callable[[str], bool], is_coordinate: Callable[[str], bool]
) -> Iterator[tuple[str, str, tuple[int, int]]]:
    """Yield the letters of constants that an answer equates with coordinates and of which it has rates, these
    coordinates, as they are written, and where."""
    rates: set[str] | None = None
    for match in islice(_PAIR.finditer(text), MOST):
        new, own = match["new"].lstrip("\\"), match["own"].lstrip("\\")
        if not is_constant(new) or not is_coordinate(own):
            continue
        rates = _rates(text) if rates is None else rates
        if key(new) in rates:
            yield new, own, match.span("pair")


def _rates(text: str) -> set[str]:
    """The names that have rates in an answer, in their common form."""
    found = {key(undotted(x.lstrip("\\"))[0]) for m in _DERIVED.finditer(text) for x in m.groups() if x}
    return found | {key(undotted(m.group())[0]) for m in _ANY.finditer(text) if undotted(m.group())[1]}
