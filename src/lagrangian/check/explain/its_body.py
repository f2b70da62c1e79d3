"""Of which body a wrong definition is, where the same would be wrong for several: X2 of the one whose place Y2 is.

Where nothing tells, the words leave it open: the x coordinate of the upper link or of the lower link.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from lagrangian.check.explain.said_wrongly import SaidWrongly, right_quantities
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine

_AXIS = re.compile(r"(?P<before>v_?)?(?P<axis>[xyz])_?(?P<index>\w{1,12})", re.IGNORECASE)
"""The name of a coordinate or of a component of a velocity with what it belongs to."""


def of_its_body(truth: Reference, lines: Sequence[AnsweredLine], said: Sequence[SaidWrongly]) -> SaidWrongly:
    """What one definition has wrong, where ``said`` are several quantities that lead to the same: that of the body of
    which other definitions with the same index are right; the first, with the others that are alike, if none tells."""
    first = said[0]
    owners = _owners_beside(truth, lines, first.line)
    mine = [p for p in said if p.words.of.owner in owners] if len(said) > 1 else []
    first = mine[0] if mine else first
    right = first.words.of
    alike = [
        p.words.of.owner for p in said if not mine and p.words.of.kind == right.kind and p.words.of.right == right.right
    ]
    others = [x for x in dict.fromkeys(alike) if x is not None and x is not right.owner]
    return replace(first, others=tuple(x.title for x in others))


def _owners_beside(truth: Reference, lines: Sequence[AnsweredLine], line: AnsweredLine) -> list[Any]:
    """The bodies of which all other coordinates with the same index are right."""
    own = _AXIS.fullmatch(line.name or "")
    found: list[list[Any]] = []
    for x in lines if own is not None else ():
        other = _AXIS.fullmatch(x.name or "") if x.kind == "definition" and x is not line else None
        if own is None or other is None or (other["index"], other["before"]) != (own["index"], own["before"]):
            continue
        if right := right_quantities(truth, x, but=True):
            found.append([q.owner for q in right])
    return [x for x in found[0] if all(x in every for every in found)] if found else []
