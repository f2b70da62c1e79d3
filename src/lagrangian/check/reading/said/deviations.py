"""Reads deviations from a position at rest: φ = φ0 + φ1 or p = φ − φ0 with a constant φ0, which is not φ, and
τ = τ0 + τ1.

The deviation of an input is the input less its constant: τ = τ0 + τ1 is τ1 = τ − τ0.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from itertools import islice

from lagrangian.check.reading.traced_text import Edit, TracedText, apart
from lagrangian.read.letters import key

MOST = 20
"""The most such sums."""

_INDEX = r"_?\{?\w{1,6}\}?"
_LETTER = r"\\?[^\W\d_]\w{0,11}"
_BEGINS = r"(?<![\w\\'’′^*/+−-])"
_WORDS = r"(?:and|und|with|mit|be|are|is|from|as|for|where|denotes?)\b|\([^\W\d_]{1,16}[ ][a-z]{2}"
_ENDS = rf"(?![\w'’′(*/^·{{])(?=[ \t]*(?:[.,;:)$&]|\\|\n|\Z|{_WORDS}))"
_SUM = re.compile(
    rf"{_BEGINS}(?P<of>{_LETTER}?)[ \t]*&?=[ \t]*(?P<rest>(?P=of){_INDEX})[ \t]*\+[ \t]*"
    rf"(?P<more>(?:\\?[Δδ]|\\?[dD]elta[ ]?_?)?{_LETTER}){_ENDS}"
)
"""A quantity as the sum of its value at rest, of the same letter, and its deviation."""
_DIFFERENCE = re.compile(
    rf"{_BEGINS}(?P<more>{_LETTER})[ \t]*&?:?=[ \t]*(?P<of>{_LETTER}?)[ \t]*[-−][ \t]*(?P<rest>(?P=of){_INDEX}){_ENDS}"
)
"""A deviation as the quantity less its value at rest."""


def with_deviations(written: TracedText, moves: Callable[[str], bool], drives: Callable[[str], bool]) -> TracedText:
    """Return an answer in which the deviations of inputs, and those with letters of their own, are stated by
    themselves; ``moves`` says what a coordinate is, and ``drives`` what an input is."""
    edits: list[Edit] = []
    for match in islice(_SUM.finditer(written.text), MOST):
        of, own = _bare(match["of"]), not _bare(match["more"]).startswith(_bare(match["of"]))
        if match["more"] != match["of"] and (drives(of) or (moves(of) and own)):
            edits.append((*match.span(), f"{match['more']} = {match['of']} - {match['rest']}"))
    return written.edited(apart(edits))


def constants_of_deviations(text: str) -> Iterator[str]:
    """The names of the constants in such sums and differences: φ0 of φ = φ0 + φ1."""
    for match in (*islice(_SUM.finditer(text), MOST), *islice(_DIFFERENCE.finditer(text), MOST)):
        if key(_bare(match["rest"])) != key(_bare(match["of"])):
            yield _bare(match["rest"])


def _bare(name: str) -> str:
    return re.sub(r"[\\{}]", "", name)
