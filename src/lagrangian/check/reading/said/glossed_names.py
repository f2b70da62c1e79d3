"""A word in brackets behind the name that another one stands for, a = alpha (crank): it is no product of letters.

It is a word with which the system describes itself, where every letter may be a name of the system, too.
"""

from __future__ import annotations

import re
from collections.abc import Callable

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


def without_glosses_of_names(text: TracedText, model: Model, taken: Callable[[str], bool]) -> TracedText:
    """Return an answer in plain text without such words; ``taken`` says whether the system has a name."""

    def alone(match: re.Match[str]) -> str:
        described = taken(match["of"]) and not taken(match["word"]) and match["word"].lower() in words_of_system(model)
        return match["stated"] if described else match.group()

    return text.sub(_GLOSSED, alone)


def words_of_system(model: Model) -> frozenset[str]:
    """The words of the names and descriptions of a system."""
    described = (x.description for x in (*model.coordinates, *model.parameters, *model.inputs))
    said = (*described, *(e.name for e in model.elements), model.name)
    return frozenset(x.lower() for part in said for x in _WORD.findall(part))
