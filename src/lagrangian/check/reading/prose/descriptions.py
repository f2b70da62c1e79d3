"""Tells what words say without any mathematics from what may be a statement.

θ = bar angle, pin at the origin              a name and what it means
r = distance hinge - slider                   a hyphen between words is no minus
θ (drum), x (load, down)                      names and words
left side = right side                        what an equation is
"""

from __future__ import annotations

import re
from itertools import pairwise

from lagrangian.check.reading.name_patterns import WORD_LETTER
from lagrangian.check.reading.prose.levels import is_level
from lagrangian.check.reading.prose.words import Words, function_of
from lagrangian.check.reading.prose.words_or_mathematics import ADDING, LINKING, is_common, is_prose, is_word
from lagrangian.read.letters import SPELLED, key

_NAMED = re.compile(
    r"[\s*`$\\]*+(?P<name>[^\W\d]\w{0,23}+)(?:[\s*`$]*+(?:,|\band\b|\bund\b|&)[\s*`$]*+[^\W\d]\w{0,23}+){0,8}+[\s*`$]*+\Z"
)
"""A name, or several: S1 and S2 = rope forces."""
_FREEDOMS = re.compile(
    r"(?:[\w ]{0,30}=[ \t]*)?\d[ \t]*(?:degrees?[ \t]of[ \t]freedom|dofs?|freiheitsgrade?|ddl)\W*", re.IGNORECASE
)
"""How many freedoms there are: f = 2 degrees of freedom."""
_SAME = re.compile(r"[\s(]*+(?P<one>[^\W\d]\w{0,23}+)\s*=\s*(?P<other>[^\W\d]\w{0,23}+)[\s)]*+\Z")
"""A name for another: th = theta."""
_LEFT_OR_RIGHT = r"(?:the[ ])?(?:left|right|linke|rechte|lhs|rhs)(?:[ -]?hand)?(?:[ -]?(?:sides?|seiten?))?"
_BOTH = re.compile(
    rf"(?:[^\W\d_]{{2,20}}[ :,.]{{1,2}}){{0,6}}{_LEFT_OR_RIGHT}[ ]?=[ ]?{_LEFT_OR_RIGHT}[ .]*", re.IGNORECASE
)
"""What an equation is: left side = right side."""
_PIECES = re.compile(r"[,;:!?()\[\]{}*`\"\n]+|\.(?=\s|\Z)|(?<!\S)[-–—]+(?!\S)")
_TOKEN = re.compile(r"[^\W\d_]++(?:[.'’-][^\W\d_]++)*+(?!\w)|\w+|\S")
_LISTED = (
    "sum product difference ratio quotient square squared root divided multiplied equal equals opposite derivative "
    "summe produkt differenz quotient quadrat wurzel gleich ableitung geteilt"
)
_FORMULAS = ADDING | frozenset(_LISTED.split())
"""Words with which a line may state something, after all."""
_SHORTEST = 4
"""The fewest letters of a word that stands alone."""
_CUT = re.compile(r"[,;:\n]|\.(?=\s|\Z)")
LONGEST_ITEM = 120
"""The most characters of an item of a list of descriptions on each side of and."""
LONGEST = 2000
"""The most characters of a line that is looked at."""


def is_left_out(text: str, own: str, words: Words) -> bool:
    """Whether a row says nothing of the system, and what it says of levels is told; ``own`` is the row with the words
    around it."""
    if is_level(text, own, words) or is_prose(text, words):
        return True
    return is_description(text, words) or is_description(own, words)


def is_description(text: str, words: Words) -> bool:
    """Whether a statement says in words alone what a name means, or that the sides are equal."""
    sides = text.split("=")
    if any(form.fullmatch(text.strip()[:LONGEST]) for form in (_FREEDOMS, _BOTH)):
        return True
    if len(sides) != 2 or len(text) > LONGEST:
        return False
    last = re.search(r"(\w{1,30})[\s*`$]{0,9}\Z", sides[0])
    if last is not None and _NAMED.match(sides[0]) is None and not is_spoken(last[1], words):
        return False  # so with x1 = φ
    named = [(m["name"], other) for x, other in (sides, sides[::-1]) if (m := _NAMED.match(x)) is not None]
    named = [(name, other) for name, other in named if function_of(name) is None and _may_be_name(name, words)]
    return any(_describes(other, words) for _, other in named)


