"""Words that say which quantity of motion an expression is: "velocity of the slider along the rod: ṙ + R Ω sin θ"."""

from __future__ import annotations

import re

import sympy as sp
from lark import Tree
from sympy.matrices.matrixbase import MatrixBase

from lagrangian import bounded
from lagrangian.check.reading.answer import AnswerLine
from lagrangian.check.reading.line_forms import made_line
from lagrangian.check.reading.meaning import Meaning
from lagrangian.check.reading.names import Names, Value
from lagrangian.check.reading.prose.words import function_of
from lagrangian.check.reading.traced_text import Edit, TracedText
from lagrangian.model import Kinetic

LONGEST = 100
"""The largest number of characters of such words."""
_NOUNS = {
    "turning": r"angular[ ](?:velocity|velocities|speeds?|rates?)|winkelgeschwindigkeit(?:en)?",
    "speed component along": r"velocity|velocities|speeds?|geschwindigkeit(?:en)?",
    "deflection": r"deflection|elongation|extension|stretch|verlängerung|auslenkung",
    "position height": r"heights?|höhen?",
    "position apart": r"positions?|coordinates?|distances?|abstand",
}
_NOUN = re.compile(r"\b(?:" + "|".join(f"({x})" for x in _NOUNS.values()) + r")\b", re.IGNORECASE)
_VALUE = re.compile(
    r"[ \t]*+(?:[-*•+–][ \t]++)?(?P<label>[^\W\d_][\w ()'’/-]{1,40}?):[ \t]++"
    r"(?:(?P<zero>0)|(?P<entries>[^,;:=|\n]{1,120}(?:,[^,;:=|\n]{1,120}){1,2}))[ \t.]*+"
)
"""An item of such a list: a zero, or the entries of a column."""
MOST_WORDS = 4
"""The most words of a label before the place of a point or a body."""
_WORDS = re.compile(r"[A-Za-z]{4,20}")
_ENCLOSED = re.compile(r"[(\[][^()\[\]]{0,120},")
"""A comma within brackets."""
_LETTERS = re.compile(r"[^\W\d_]{1,20}")
_RELATIVE = re.compile(r"\b(?:relativ\w{0,6}|against|between|gegen|zwischen)\b", re.IGNORECASE)
_ACCELERATION = re.compile(r"\b(?:accelerations?|beschleunigung(?:en)?)\b", re.IGNORECASE)
_OTHER = re.compile(r"energy|force|moment|torque|power|work|energie|kraft|leistung", re.IGNORECASE)
"""Words of other quantities, in which a velocity may be named beside."""
_ENDS = re.compile(r"[=;|]")
_ITEM = re.compile(r"[ \t]*+(?:[-*•+–][ \t]++)?[^\W\d_][\w ,()'’/-]{1,40}?:(?=[ \t]+\S)|[ \t]*+[-*•+–][ \t]++\S")
"""An item of a list, or a label with what it says."""


def kinds_of_words(words: str) -> tuple[str, ...]:
    """The kinds of quantities that words may mean; what is relative is no velocity or place of a body."""
    noun = _NOUN.search(words)
    if _ACCELERATION.search(words):
        return ("acceleration",) if noun is None and _OTHER.search(words) is None else ()
    if noun is None or noun.lastindex is None or _OTHER.search(words):
        return ()
    kinds = tuple([*_NOUNS][noun.lastindex - 1].split())
    return ("deflection", "rate") if _RELATIVE.search(words) else kinds


def headed(text: str) -> dict[int, str]:
    """The heading with such words above each item of a list of values, by the number of the item's line."""
    found: dict[int, str] = {}
    heading = ""
    for number, line in enumerate(text.split("\n"), 1):
        item = _ITEM.match(line)
        if item is not None:
            found |= {number: heading} if heading else {}
        elif line.strip():
            said = " ".join(line[:LONGEST].strip(" \t:-–—*#>").split())
            heading = said if _ENDS.search(line) is None and " " in said and kinds_of_words(said) else ""
    return found


