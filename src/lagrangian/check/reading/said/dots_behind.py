"""Reads dots behind names as rates, where an answer in plain text has two of them or says what they are.

m x.. + b x.^2 = F - k x                       m x'' + b x'^2 = F - k x
w1. and w2. their derivatives; J w1. = M       J w1' = M
x. = dx/dt; a dot behind a letter means d/dt   v. is v', and x. is x'

A dot at the end of a line is a rate, too, unless all equations end with one; before a word with a capital letter it
is a full stop.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import islice

from lagrangian.check.reading.characters import LATEX
from lagrangian.check.reading.markup import blank
from lagrangian.check.reading.names import Names
from lagrangian.read.letters import key
from lagrangian.records import dataclass

_NAME = r"[^\W\d_]\w{0,15}+"
_ONE = rf"(?<![\w.])(?!(?:etc|resp|bzw|usw|ca|cf|vs|no|eq|fig)\.){_NAME}\.(?![.\w])"
"""A name with a dot, which no short word has: etc."""
_LISTED = re.compile(
    rf"(?P<names>{_ONE}(?:(?:[ \t]*(?:,|&)|[ \t]+(?:and|und))[ \t]*{_ONE}){{0,7}})[ \t]*+"
    r"(?:(?:=|:|\bare\b|\bdenote\b)[ \t]*+)?"
    r"(?:(?:the|their|its|die|ihre|deren)[ ])?(?:(?:first|1st|ersten?|corresponding|time|total)[ -]?){0,2}"
    r"(?:derivatives?|rates?|(?:Zeit)?[Aa]bleitung(?:en)?)\b"
    r"(?:[ ](?:of|by|with|in|von|nach)[ ][^.,;()=\n]{1,40})?[ \t]*+(?:[,;.]|(?=[)\n])|\Z)"
)
"""Names with a dot, of which words say that they are rates."""
_FRACTION = re.compile(
    rf"(?<![\w.])(?P<name>{_NAME})\.[ \t]*(?:=|:|\bis\b|\bmeans\b|\bfor\b|\bdenotes\b|\bheißt\b)[ \t]*"
    r"d[ ]?(?P<of>[^\W\d_]\w{0,15}?)[ ]?/[ ]?dt(?!\w)[ \t]*+[,;]?"
)
"""x. = dx/dt."""
_SAID = re.compile(
    r"\b(?:dots?|points?|Punkte?)[ ](?:behind|after|following|hinter|nach)\b[^.;\n]{0,60}?"
    r"(?:\bd[ ]?/[ ]?dt\b|\bderivatives?\b|\brates?\b|[Aa]bleitung)",
)
"""What says that dots are rates everywhere."""
_LEGEND = re.compile(
    rf"(?<![\w.])(?P<name>{_NAME})\.{{1,2}}[ \t]*(?:=|:|\bis\b|\bmeans\b)[ \t]*(?:the[ ])?"
    r"(?:first|second|1st|2nd|erste|zweite|time|derivative|rate|(?:Zeit)?[Aa]bleitung)\b"
)
_TWO = re.compile(rf"(?<![\w.])(?P<name>{_NAME})\.\.(?![.\w])")
_DOTTED = re.compile(rf"(?<![\w.\\])(?P<count>\d{{0,3}})(?P<name>{_NAME})(?P<dots>\.{{1,2}})(?![.\w])")
_GOES_ON = re.compile(r"\.{1,2}[ \t]?(?:[-+−*/^²³·×)=]|\])")
_FULL_STOP = re.compile(r"\.[ \t]+[A-ZÄÖÜ](?:[a-zäöüß]{2,}|[a-z][ ][a-z]{2,})(?![\w(])")
_LAST = re.compile(r"\.[ \t]*$", re.MULTILINE)
MOST = 40
"""The most such words of an answer that are looked at."""


@dataclass(frozen=True)
class DottedText:
    """A text of the same length, in which dots behind names are primes; whether one at the end of a line may also be a
    full stop, or the other way round, and which of both was chosen."""

    text: str
    open: bool = False
    stops: bool = False


def with_dots_behind(text: str, names: Names, *, stops: bool | None = None) -> DottedText:
    """Return an answer in plain text whose dots behind names are primes, without what explains them.

    ``stops`` says whether dots at the ends of lines are full stops; if it does not, the lines tell.
    """
    if "." not in text or LATEX.search(text) is not None:
        return DottedText(text)
    own, moves = {key(name) for name in names.model.symbols}, names.changes

    def taken(name: str) -> bool:
        return key(name) in own

    listed = [m for m in islice(_LISTED.finditer(text), MOST) if all(moves(x) or not taken(x) for x in _names(m))]
    fractions = [m for m in islice(_FRACTION.finditer(text), MOST) if m["of"] == m["name"]]
    named = {x for m in listed for x in _names(m)} | {m["name"] for m in fractions}
    named |= {m["name"] for form in (_TWO, _LEGEND) for m in islice(form.finditer(text), MOST) if moves(m["name"])}
    everywhere = _SAID.search(text) is not None
    if not named and not everywhere:
        return DottedText(text)
    if everywhere:
        named |= {m["name"] for m in _DOTTED.finditer(text) if _GOES_ON.match(text, m.start("dots"))}
    named = {x for x in named if moves(x) or not taken(x)}
    for match in (*listed, *fractions):
        text = blank(text, *match.span())
    dotted = [m for m in _DOTTED.finditer(text) if m["name"] in named or moves(m["name"])]
    dotted = [m for m in dotted if len(m["dots"]) > 1 or _FULL_STOP.match(text, m.start("dots")) is None]
    last = {m.start("dots") for m in dotted if len(m["dots"]) == 1 and _LAST.match(text, m.start("dots"))}
    ends = [at for line, at in _ends(text) if "=" in line]
    all_stop = all(text[at - 1 : at] == "." for at in ends)
    chosen = all_stop if stops is None else stops
    letters = list(text)
    for match in dotted:
        at, end = match.span("dots")
        if not (chosen and at in last):
            letters[at:end] = "'" * (end - at)
    sure = all_stop and any(at - 1 not in last for at in ends)
    return DottedText("".join(letters), bool(last) and not sure, chosen)


def _names(match: re.Match[str]) -> list[str]:
    """The names of a list, without their dots."""
    return [x for x in re.findall(_NAME, match["names"]) if x not in ("and", "und")]


def _ends(text: str) -> Iterator[tuple[str, int]]:
    """The lines of a text, and where what stands in each of them ends."""
    at = 0
    for line in text.split("\n"):
        yield line, at + len(line.rstrip())
        at += len(line) + 1