def amid_names(text: str, match: re.Match[str], words: Words) -> bool:
    """Whether a link stands between names of which words say what they are: N = load, S1 and S2 = rope forces."""
    if match.group() not in ("and", "und", "et"):
        return False
    before = _CUT.split(text[max(0, match.start() - LONGEST_ITEM) : match.start()])[-1]
    behind = _CUT.split(text[match.end() : match.end() + LONGEST_ITEM])[0]
    return _NAMED.match(before) is not None and is_description(f"{before} and {behind}", words)


def states_nothing(text: str, words: Words) -> bool:
    """Whether a line has words, perhaps with names among them, and no mathematics: each of its pieces is a
    description, or consists of words, names and numbers of which no two that are no words are neighbours."""
    if len(text) > LONGEST or any(x.lower() in _FORMULAS for x in re.findall(r"[^\W\d_]+", text)):
        return False
    pieces = [x for x in _PIECES.split(text) if x.strip()]
    spoken = any(is_spoken(x, words) for x in re.findall(r"[^\W\d_]+", text))
    return spoken and all(is_description(x, words) or _says(x, words) or _renames(x, words) for x in pieces)


def _may_be_name(name: str, words: Words) -> bool:
    """Whether this is a name, and no word in front of an equals sign: inertia force = spring force."""
    long = len(name) > 2 and name.isalpha() and key(name) not in SPELLED.values()
    return not long or words.names.known(name)


def _renames(piece: str, words: Words) -> bool:
    """Whether a name of the answer's own is one of the system, as its statements are read: th = theta."""
    match = _SAME.match(piece)
    return match is not None and any(words.names.known(x) for x in match.group("one", "other"))


def _says(piece: str, words: Words) -> bool:
    """Whether words, names and numbers stand here, and no product and no sign of mathematics."""
    listed = _TOKEN.findall(piece)
    if any(re.fullmatch(r"[\w.'’-]+", x) is None for x in listed):
        return False
    spoken = [is_spoken(x, words) for x in listed]
    return all(any(pair) for pair in pairwise(spoken)) and not any(function_of(x) for x in listed)


def _describes(said: str, words: Words) -> bool:
    """Whether one side consists of words and no formula."""
    listed = _TOKEN.findall(_PIECES.sub(" ", said))
    if (
        not listed
        or any(x.lower() in _FORMULAS for x in listed)
        or listed[0].lower() in ("zero", "null")
        or not is_spoken(listed[0], words)
    ):
        return False
    if len(listed) == 1:
        return len(listed[0]) >= _SHORTEST and words.count(listed[0]) == 1 and not words.is_used(listed[0])
    if not (is_spoken(listed[-1], words) or listed[-1].isdigit() or listed[-2].lower() in LINKING):
        return False  # As a system with x1 = φ, x = stretch s
    return _says(_PIECES.sub(" ", said), words)


def is_spoken(word: str, words: Words) -> bool:
    """Whether this is a word of a sentence and no name."""
    common = word.lower() in LINKING and (len(word) > 1 or word == "a")
    return is_common(word, words) if common else any(is_word(x, words) for x in word.split("."))


_DONE_TO_ALL = re.compile(r"\s*+[×·*:/÷|]\s*+[^\W_]\w{0,11}\s*+\Z")
"""What was done to the equations: × 6, : m."""
_UNITS = re.compile(r"\s*+(?:(?:all|everything)\s++)?(?:in\s++)?(?P<name>SI|MKS|CGS|cgs)(?:[ -]units?)?\s*+")
"""The units of all numbers."""
_SIGNS = re.compile(r"[-=+*/^()\[\]{}'’′″²³·×−\u0307\u0308\u20db]")


def says_nothing(text: str, words: Words) -> bool:
    """Whether a part of a line consists of words, or is a sentence that holds no statement, the terms are m l² θ''; a
    note tells one with numbers or products: friction 5 k."""
    units = _UNITS.fullmatch(text)
    if _DONE_TO_ALL.match(text) or (units is not None and not words.is_name(units["name"])):
        return True
    listed = re.findall(rf"{WORD_LETTER}+(?:['’-]{WORD_LETTER}+)*", text)
    spoken = [is_common(x, words) or is_word(x, words) for x in listed]
    sentence = "=" not in text and sum(spoken) > 1 and all(spoken[:2])
    if not sentence and (_SIGNS.search(text) or not any(is_word(x, words) for x in listed)):
        return False
    if (re.search(r"\d", text) or any(map(words.is_name, listed))) and not states_nothing(text, words):
        words.names.notes.setdefault(f"'{' '.join(text.split())}' was not judged: it has no equals sign.")
    return True
