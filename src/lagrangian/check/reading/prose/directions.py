"""Takes words of a direction off formulas, of which they are no factors: y = (r1 φ1 - r2 φ2)/2 down, N = m g up."""

from __future__ import annotations

import re
from itertools import islice

from lagrangian.check.reading.markup import blank
from lagrangian.check.reading.prose.words import Words, function_of

_MOST = 200
"""The most such words of an answer."""
_SLOPE = r"(?:the|an?)[ ](?:slope|incline|inclined[ ]plane|plane|hill|ramp|track|guide|wall|rail|rope)"
_WAY = (
    rf"(?:up|down|along)[ ]{_SLOPE}|(?:down|up|in|out|left|right|for|back|side)wards?|down|up|uphill|downhill"
    r"|(?:(?:to|towards?)[ ]the[ ])?(?:left|right)|sideways|inward|outward|(?:(?:counter|anti)[ -]?)?clockwise|c?cw"
    r"|horizontally|vertically|radially|tangentially"
    r"|nach[ ](?:unten|oben|links|rechts|innen|außen|vorne?|hinten)|(?:ab|auf|vor|rück|ein|aus|hangab|hangauf)wärts"
    r"|bergab|bergauf|im[ ]Uhrzeigersinn|(?:gegen[ ]den|entgegen[ ]dem)[ ]Uhrzeigersinn"
    r"|vers[ ](?:le[ ](?:bas|haut)|la[ ](?:gauche|droite)|l['’](?:avant|arrière|intérieur|extérieur))"
    r"|à[ ](?:gauche|droite)"
)
_ALONE = re.compile(_WAY, re.IGNORECASE)
_BEHIND = re.compile(
    r"(?P<before>[\w)\]'’′″²³½\u0307\u0308])(?P<said>[ \t]{1,8}"
    rf"(?:(?:pointing|positive|counted|directed|measured|acting)[ ])?(?P<way>{_WAY}))"
    r"(?=[ \t]*(?:[,;.:)][ \t]|[,;.:)]?$|(?:and|und|et|with|where|mit|wobei|avec|où)[ \t]))",
    re.MULTILINE | re.IGNORECASE,
)
_LAST = re.compile(r"[^\W\d][\w\u0307\u0308]{0,40}\Z")
_PART = re.compile(r"[;\n]|,(?!\d)")
_IS_ZERO = re.compile(r"\s*+\\?[^\W\d]\w{0,23}+[ \t]*+=[ \t]*+0[ \t]*+")
"""What is no equation with such a word behind it, but says where a name is 0: φ = 0 uphill."""
_LONGEST = 400
"""The most characters of a formula in front of such a word."""
_SHORT = 3
"""The most letters of such a word that may be a product: up, cw."""


def is_direction(said: str) -> bool:
    """Whether a text consists of words of a direction, downwards, which are no short name."""
    return _SHORT < len(said) <= _LONGEST and _ALONE.fullmatch(said.strip(" ,.;")) is not None


def without_directions(text: str, words: Words) -> str:
    """Return an answer in plain text without words of a direction right behind the value of a name or a side."""
    for match in islice(_BEHIND.finditer(text), _MOST):
        at = match.start("said")
        part = _PART.split(text[max(0, at - _LONGEST) : at])[-1]
        way = match["way"]
        if (
            "=" not in part
            or _IS_ZERO.fullmatch(part)
            or words.known(way)
            or (len(way) <= _SHORT and words.is_product(way))
        ):
            continue
        last = _LAST.search(part)
        if last is None or _is_read(last.group(), words):
            text = blank(text, *match.span("said"))
    return text


def _is_read(written: str, words: Words) -> bool:
    """Whether what stands in front of such a word is a name, a product or a function's argument, and no word."""
    return words.readable(written) or words.is_product(written) or function_of(written) is not None
