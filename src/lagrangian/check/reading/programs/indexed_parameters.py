"""Writes parameters that Maple indexes, m[1] and J[S], as the system spells them: m1, J_S."""

from __future__ import annotations

import re
from collections.abc import Sequence

from lagrangian.check.reading.traced_text import TracedText
from lagrangian.read.letters import key

_MAPLE = re.compile(r":=|(?<!\w)diff\(")
_INDEXED = re.compile(r"(?<![\w\])])(?P<name>[^\W\d_]{1,8})\[(?P<index>[^\W_]{1,3})\](?!\[)")

MOST = 40
"""The most names that are looked at."""


def with_indexed_parameters(written: TracedText, parameters: Sequence[str]) -> TracedText:
    """Return an answer in which names in square brackets belong to their parameters.

    A name with an index that no parameter has is a list of the answer's own, as is one that stands alone: q[1] of q.
    """
    text = written.text
    if _MAPLE.search(text) is None:
        return written
    known = {key(p): p for p in parameters}
    found: dict[str, list[str | None]] = {}
    for match in _INDEXED.finditer(text):
        found.setdefault(match["name"], []).append(known.get(key(f"{match['name']}_{match['index']}")))
    if len(found) > MOST:
        return written
    own = {x for x, said in found.items() if None in said or re.search(rf"(?<!\w){x}(?![\w\[(])", text)}

    def spelled(match: re.Match[str]) -> str:
        name = match["name"]
        return match.group() if name in own else known[key(f"{name}_{match['index']}")]

    return written.sub(_INDEXED, spelled)
