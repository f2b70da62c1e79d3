"""Takes sides in words out of chains: m x'' = spring + friction = -k x - d x' says what its terms are."""

from __future__ import annotations

import re
from itertools import pairwise

from lagrangian.check.reading.markup import blank
from lagrangian.check.reading.prose.words import Words, function_of

_SIDES = re.compile(r"(?<![<>=:!])=(?![=>])")
_SAID = re.compile(
    r"[\s+\-−–,.]*+[^\W\d_][^\W\d_\s+\-−–,.]*+(?:[\s+\-−–,.]++[^\W\d_][^\W\d_\s+\-−–,.]*+)*+[\s+\-−–,.]*+"
)
"""Words with nothing but signs of sums between them."""
_WORD = re.compile(r"[^\W\d_]+")
_PHRASE = re.compile(r"[^\W\d_]{2,}[ \t]+[^\W\d_]")
_SENTENCE = re.compile(r"(?:[^\W\d_]{2,}[ \t]+){2}[^\W\d_]")
"""Three words in a row, which the answer may well say elsewhere too: sum of moments about H."""
_SHORTEST = 4
"""The fewest letters of a word; shorter ones are names but in a phrase."""

_LAST = re.compile(
    r"=[ \t]*+(?:[^\W\d_]{2,4}[ \t]++){0,3}(?P<word>(?:[Mm]oment|torque|force|Kraft|Kräfte)s?e?)[ \t.]*+\Z"
)
"""A last side that says only what it is: J_P θ'' = moment."""


def ends_in_a_word(row: str, words: Words) -> bool:
    """Whether the last side of a statement only says what it is, in a word that nothing else explains."""
    last = _LAST.search(row)
    return last is not None and words.count(last["word"]) == 1 and not words.names.known(last["word"])


def without_sides_in_words(row: str, words: Words) -> str:
    """Return a statement with at least three sides without those in words, if two others are left."""
    ends = [*(m.start() for m in _SIDES.finditer(row)), len(row)]
    inside = [(a, b) for a, b in pairwise(ends) if _is_said(row[a + 1 : b], words)]
    if not inside or len(ends) - len(inside) < 2:
        return row
    for a, b in inside:
        row = blank(row, a, b)
    return row


def _is_said(side: str, words: Words) -> bool:
    """Whether a side consists of words that are no names, not even of the answer's own."""
    if _SAID.fullmatch(side) is None:
        return False
    said = _WORD.findall(side)
    long = [x for x in said if len(x) >= _SHORTEST]
    phrase = _SENTENCE.search(side) is not None
    phrase = phrase or (_PHRASE.search(side) is not None and not any(map(words.is_own, said)))
    own = (
        words.names.known(x)
        or function_of(x) is not None
        or words.is_used(x)
        or (not phrase and words.count(x) > said.count(x))
        for x in long
    )
    if not long or any(own) or any(words.is_product(x) for x in long):
        return False
    return len(long) == len(said) or (
        _PHRASE.search(side) is not None and not any(words.names.scope.meanings(x)[0] for x in said)
    )
