"""Reads what an answer in plain text says about how it writes derivatives by time.

D1 = first time derivative, D2 = second      D1y, D2 y and D2(y) are y', y'' and y''
p behind a name = d/dt, pp = d^2/dt^2        phip and phipp are phi' and phi''
index t = time derivative                    phi_t is phi'
x. = first derivative, x.. = second          says nothing else and is left out
y1, y2: first and second derivative of y     y1 = y'; y2 = y'';
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from itertools import islice

from lagrangian.check.reading.prose.words import function_of
from lagrangian.check.reading.traced_text import Edit, TracedText, apart
from lagrangian.records import dataclass

_TWO = r"[ ]?(?:\^|\*\*)?[ ]?\(?(?:2|²)\)?"
_OPERATOR = rf"d(?:{_TWO})?[ ]?/[ ]?\(?dt(?:{_TWO})?\)?(?![\w(]|[ \t]{{1,9}}(?:[(\[∂]|d\w))"
_WORDS = (
    r"(?:the[ ])?(?:(?:first|1st|once|second|2nd|erste|zweite|première|seconde)[ ])?(?:(?:time|total)[ -]?)?"
    r"(?:derivative|rate|(?:zeit)?ableitung|dérivée)(?!s|[ ]of\b|[ ]von\b|[ ]de\b)"
    r"(?:[ ](?:by|in|with[ ]respect[ ]to|w\.r\.t\.|nach)[ ](?:der[ ])?(?:time|t|zeit)\b)?"
)
_ALONE = r"(?:first|1st|second|2nd|erste|zweite)(?=[ \t]*(?:[,;.)]|$))"
_DOTS = r"(?:(?:a|one|single|ein|double|two|zwei)[ ](?:dots?|Punkte?)|dot|ddot|Punkt)(?=[ \t]*(?:[,;.)]|$))"
_WHERE = r"(?:behind|after|before|in[ ]front[ ]of|under|over|on|hinter|nach|vor|an)[ ](?:(?:an?|the|any|einem|dem)[ ])?"
_LEGEND = re.compile(
    r"(?<![\w.*/^+'’′-])(?P<quote>['\"`]?)(?:(?:a|an|suffix|prefix|index|subscript)[ ])?"
    r"(?:(?P<mark>[^\W\d]{1,4}\d?)|(?P<shown>[^\W\d]\w{0,11}(?:['’′]{1,2}|\.{1,2})|['’′]{1,2}))(?P=quote)"
    rf"(?:[ ]{_WHERE}(?:name|letter|coordinate|variable|symbol|quantity|buchstaben|namen)s?)?"
    r"[ \t]*(?:=|:|\bmeans\b|\bis\b|\bdenotes\b|\bstands[ ]for\b|\bheißt\b|\bbedeutet\b|\bist\b)[ \t]*"
    rf"(?P<said>{_OPERATOR}|{_WORDS}|{_ALONE}|{_DOTS})(?![\w(])[ \t]*[,;.]?",
    re.IGNORECASE | re.MULTILINE,
)
_SECOND = re.compile(r"second|2nd|zwei|double|two|ddot|[2²]", re.IGNORECASE)
_DERIVES = re.compile(r"deriv|ableit|/|dot|punkt", re.IGNORECASE)
_NAME = re.compile(r"(?<![\w\\])(?:(?<=/)[d∂](?=\w))?(?P<name>[^\W\d]\w{0,23})")
_OF = re.compile(r"[ \t]?(?P<open>\()?(?P<of>[^\W\d]\w{0,23})(?(open)\)|(?![\w(]))")
_OF_ENERGY = re.compile(r"d[TVULD][ ]?/[ ]?d")
"""A slope of an energy, dT/dxd, in which d is no mark."""
MOST = 12
"""The most marks that an answer explains."""


_LETTER = r"[^\W\d]\w{0,15}+"
_PAIR = rf"(?<![\w.*/^+'’′-])(?P<first>{_LETTER})[ \t]*+(?:,|and|und|&)[ \t]*+(?P<second>{_LETTER})[ \t]*+"
_BOTH = (
    r"(?:(?:the|die|der)[ ])?(?:(?:first|1st|erste)[ ](?:and|und)[ ](?:the[ ])?(?:second|2nd|zweite)[ ](?:time[ ])?"
    r"(?:derivatives?|rates?|(?:Zeit)?[Aa]bleitung(?:en)?)|(?:angular[ ])?(?:velocity|speed|rate)[ ]and[ ](?:the[ ])?"
    r"(?:angular[ ])?acceleration|(?:Winkel)?[Gg]eschwindigkeit[ ]und[ ](?:Winkel)?[Bb]eschleunigung)"
)
_PAIRED = re.compile(
    rf"{_PAIR}(?:(?:[:=]|\bare\b|\bis\b|\bdenotes?\b|\bsind\b|\bfor\b)[ \t]*+)?"
    rf"(?:{_BOTH}|(?:(?:those|likewise|similarly|analogously|the[ ]same|ebenso|entsprechend|dasselbe)\b)?)"
    r"[ \t]*+(?:of|for|von|für)[ \t]++(?:the[ ])?(?:coordinate[ ]|angle[ ])?"
    rf"(?P<of>{_LETTER})(?![\w'’′(])[ \t]*+[,;.)]?(?:[ \t]*+(?:and|und)(?=[ ]))?",
)
"""Two names for the rate and the acceleration of a coordinate."""
_SAYS = re.compile(rf"{_BOTH}|likewise|similarly|analogously|the same|ebenso|entsprechend|dasselbe")


def with_paired_rates(written: TracedText, moves: Callable[[str], bool], taken: Callable[[str], bool]) -> TracedText:
    """Return an answer in plain text in which two names that words call the first and the second derivative of a
    coordinate are its rate and its acceleration; ``p1, p2 of phi`` behind such words says the same."""
    found = list(islice(_PAIRED.finditer(written.text), MOST))
    if not any(map(_SAYS.search, (m.group() for m in found))):
        return written
    edits: list[Edit] = []
    for m in found:
        if moves(m["of"]) and taken(m["of"]) and not taken(m["first"]) and not taken(m["second"]):
            edits.append((*m.span(), f"; {m['first']} = {m['of']}'; {m['second']} = {m['of']}'';"))
    return written.edited(edits)


_RAISED = re.compile(
    r"(?<![\w\\.])(?P<name>[^\W\d]\w{0,15}+)[ ]?\^[ ]?(?P<open>[({])?(?P<dots>\.{1,2})(?(open)[)}])(?![\d.])"
)
"""Dots in the place of an exponent: phi^. and phi^.."""


def with_raised_dots(written: TracedText, moves: Callable[[str], bool]) -> TracedText:
    """Return an answer in plain text in which dots behind ^ are primes; ``moves`` says whether a name changes."""

    def primed(match: re.Match[str]) -> str:
        return f"{match['name']}{chr(39) * len(match['dots'])}" if moves(match["name"]) else match.group()

    return written.sub(_RAISED, primed)


@dataclass(frozen=True)
class _Mark:
    """A mark in front of names or behind them, and the order of the derivative."""

    text: str
    order: int


def with_derivative_legends(
    written: TracedText, moves: Callable[[str], bool], taken: Callable[[str], bool]
) -> TracedText:
    """Return an answer in plain text whose names with such marks have primes, without what explains the marks.

    ``moves`` says whether a name changes with time, ``taken`` whether it belongs to the system.
    """
    text = written.text
    found = [m for m in islice(_LEGEND.finditer(text), MOST) if m["shown"] or not taken(m["mark"])]
    if not any(_DERIVES.search(m["said"]) for m in found):
        return written
    edits: list[Edit] = [(*m.span(), "") for m in found if m["shown"]]
    marks = [_Mark(m["mark"], 2 if _SECOND.search(m["said"]) else 1) for m in found if m["mark"]]
    marks = [mark for mark in marks if not _is_operator(text, mark.text)]
    marks.sort(key=lambda mark: -len(mark.text))
    said = [range(*m.span()) for m in found]
    names = [m for m in _NAME.finditer(text) if not any(m.start() in x for x in said)]
    names = [m for m in names if not taken(m["name"]) and function_of(m["name"]) is None]
    alone = {m["name"] for m in names}
    uses = [edit for m in names if (edit := _use(text, m, marks, lambda x: moves(x) or x in alone)) is not None]
    if uses:
        edits += [*((*m.span(), "") for m in found if m["mark"]), *uses]
    return written.edited(apart(sorted(edits)))


def _is_operator(text: str, mark: str) -> bool:
    """Whether a mark stands in front of more than a name, as in D(D(x)), which operators do."""
    return any(_OF.match(text, m.end() - 1) is None for m in islice(re.finditer(rf"(?<!\w){mark}\(", text), MOST))


def _use(text: str, match: re.Match[str], marks: Sequence[_Mark], named: Callable[[str], bool]) -> Edit | None:
    """The edit that writes a name with a mark as one with primes, if what is left is ``named``."""
    name = match["name"]
    if _OF_ENERGY.match(text, match.start()) is not None:
        return None
    for mark in marks:
        primes = "'" * mark.order
        for bare in (name.removesuffix(f"_{mark.text}"), name.removeprefix(mark.text), name.removesuffix(mark.text)):
            if bare not in ("", name) and named(bare):
                return *match.span("name"), f"{bare}{primes}"
        if name == mark.text and (of := _OF.match(text, match.end())) is not None and named(of["of"]):
            return match.start("name"), of.end(), f"{of['of']}{primes}"
    return None
