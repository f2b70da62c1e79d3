"""Sets aside the values of letters that stand for one thing after the other, in a list of cases or in a table.

p = l/2 for B, p = l for Q              at B p = l/2, at Q p = l
pin: m/6 at radius e  (u = 0)           tip: M at radius e + l cos(beta)  (u = l)

Such a letter has no one value: its values do not contradict each other, and what is said with it holds for each case.
If a letter is used between two of its values, each holds up to the next one; if nothing else uses it, each stands
alone.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from itertools import islice

from lagrangian.check.reading.prose.words import function_of
from lagrangian.check.reading.traced_text import TracedText, apart
from lagrangian.read.letters import SPELLED
from lagrangian.records import dataclass

MOST, MOST_TOLD = 60, 6
"""The most values in cases that are looked at, and those of one letter that are told."""

_NAME = r"[^\W\d][^\W²³]{0,11}+"
_GIVEN = r"(?:²|\^2)?[ \t]{0,9}+=(?![=>])[ \t]{0,9}+"
_GAP, _MORE = r"[ \t]{1,9}", r"[ \t]{0,9}"
_VALUE = r"(?P<value>[^\s=,;:][^\n=,;:]{0,59}?)"
_FOR = r"(?:for|at|in|of|bei|für|im|in[ \t]der|pour|à|au)"
_CASE = r"(?P<case>[^\n=,;:.()<>≤≥]{1,40}?)"
_BEHIND = re.compile(
    rf"(?<![\w*/^+=−'’′-])\$?\\?(?P<name>{_NAME}){_GIVEN}{_VALUE}\$?{_GAP}{_FOR}{_GAP}{_CASE}"
    rf"(?={_MORE}(?:[,;)\]]|\.(?=\s|$)|(?:and|und|et|or|oder)[ \t]|$))",
    re.MULTILINE,
)
"""A value and its case: p = l/2 for B."""
_BEFORE = re.compile(
    r"(?<!\w)(?:[Ff]or|[Aa]t|[Ii]n|[Bb]ei|[Ff]ür|[Ii]m|[Pp]our)[ \t]{1,9}"
    r"(?P<case>[^\s=,;:.()<>≤≥+*/^][^\n=,;:.()<>≤≥+*/^]{0,39}?)(?:[ \t]?[,:])?[ \t]{1,9}"
    rf"\$?\\?(?P<name>{_NAME}){_GIVEN}{_VALUE}\$?(?={_MORE}(?:[,;)\]]|\.(?=\s|$)|(?:and|und|et)[ \t]|$))",
    re.MULTILINE,
)
"""A case and its value: at B p = l/2."""
_IN_BRACKETS = re.compile(
    rf"^(?P<case>[^\n=]{{3,200}}?)[ \t][ \t]{{0,40}}[(\[][ \t]?\$?\\?(?P<name>{_NAME}){_GIVEN}{_VALUE}\$?[ \t]?[)\]]"
    r"[ \t.,;]{0,9}$",
    re.MULTILINE,
)
"""A row of a table, which says nothing itself, with the value that belongs to it: pin: m/6  (u = 0)."""
_QUANTITY = re.compile(
    r"(?<!\w)(?:mass(?:es)?|angle|length|distance|radius|ratio|coefficient|multiplier|force|density|constant|parameter|"
    r"Masse|Winkel|Länge|Abstand|Radius|Koeffizient|Multiplikator|Kraft|Dichte|Verhältnis)[ \t]{1,9}"
    r"(?P<name>[a-z]{2,7})(?![\w'’′])"
)
"""A quantity and its letter: a point mass mu."""


@dataclass(frozen=True)
class _Stated:
    """A value of a letter in one case, where the words about it begin and end, and from where the letter counts as
    used."""

    name: str
    value: str
    case: str
    span: tuple[int, int]
    since: int


def with_running_letters(written: TracedText, taken: Callable[[str], bool], notes: dict[str, None]) -> TracedText:
    """Return an answer without the values of such letters, as notes tell; ``taken`` says whether a name is one of the
    system."""
    text = written.text
    listed: dict[str, list[_Stated]] = {}
    for stated in _found(text):
        if not taken(stated.name) and function_of(stated.name) is None:
            listed.setdefault(stated.name, []).append(stated)
    gone: list[_Stated] = []
    for name, values in listed.items():
        if _is_running(name, values, text):
            gone += values
            told = (" ".join(text[slice(*x.span)].replace("$", "").split()).strip("()[] ") for x in values[:MOST_TOLD])
            notes |= dict.fromkeys(f"'{x}' was not judged: {name} stands for several values." for x in told)
    return written.edited(apart((*x.span, " " * (x.span[1] - x.span[0])) for x in gone))


def introduced_letters(text: str) -> dict[str, None]:
    """The names of Greek letters behind the quantities that they are, which are no products: a point mass mu."""
    found = (m["name"] for m in islice(_QUANTITY.finditer(text), MOST))
    return dict.fromkeys(x for x in found if x in SPELLED.values())


def _found(text: str) -> Iterator[_Stated]:
    """The values of letters in cases, in their order, each once."""
    found: list[_Stated] = []
    for form in (_BEHIND, _BEFORE, _IN_BRACKETS):
        for match in islice(form.finditer(text), MOST):
            start = match.end("case") if form is _IN_BRACKETS else match.start()
            free = all(match.end() <= x.span[0] or x.span[1] <= start for x in found)
            if free and _is_closed(text[start : match.end()]):
                value, case = ("".join(match[x].split()) for x in ("value", "case"))
                found.append(_Stated(match["name"], value, case, (start, match.end()), match.start()))
    return iter(sorted(found, key=lambda x: x.span))


def _is_closed(part: str) -> bool:
    """Whether a part of a text closes the brackets and the mathematics of LaTeX that it opens."""
    return part.count("$") % 2 == 0 and all(part.count(a) == part.count(b) for a, b in ("()", "[]", "{}"))


def _is_running(name: str, values: Sequence[_Stated], text: str) -> bool:
    """Whether a letter has different values in different cases, no other value, and is used, but not between these."""
    if len({x.value for x in values}) < 2 or len({x.case for x in values}) < len(values):
        return False
    first, last = values[0].since, values[-1].span[1]
    places = [m.start() for m in re.finditer(rf"(?<!\w){re.escape(name)}(?![^\W²³])", text)]
    given = len(re.findall(rf"(?<!\w){re.escape(name)}{_GIVEN}", text))
    return sum(first <= x < last for x in places) == given == len(values) < len(places)
