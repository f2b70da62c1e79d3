r"""Finds letters of parameters that an answer uses for something of its own, which changes with time.

p = m_B (\dot x - \dot u), \dot p = …      where p is a length of the system: the answer has a rate of p
v = x' + l θ' cos θ, T = ½ m v²            where v is a constant of the system: what stands behind = has rates
c = cos θ, s = sin θ                       where c is a damper's constant: no constant is the cosine of a coordinate
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Sequence
from itertools import islice

from lagrangian.check.reading.own_lagrangian import is_lagrangian_beside_length
from lagrangian.check.reading.prose.words_or_mathematics import moves
from lagrangian.model import Model
from lagrangian.read.letters import SPELLED
from lagrangian.records import dataclass

MOST = 20
"""The most statements of one letter that are looked at."""
LONGEST = 300
"""The most characters of such a statement."""

_BEFORE = r"(?:^|[$:;,&(]|(?<!dot)(?<=[^\W\d_]{3})[ \t]|\\\[|\\\(|=>|⇒|→|\\Rightarrow|\\q?quad)[ \t&$*]*+"
_END = re.compile(r"[\n;$&]|\\\\|\\\]|\\q?quad|,(?=\s)|\.(?=\s|\Z)")
_RATE = re.compile(r"\\d?dot(?![A-Za-z])|\\frac\{d")
_FUNCTION = re.compile(r"\\?(?:sin|cos|tan)(?![A-Za-z]{3})")
_TWICE = re.compile(r"\\ddot(?![A-Za-z])|['’′]{2}|[\u0308″¨]|ddot\b|dd\b|\bd[²2]|\^2[ ]?/[ ]?dt")


@dataclass(frozen=True)
class OwnLetters:
    """Letters of parameters that are an answer's own for ``sure``, as it has their rates or calls a sine or cosine so,
    and that ``may`` be."""

    sure: frozenset[str]
    may: frozenset[str]


def own_letters_of(text: str, model: Model) -> OwnLetters:
    """Return the names of the parameters that an answer gives a value with rates, and no acceleration, and those that
    are the sine or cosine of coordinates by it."""
    plain = unicodedata.normalize("NFD", text)
    sure, may = set[str](), set[str]()
    moving = re.compile("|".join(_written(c.name) for c in model.coordinates))
    energy = {"L"} if is_lagrangian_beside_length(text) else set[str]()
    for name in (p.name for p in model.parameters if p.name not in energy):
        written = _written(name)
        if re.search(rf"(?<![\w\\]){written}", plain) is None:
            continue
        values = _values(plain, written)
        if values and all((m := _FUNCTION.match(x)) and moving.search(x, m.end()) for x in values):
            sure.add(name)
            continue
        if not _have_rates(values):
            continue
        rated = rf"\\d?dot\s?\{{?\s?{written}(?!\w)|(?<![\w\\]){written}(?:['’′]|\u0307|dot\b)|\bd{written}[ ]?/[ ]?dt"
        (sure if re.search(rated, plain) is not None else may).add(name)
    return OwnLetters(frozenset(sure), frozenset(may))


def _values(text: str, written: str) -> list[str]:
    """What stands behind a letter and =, wherever an answer says so."""
    stated = rf"{written}[ \t]*&?[ \t]*:?=(?![=>])"
    if re.search(stated, text) is None:
        return []
    found = list(islice(re.finditer(rf"{_BEFORE}{stated}\s*", text, re.MULTILINE), MOST))
    values = [text[m.end() : m.end() + LONGEST] for m in found]
    return [x[: end.start()] if (end := _END.search(x)) is not None else x for x in values]


def _have_rates(values: Sequence[str]) -> bool:
    """Whether there are values, and all have rates and no accelerations."""
    return bool(values) and all((moves(x) or _RATE.search(x)) and not _TWICE.search(x) for x in values)


def _written(name: str) -> str:
    """A pattern for a name as it is typed."""
    stem, _, index = name.partition("_")
    if not index and (split := re.fullmatch(r"([^\W\d_]+)(\d+)", stem)) is not None:
        stem, index = split.groups()
    greek = next((sign for sign, word in SPELLED.items() if word == stem), None)
    first = "|".join(filter(None, (rf"\\?{re.escape(stem)}", re.escape(greek) if greek else None)))
    last = rf"_?\{{?{re.escape(index)}\}}?" if index else ""
    return rf"(?:{first}){last}(?![\w_])"
