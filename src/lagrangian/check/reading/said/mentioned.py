"""Finds the names of which words say something that was not read: then nobody knows whether an answer with them is
wrong, and what they are is asked."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from itertools import islice

from lagrangian.read.letters import key

MOST = 40
"""The most places at which a name is looked at."""
LONGEST = 240
"""The most characters of what is said of it."""

_EXPLAINED = re.compile(
    r"(?<![\w\\])\$?\\?(?P<name>[^\W\d]\w{0,23}+)\$?\)?"
    r"(?:[ \t]{0,9}+(?::|=|\bis\b|\bdenotes\b|\bmeans\b|\bfor\b|\.{2,9}|[…–—|-])[ \t]{0,9}+|[ \t]{2,20}+)"
    r"(?:(?:the|an?)[ \t])?(?P<word>[^\W\d_]{4,})(?P<rest>[^\n]{0,60})"
)
"""A name with words that say what it is: rho: radius of the drum."""
_CHOSEN = re.compile(
    r"\bcoordinates?\b[^.;=\n]{0,60}\bthe[ ](?:angle|distance|displacement|position)[ ]"
    r"(?P<name>[^\W\d]\w{0,23}+)(?=[ ][a-z])"
)
"""A coordinate of the answer that words explain: as second coordinate the angle β through which the disc turns."""
_VERBS = (
    r"is|are|means?|meaning|denot\w{1,4}|stands?|standing|should|shall|being|be|represents?|abbreviat\w{1,4}|collects?|"
    r"contains?|holds|comprises|sums?|short|ist|sind|sei|seien|bezeichnet|bedeutet|steht|meint|umfasst|enthält|désigne"
)
_BEHIND = re.compile(rf"[ \t]*(?:\([^()\n]{{0,30}}\)[ \t]*)?(?:[,:=…–—|]|\.{{2,9}}|-{{1,2}}[ \t]|(?:{_VERBS})\b)(?=\D)")
_AHEAD = re.compile(
    r"(?:\b(?:call\w{0,3}|name[ds]?|label\w{0,3}|abbreviat\w{1,4}|short(?:hand)?(?:[ ]for)?|writ\w{1,4}|letters?|"
    r"symbols?|let|where|with|by|as|quantity|nenne\w?|hei(?:ß|ss)t|bezeichne\w?|mit|wobei|als)[ \t]+"
    r"(?:(?:it|this|that|all|them)[ \t]+)?"
    r"|(?P<open>(?<=[^\W\d_]{3})[ \t]+\([ \t]?))\Z",
    re.IGNORECASE,
)
_ENDS = re.compile(r"(?<!\.)\.(?=\s|\Z)|;|\n[ \t]*\n|\n(?=[^\n]{0,200}=)")
_LAST = re.compile(r"\.\s|;|\n")
_UNIT = re.compile(
    r"(?<!\w)(?:kg|Nms|Nm|Ns|N|J|W|rad|m)(?:(?:²|³|\^\d)?[ ]?[·*/]?[ ]?(?:kg|m|s|rad)(?!\w)){0,4}(?:²|³|\^\d)?(?![\w(])"
)
_FORMULA = re.compile(
    r"[+*/^²³×·√]|\w['’′″](?!s\b)|[-−]\s?\w|\w\(|\d[^\W\d]|[\u0307\u0308ẋẍẏÿżṙ]|(?<!\w)[^\W\d_][ ][^\W\d_](?!\w)"
)
_WORDS = re.compile(
    r"\b(?:times|plus|minus|sum|summed|product|squared?|twice|half|divided|over|together|collect\w{0,3}|everything|all|"
    r"rest|bracket|abbreviat\w{0,4}|short|shorthand|forces?|pull|push|moment(?![ ]of[ ]inertia)s?|torques?|thrust|"
    r"energy|component|mal|summe|produkt|hälfte|quadrat|klammer|abkürzung|kraft|kräfte|momente?|drehmoment|energie)\b"
    r"|kraft\b|moment\b",
    re.IGNORECASE,
)
"""Words of a value, or of a quantity that is no constant."""


def described_names(text: str, known: Callable[[str], bool]) -> frozenset[str]:
    """The names of which words alone say what they are."""
    return frozenset(m["name"] for m in _EXPLAINED.finditer(text) if not known(m["word"]))


def chosen_names(text: str) -> frozenset[str]:
    """The names, in their common form, of coordinates that words explain."""
    return frozenset(key(m["name"]) for m in _CHOSEN.finditer(text))


def mentioned_names(text: str, names: Iterable[str]) -> frozenset[str]:
    """Those of some names of which words beside them may say a value, or that they are a force or a sum."""
    bare = re.sub(r"[\\${}`]|/\*|\*/", "", text)
    return frozenset(name for name in names if any(map(_says_more, _said(bare, re.sub(r"[\\{}]|^bold ", "", name)))))


def _said(text: str, name: str) -> Iterator[str]:
    """What words say behind a name and in front of it, in the same sentence."""
    form = re.compile(rf"(?<![\w.'’′]){re.escape(name.removesuffix('_star'))}(?![\w'’′^])\*?")
    for match in islice(form.finditer(text), MOST):
        behind = _ENDS.split(text[match.end() : match.end() + LONGEST])[0]
        before = text[max(0, match.start() - LONGEST) : match.start()]
        whole = _LAST.split(before)[-1]
        if _BEHIND.match(behind) is not None and re.search(r"[^\W\d_]{3}", behind) is not None:
            yield behind
        ahead = _AHEAD.search(before)
        if ahead is not None and (not ahead["open"] or behind[:1] == ")") and re.search(r"[^\W\d_]{3}", whole):
            yield whole + " " + behind


def _says_more(said: str) -> bool:
    bare = _UNIT.sub(" ", said)
    return _FORMULA.search(bare) is not None or _WORDS.search(bare) is not None
