"""Words that say which quantity of motion an expression is: "velocity of the slider along the rod: ṙ + R Ω sin θ"."""

from __future__ import annotations

import re

from lark import Tree

from lagrangian.check.reading.answer import AnswerLine
from lagrangian.check.reading.line_forms import made_line
from lagrangian.check.reading.meaning import Meaning
from lagrangian.check.reading.names import Value

LONGEST = 100
"""The largest number of characters of such words."""
_NOUNS = {
    "turning": r"angular[ ](?:velocity|speed|rate)|winkelgeschwindigkeit",
    "speed component along": r"velocity|speed|geschwindigkeit",
    "deflection": r"deflection|elongation|extension|stretch|verlängerung|auslenkung",
    "position height": r"height|höhe",
    "position apart": r"position|coordinate|distance|abstand",
}
_NOUN = re.compile(r"\b(?:" + "|".join(f"({x})" for x in _NOUNS.values()) + r")\b", re.IGNORECASE)
_RELATIVE = re.compile(r"\b(?:relativ\w{0,6}|against|between|gegen|zwischen)\b", re.IGNORECASE)
_OTHER = re.compile(r"energy|force|moment|torque|power|work|accelerat|energie|kraft|leistung", re.IGNORECASE)
"""Words of other quantities, in which a velocity may be named beside."""
_ENDS = re.compile(r"[=;|]")


def kinds_of_words(words: str) -> tuple[str, ...]:
    """The kinds of quantities that words may mean; what is relative is no velocity or place of a body."""
    noun = _NOUN.search(words)
    if noun is None or noun.lastindex is None or _OTHER.search(words):
        return ()
    kinds = tuple([*_NOUNS][noun.lastindex - 1].split())
    return ("deflection", "rate") if _RELATIVE.search(words) else kinds


def labelled(value: Value, side: Tree, reader: Meaning) -> list[AnswerLine]:
    """The definition that an expression behind such words is, with them in place of a name; none behind others."""
    place = reader.source.at(0)
    end = (place.column or 1) - 1
    before = _ENDS.split((place.text or "")[max(0, end - LONGEST) : end])[-1]
    words = " ".join(before.strip(" \t:-–—*#>").split())
    if " " not in words or not kinds_of_words(words):
        return []
    return [made_line("definition", None, value, words, side, side, reader)]
