"""Derivatives of what an answer states by a coordinate of its own, dP/dα after α = π − θ, or dx/dα after x = l cos α:
written ∂P/∂α.

Where the system has a d, dP/dα would be d P/(d α), which nobody writes.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import islice

from lagrangian.check.reading.prose.words_or_mathematics import moves
from lagrangian.check.reading.traced_text import Edit, TracedText

_NAME = r"[^\W\d_][^\W²³]{0,15}+"
_SLOPE = re.compile(rf"(?<![^\W\d])d(?P<of>{_NAME})[ ]?/[ ]?d(?P<by>{_NAME})(?![\w²³'’′\u0307\u0308(])")
_STATED = r"(?<![\w\\/∂]){}[ \t]*=(?![=>])(?P<value>[^=,;\n]{{1,200}})"
_LETTERS = re.compile(r"[^\W\d_]\w{0,23}+")
MOST = 40
"""The most derivatives that are looked at."""


_TWO = r"(?:²|\^[ ]?(?:2|\(2\))|\*\*[ ]?2|2)"
_SECOND = re.compile(
    rf"(?<![^\W\d])(?P<d>[d∂])[ ]?{_TWO}[ ]?(?P<of>{_NAME})(?:\([ ]?[^\W\d_]\w{{0,15}}[ ]?\))?"
    rf"[ ]?/[ ]?(?P<open>\()?[d∂][ ]?(?P<by>[^\W\d_][^\W²³]{{0,15}}?)[ ]?{_TWO}(?(open)[ ]?\))"
    r"(?![\w²³'’′\u0307\u0308(])"
)
"""A second derivative by one name: d²l/dθ², ∂^2 V/∂θ^2, d2l/dtheta2."""


_TWICE_OF = re.compile(
    rf"(?<![^\W\d])(?P<d>[d∂])[ ]?{_TWO}[ ]?/[ ]?[d∂][ ]?(?P<by>[^\W\d_][^\W²³]{{0,15}}?)[ ]?{_TWO}[ ]?"
    rf"(?P<open>\()?[ ]?(?P<of>{_NAME})(?(open)[ ]?\)|(?=[ ]{{0,3}}(?:=|\))))(?![\w²³'’′\u0307\u0308(])"
)
"""The same with an operator, in brackets or alone on its side: d²/dθ² l = …."""


def with_second_derivatives(
    text: TracedText, coordinate: Callable[[str], bool], taken: Callable[[str], bool]
) -> TracedText:
    """Return a plain text in which second derivatives by coordinates are written ∂²l/∂θ²."""

    def round_signs(match: re.Match[str]) -> str:
        factors = match["d"] == "d" and taken(f"d{match['of']}")
        fits = coordinate(match["by"]) and not coordinate(match["of"]) and not factors
        return f"∂²{match['of']}/∂{match['by']}²" if fits else match.group()

    return text.sub(_SECOND, round_signs).sub(_TWICE_OF, round_signs)


def with_own_derivatives(
    text: TracedText, coordinate: Callable[[str], bool], taken: Callable[[str], bool]
) -> TracedText:
    """Return a plain text in which the derivative of a name by such a coordinate has round signs.

    ``coordinate`` says whether a name is one of the system's coordinates, ``taken`` whether the system has a name.
    """
    edits: list[Edit] = []
    for match in islice(_SLOPE.finditer(text.text), MOST):
        of, by = match["of"], match["by"]
        if taken(by) or coordinate(of) or by == "t" or of in ("Q", "Ξ", "Xi"):
            continue
        stated = re.search(_STATED.format(re.escape(by)), text.text)
        own = stated is not None and not moves(stated["value"])
        own = own and any(map(coordinate, _LETTERS.findall(stated["value"] if stated else "")))
        value = re.search(_STATED.format(re.escape(of)), text.text)
        made = value is not None and by in _LETTERS.findall(value["value"])  # x = L cos α: dx/dα
        if made or (own and (taken(of) or value is not None)):
            edits.append((*match.span(), f"∂{of}/∂{by}"))
    return text.edited(edits)
