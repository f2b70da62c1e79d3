"""Reads the words behind a rate that say of which body it is: Ω = φ̇ arm, …; w = 2 phi' of the drum.

Only words of the system's own names and descriptions are such words.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from unicodedata import normalize

from lagrangian.check.reading.prose.words import function_of
from lagrangian.check.reading.traced_text import Edit, TracedText
from lagrangian.model import Model

_RATE = r"[^\W\d_][\u0307\u0308]?\w{0,15}+['’′]{0,2}"
_STATED = re.compile(
    rf"(?<![\w\\.*/^+−-])(?P<new>[^\W\d_]\w{{0,15}}+)[ \t]*+=(?P<value>[ \t]*+[-−]?[ ]?(?:\w{{1,15}}+[ *·]{{1,3}})?"
    rf"(?P<rate>{_RATE}))[ \t]++(?P<words>[^\W\d_]{{2,20}}+(?:[ \t]++[^\W\d_]{{2,20}}+){{0,4}})"
    r"[ \t]*+(?=[,;:)\n]|\.(?=\s|\Z)|\Z)"
)
_FILLING = frozenset(["of", "the", "is", "for", "its", "der", "die", "das", "des", "von", "du", "de", "la", "le"])
_WORD = re.compile(r"[^\W\d_]{3,20}")
_DOTS = re.compile("[\u0307\u0308'’′]")


def with_rates_of_bodies(written: TracedText, model: Model, taken: Callable[[str], bool]) -> TracedText:
    """Return an answer in plain text in which such a rate is a statement without the words; ``taken`` says whether a
    name belongs to the system."""
    edits: list[Edit] = []
    for match in _STATED.finditer(written.text):
        words = [x.lower() for x in match["words"].split() if x.lower() not in _FILLING]
        rated = _DOTS.search(normalize("NFD", match["rate"])) is not None
        if taken(match["new"]) or not rated or not taken(match["rate"]) or not words:
            continue
        if any(all(map(taken, x)) or taken(x) or function_of(x) is not None for x in words):
            continue  # a product of names without signs
        if not _words(model).issuperset(words):
            continue
        edits.append((match.start(), match.start("new"), "; "))
        edits.append((match.end("value"), match.end(), ";"))
    return written.edited(edits)


def _words(model: Model) -> frozenset[str]:
    """The words by which a system calls its bodies and elements, and of its descriptions."""

    def made() -> frozenset[str]:
        said = [getattr(x, "name", "") or "" for x in (*model.bodies, *model.elements)]
        said += [x.description or "" for x in (*model.coordinates, *model.parameters)]
        return frozenset(x.lower() for some in said for x in _WORD.findall(some))

    return model.remembered("words of bodies", made)
