"""Reads in words how a body moves by a coordinate of the answer's own: the drum turns by psi/n.

psi = angle of the motor (so the drum turns by psi/n)          phi = psi/n, where phi is described as the drum's
"""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import islice

from lagrangian.check.reading.traced_text import Edit, TracedText
from lagrangian.model import Model

MOST = 20
"""The most such sentences that are read."""

_NAME = r"\\?[^\W\d_][\w]{0,15}"
_TURNS = re.compile(
    r"\((?:(?:so|and|where|thus|hence|then|also)[ ](?:that[ ])?)?(?:the[ ]|die[ ]|der[ ]|das[ ]|le[ ]|la[ ])?"
    r"(?P<noun>[^\W\d_]{3,20})[ ](?:then[ ]|itself[ ]|itself[ ]then[ ])?"
    r"(?:turns|rotates|moves|rises|sinks|dreht[ ]sich|dreht|bewegt[ ]sich|tourne)[ ](?:by|with|through|um|mit|de)[ ]"
    rf"(?P<by>{_NAME}(?:[ ]?[/*·][ ]?{_NAME}|[ ]{_NAME})?)(?P<close>[ ]?[.)])",
    re.IGNORECASE,
)


def with_turned_bodies(text: TracedText, model: Model, taken: Callable[[str], bool]) -> TracedText:
    """Return an answer in which such a sentence in brackets gives the coordinate of the body it names, if one
    coordinate alone is described with this noun, and the sentence has a name that the system does not have."""
    edits: list[Edit] = []
    for match in islice(_TURNS.finditer(text.text), MOST):
        noun = re.compile(rf"(?<!\w){re.escape(match['noun'])}(?!\w)", re.IGNORECASE)
        meant = [c.name for c in model.coordinates if noun.search(c.description)]
        new = [x for x in re.findall(_NAME, match["by"]) if not taken(x.lstrip("\\"))]
        if len(meant) == len(new) == 1:
            edits.append((*match.span(), f"({meant[0]} = {match['by']}{match['close']}"))
    return text.edited(edits)