def with_items(written: TracedText, text: str, names: Names) -> TracedText:
    """Return a plain text in which items below such headings are columns, or have a name where they are 0:

    lower centre: ½ l cos α α̇, −½ l sin α α̇      lower centre: (½ l cos α α̇, −½ l sin α α̇)
    vertical: 0                                 v_vertical = 0         (below a heading of velocities)

    The headings above the lines of the ``text``, as it was typed, are remembered in ``names``.
    """
    names.headed = headed(text)
    edits: list[Edit] = []
    at, headings = 0, headed(written.text)
    for number, line in enumerate(written.text.split("\n"), 1):
        value = _VALUE.fullmatch(line) if number in headings else None
        if value is not None and value["zero"] and "speed" in kinds_of_words(headings[number]):
            start, end = (at + x for x in value.span("zero"))
            edits.append((start, end, f"v_{_LETTERS.findall(value['label'])[0]} = 0"))
        elif value is not None and value["entries"] and _is_formula(value["entries"], names):
            start, end = (at + x for x in value.span("entries"))
            edits += [(start, start, "("), (end, end, ")")]
        at += len(line) + 1
    return written.edited(edits)


def _is_formula(text: str, names: Names) -> bool:
    """Whether entries of a column have no words but names and functions, and no commas of their own."""
    words = _WORDS.findall(text)
    return _ENCLOSED.search(text) is None and all(names.known(x) or function_of(x) is not None for x in words)


def labelled(value: Value, side: Tree, reader: Meaning, moving: bool) -> list[AnswerLine]:
    """The definitions that an expression, or the entries of a column, behind such words are, with them in place of a
    name; none behind others. Behind a label in a list, they are those of its heading and the label.

    Words of accelerations stand before what has accelerations, if it is ``moving``, and no others do.
    """
    place = reader.source.at(0)
    end = (place.column or 1) - 1
    before = _ENDS.split((place.text or "")[max(0, end - LONGEST) : end])[-1]
    words = " ".join(before.strip(" \t:-–—*#>").split())
    if heading := reader.names.headed.get(place.line or 0):
        words = f"{heading}, {words}"
    if _is_place(value, words, reader):
        words = f"position of {words}"
    kinds = kinds_of_words(words) if " " in words else ()
    if not kinds or (kinds == ("acceleration",)) != moving or (moving and value.free_symbols & _amounts(reader)):
        return []
    if isinstance(value, MatrixBase):
        entries = enumerate(value.flat(), 1)
        return [made_line("definition", None, x, f"{words}_{k}", side, side, reader) for k, x in entries]
    return [made_line("definition", None, value, words, side, side, reader)]


def _is_place(value: Value, words: str, reader: Meaning) -> bool:
    """Whether a label stands before a column of lengths that move, as the places of points and bodies are."""
    if not isinstance(value, MatrixBase) or value.shape != (reader.names.model.dimension, 1) or not words:
        return False
    if kinds_of_words(words) or _OTHER.search(words) or _ACCELERATION.search(words) or len(words.split()) > MOST_WORDS:
        return False
    model = reader.names.model
    places = [x for p in model.points for x in model.position(p)]
    letters = {x for place in places for x in bounded.letters(model.expand(place))}
    moving = {c.symbol for c in model.coordinates}
    listed = [model.expand(x) for x in value.flat()]
    held = {y for x in listed for y in bounded.letters(x)}
    return held <= letters and bool(held & moving) and not any(x.has(sp.Derivative) for x in listed)


def _amounts(reader: Meaning) -> set[sp.Basic]:
    """The masses and moments of inertia of the system, which are in no acceleration: with one, it is an equation."""
    model = reader.names.model
    given = (e.value for e in model.elements if isinstance(e, Kinetic))
    sizes = [*(x for b in model.bodies for x in (b.mass, *(y for row in b.tensor for y in row))), *given]
    letters = {x: size for size in map(sp.sympify, sizes) for x in size.free_symbols}
    return {x for x, size in letters.items() if not bounded.diff(size, x).has(x)}
