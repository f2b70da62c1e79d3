"""Reads the name that a chain gives a factor behind it: p = (m l² + M a² cos² θ) θ̇ =: I(θ) θ̇ says what I(θ) is."""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import islice

from lagrangian.check.reading.traced_text import TracedText

MOST = 20
"""The most such chains that are looked at."""

_NAME = r"[^\W\d]\w{0,15}+"
_CHAIN = re.compile(
    r"=[ \t]{0,3}(?P<factor>\((?:[^()\n=]|\([^()\n=]{0,80}\)){1,300}\))"
    r"(?P<rest>[ \t]{0,3}[·*]?[ \t]{0,3}[^\s()=+−-][^()\n=+−-]{0,40}?)"
    rf"(?P<said>[ \t]{{1,4}}=[ \t]{{1,3}}(?P<new>{_NAME})(?P<of>\([ ]?{_NAME}[ ]?\))?(?P<again>[^()\n=+−-]{{1,50}}))"
    r"(?=[ \t]*[.,;]?[ \t]*$)",
    re.MULTILINE,
)
_SIGNS = re.compile(r"[\s·*.,;]")


def with_factors_named_behind(written: TracedText, taken: Callable[[str], bool]) -> TracedText:
    """Return an answer in plain text in which such a name is stated by itself behind the chain.

    The same stands behind the factor and behind its name, which is none of the system and has no other value; ``taken``
    says whether a name belongs to the system.
    """
    text, edits = written.text, []
    for match in islice(_CHAIN.finditer(text), MOST):
        new, of = match["new"], match["of"] or ""
        same = _SIGNS.sub("", match["rest"]) == _SIGNS.sub("", match["again"]) != ""
        stated = re.search(rf"(?<!\w){new}[ \t]*(?:\([^()\n]{{1,20}}\)[ \t]*)?:?=(?!=)", text)
        if same and not taken(new) and stated is None:
            edits.append((*match.span("said"), f"; {new}{of} = {match['factor']}"))
    return written.edited(edits)
