"""Finds common words that letters of an answer spell, too, and that are no products: z as second coordinate;
products of which an answer says that they are some: mga = m·g·a; names of two equal letters: II phi''; and names of
forces that are a term: m x'' = Hx."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import islice

from lagrangian.check.reading.prose.splits import LONGEST
from lagrangian.check.reading.prose.words import Words, function_of
from lagrangian.check.reading.prose.words_or_mathematics import ARTICLES, LINKING

_TWO = re.compile(
    r"(?<![\\\w*/^+=-])(?P<word>[^\W\d_]{2,6})[ \t]++(?=(?P<next>[^\W\d_]{3,24})(?![\w'’′(*/^=]))", re.IGNORECASE
)
"""A short word with a longer one behind it, and no sign of mathematics beside them."""
_LED_BY = (
    "the|an?|each|our|its|of|from|at|on|in|by|for|der|die|das|den|dem|des|eine[mnrs]?|vom|am|im|beim|zum|du|au|une?|sur"
)
_NOUN = re.compile(
    rf"(?<![\\\w])(?:(?:{_LED_BY})[ \t]++){{1,3}}+(?P<word>[^\W\d_][a-zäöü]{{2,23}})(?=[ \t,.;:)]|['’]s\b|$)",
    re.IGNORECASE | re.MULTILINE,
)
"""A word behind an article or a preposition: at the drum u = r φ, position of the bar y = r cos φ."""
_COMPOUND = re.compile(
    r"(?<![\w\\*/^+=(-])(?P<first>[^\W\d_][a-zäöü]{2,23})[ ](?P<second>[a-zäöü]{3,24})(?![\w'’′(*/^])", re.MULTILINE
)
"""Two words beside each other: needle bar."""
_SUM_OF = re.compile(
    r"(?<![\\\w])(?P<word>sum|total|rate|somme|summe|mass|masse|length|damping|angle|slope|arm|radius|lever|moment)"
    r"(?=[ \t]+(?:of|de[rsm]?|du|aller|all)[ \t]+[^\W\d_]{3,24})",
    re.IGNORECASE,
)
"""What words add up, even behind an equals sign, and what a letter is: dD/dt = sum of moments; mo = mass of one oar."""
_SHORT = 3
"""The letters of a word that is no noun if it stands in mathematics anywhere."""
_SIGNS = "-+−*/^·×⋅="
_LETTER = re.compile(r"\w")
_FACTOR_BEHIND = re.compile(r"[ \t]?(?:[-+−*/^·×⋅²³][ \t]*[\w(]|\(|(?:sin|cos|tan|sqrt|exp))")
"""What stands behind a factor: a sign of mathematics, a bracket or a function."""
_VOWEL = re.compile(r"[aeiouyäöü]", re.IGNORECASE)
_SPELLED_OUT = re.compile(r"[ \t]{0,9}[^\W\d_](?:[ \t]?[·*×⋅][ \t]?[^\W\d_]){1,7}(?![ \t]?[\w·*×⋅/^+(-])")
_DOUBLED = re.compile(
    r"(?:[-=+*/(,;]|(?<!\w)\d{1,3}|^)[ \t]*+(?P<name>(?P<letter>[A-Za-z])(?P=letter))[ \t]?+"
    r"(?=[^\W\d]\w{0,23}+(?:['’′″]|[ \t]?+[(\[]))",
    re.MULTILINE,
)
"""A letter twice where a factor stands, in front of a rate or a function: 1/2 II ph'^2."""
_ALONE = re.compile(
    r"(?:[-=+−–][ \t]*+|[(\[,][ \t]*+(?=[^()\[\]=\n]{1,60}[)\]]))(?P<name>[A-Z][A-Za-z]{1,2}\d?)"
    r"(?=[ \t]*+(?:$|[-=+−–,;)\]]|\.(?:\s|$)))",
    re.MULTILINE,
)
"""A short name with a capital letter that is a whole term, or an entry of a list: m x'' = Hx - m g, (Hx, Hy)."""
_MOST = 500
"""The most pairs of words that are looked at."""


def spoken_words(text: str, words: Words) -> frozenset[str]:
    """Return the common words in an answer that stand in front of a word, and the words behind articles, which never
    stand beside an operator."""
    found = (m for m in islice(_TWO.finditer(text), _MOST) if m["word"].lower() in LINKING - ARTICLES)
    short = {m["word"] for m in found if not words.is_used(m["word"]) and _is_word(m["next"], words)}
    nouns = {m["word"] for m in islice(_NOUN.finditer(text), _MOST)} | set(_compounds(text, words))
    nouns = {x for x in nouns if _VOWEL.search(x) and not words.known(x) and not words.is_used(x)}
    short |= {m["word"] for m in islice(_SUM_OF.finditer(text), _MOST) if not words.known(m["word"])}
    return frozenset(short | {x for x in nouns if not function_of(x) and not _is_factor(x, text)})


def _compounds(text: str, words: Words) -> Iterator[str]:
    """The words beside a longer one that is neither a name nor a product."""
    at = 0
    for _ in range(_MOST):
        if (match := _COMPOUND.search(text, at)) is None:
            return
        pair = match["first"], match["second"]
        for one, other in (pair, pair[::-1]):
            if len(other) > _SHORT and other.lower() not in LINKING and _is_word(other, words):
                yield one
        at = match.start("second")


def _is_factor(word: str, text: str) -> bool:
    """Whether a word stands beside a sign of mathematics, a number or a function: + mga sin θ."""
    at = text.find(word) if len(word) <= LONGEST else -1
    while at >= 0:
        end, before = at + len(word), at
        while text[before - 1 : before] in (" ", "\t"):
            before -= 1
        sign = text[before - 1 : before]
        behind = sign in _SIGNS or (at - before < 2 and sign.isdecimal())
        if sign and behind and _LETTER.match(text, end) is None:
            return True
        if (at == 0 or _LETTER.match(text, at - 1) is None) and _FACTOR_BEHIND.match(text, end) is not None:
            return True
        at = text.find(word, at + 1)
    return False


def doubled_letters(text: str) -> dict[str, None]:
    """Return the names of two equal letters, which programs write for letters that mean something else to them: II."""
    return {m["name"]: None for m in _DOUBLED.finditer(text) if function_of(m["name"]) is None}


def terms_alone(text: str) -> dict[str, None]:
    """Return the short names with a capital letter that are whole terms or entries of lists, and so no words."""
    return {m["name"]: None for m in _ALONE.finditer(text) if function_of(m["name"]) is None}


def is_spelled_out(text: str, at: int, name: str) -> bool:
    """Whether the value at a place is the product of the letters of a name, with signs: mga = m·g·a."""
    value = _SPELLED_OUT.match(text, at)
    return value is not None and len(name) > 1 and re.sub(r"[^\w]", "", value.group()) == name


def _is_word(written: str, words: Words) -> bool:
    if written.lower() in LINKING:
        return True
    return function_of(written) is None and not words.readable(written) and not words.is_product(written)
