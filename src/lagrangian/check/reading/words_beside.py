"""What the words of a line say of its statements: that they are about rest or special motions alone."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from lagrangian.check.reading.prose.remark_words import CASES, CHECKS, REST, SPECIAL
from lagrangian.check.reading.prose.remarks import accelerates_in

_BRACKETED = re.compile(r"\((?P<inside>[^()=\n]{1,80}=[^()=\n]{1,60})\)[.,;]?[ \t]*$")
"""A relation in brackets at the end of a sentence."""
_SENTENCE = 200
"""The most characters of a sentence in front of a bracket."""
_WORD = re.compile(r"[^\W\d_]{2,}")
_FEWEST_WORDS = 2
"""Fewer words are no sentence."""
_SENTENCE_WORDS = 7
"""The fewest words of a sentence in which one word is enough to say what it is about."""
_GOES_ON = re.compile(
    r"(?:[:,]|\b(?:reads?|becomes?|gives?|yields?|means?|get|is|are|lautet|lauten|ergibt|folgt|with|mit))[ \t]*\Z"
)
"""What ends a line whose sentence goes on below."""


def words_beside(lines: Sequence[str]) -> Iterator[frozenset[str]]:
    """Of every line, which of these words say of its statements: "rest", and "aside" and "special" for special motions,
    in brackets and in sentences.

    What is said of rest holds for the lines below whose sentence goes on, up to a blank line or an acceleration.
    """
    resting = False
    for line in lines:
        accelerates = accelerates_in(line)
        if not line.strip() or accelerates:
            resting = False
        said = {"rest"} if REST.search(line) or resting else set[str]()
        resting = resting or ("rest" in said and _GOES_ON.search(line.rstrip()) is not None)
        if "(" in line and not accelerates and _is_aside(line):
            said.add("aside")
        if not accelerates and _is_special(line):
            said.add("special")
        yield frozenset(said)


def _is_special(line: str) -> bool:
    """Whether a sentence with a formula is about a special motion or a check, as a word of it says."""
    words = [x.lower() for x in _WORD.findall(line)] if "=" in line else []
    return len(words) >= _SENTENCE_WORDS and bool((CASES | CHECKS).intersection(words))


def _is_aside(line: str) -> bool:
    """Whether a line ends in a relation in brackets that is about special motions, as its words say: its determinant is
    zero (rigid body motion: y = R φ); no friction if they turn together (θ′ = −x′/R)."""
    relation = _BRACKETED.search(line)
    if relation is None:
        return False
    said = line[max(0, relation.start() - _SENTENCE) : relation.end()]
    return len(_WORD.findall(said)) > _FEWEST_WORDS and SPECIAL.search(said) is not None
