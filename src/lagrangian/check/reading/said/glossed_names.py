"""A word in brackets behind the name that another one stands for, a = alpha (crank): it is no product of letters.

It is a word with which the system describes itself, where every letter may be a name of the system, too. Words in
brackets that tell several quantities of one letter apart are parts of their names, as coordinates are:

F(spring) = -k x, F(damper) = -b x'      F_spring = -k x, F_damper = -b x'
Q(x) = F, Q(theta) = 0                   Q_x = F, Q_theta = 0
"""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import islice

from lagrangian.check.reading.prose.words import function_of
from lagrangian.check.reading.traced_text import TracedText
from lagrangian.model import Model

_NAME = r"[^\W\d_]\w{0,23}+"
_GLOSSED = re.compile(
    rf"(?<![\w*/^+.=-])(?P<stated>{_NAME}[ \t]*+(?::=|=)[ \t]*+(?P<of>{_NAME}))[ \t]++\((?P<word>[^\W\d_]{{3,24}})\)"
    r"(?=[ \t]*+(?:[,;.]|$)|[ \t]++(?:and|und|et|with|mit)\b)",
    re.MULTILINE,
)
"""A name that stands for another one, and a word in brackets at the end."""
_WORD = re.compile(r"[^\W\d_]{3,24}")
_TOLD_APART = re.compile(
    r"(?<![\w\\])(?P<of>[^\W\d_][\d₀-₉]?\*?)[ ]?(?:\([ ]?(?P<round>[^\W\d_][\w-]{0,23}(?:[ ][\w-]{1,24}){0,3})[ ]?\)"
    r"|\[[ ]?(?P<square>[^\W\d_][\w-]{0,23}(?:[ ][\w-]{1,24}){0,3})[ ]?\])(?P<given>[ \t]*=(?![=>]))?"
)
"""A letter and words, or a name, in brackets behind it, perhaps with a value."""
_ENERGIES = frozenset("TVUEL")
MOST = 200
"""The most letters with words behind them that are looked at."""


def without_glosses_of_names(text: TracedText, model: Model, taken: Callable[[str], bool]) -> TracedText:
    """Return an answer in plain text without such words; ``taken`` says whether the system has a name."""

    def alone(match: re.Match[str]) -> str:
        described = taken(match["of"]) and not taken(match["word"]) and match["word"].lower() in words_of_system(model)
        return match["stated"] if described else match.group()

    return text.sub(_GLOSSED, alone)


def with_words_below(
    text: TracedText, moves: Callable[[str], bool], taken: Callable[[str], bool], *, exact: Callable[[str], bool]
) -> TracedText:
    """Return an answer in plain text in which words in brackets that tell quantities of one letter apart are indices.

    The letter is given values with two of them, each a word that the system has no name for, or a coordinate
    (``moves``); energies of parts, T(cart) = …, are read as they are. ``taken`` says whether a name may belong to the
    system, ``exact`` whether it is spelled so there.
    """
    found = [m for m in islice(_TOLD_APART.finditer(text.text), MOST) if m["of"].rstrip("*") not in _ENERGIES]
    told = {m: _told_apart(m["round"] or m["square"], moves, taken) for m in found}
    given: dict[str, set[str]] = {}
    for match, word in told.items():
        if match["given"] and word and _stands_first(match):
            given.setdefault(match["of"], set()).add(word)
    many = {of for of, words in given.items() if len(words) > 1}
    return text.edited(
        (m.start(), m.start("given") if m["given"] else m.end(), f"{m['of']}_{word}")
        for m, word in told.items()
        if m["of"] in many and word in given[m["of"]] and not exact(f"{m['of']}_{word}")
    )


def _told_apart(said: str, moves: Callable[[str], bool], taken: Callable[[str], bool]) -> str:
    """The index that what stands in brackets is; empty if it may be a factor or an argument."""
    if moves(said):
        return said
    words = re.findall(r"[^\W_]+", said)
    spoken = all(not taken(x) and function_of(x) is None for x in words if len(x) > 2)
    return "_".join(words) if spoken and any(len(x) > 2 for x in words) else ""


def _stands_first(match: re.Match[str]) -> bool:
    """Whether nothing but a label or words stands in front of a quantity that is given a value."""
    before = match.string[max(0, match.start() - 60) : match.start()].rpartition("\n")[2].rstrip(" \t")
    return not before or before[-1] in ",;:.)]•–—-" or re.search(r"(?<!\w)[^\W\d_]{3,}\Z", before) is not None


def words_of_system(model: Model) -> frozenset[str]:
    """The words of the names and descriptions of a system."""
    described = (x.description for x in (*model.coordinates, *model.parameters, *model.inputs))
    said = (*described, *(e.name for e in model.elements), model.name)
    return frozenset(x.lower() for part in said for x in _WORD.findall(part))
