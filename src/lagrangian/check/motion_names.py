"""The names that equations with rates or accelerations are written in."""

from __future__ import annotations

import re
from collections.abc import Sequence

from lagrangian.check.reference import Reference
from lagrangian.check.verdict import AnsweredLine
from lagrangian.read.letters import key, undotted

WORD = re.compile(r"[^\W\d_][^\W_]*(?:_?\{?\w+\}?)?")


def names_of_motion(truth: Reference, lines: Sequence[AnsweredLine]) -> frozenset[str]:
    """The keys of all words in lines that hold a rate or an acceleration of the system and define no name."""
    moving = [x for c in truth.model.coordinates for x in (c.rate, c.acceleration)]
    others = (line for line in lines if line.kind != "definition" and line.expr.has(*moving))
    named = {key(undotted(w)[0]) for line in others for w in WORD.findall(line.text)}
    return frozenset(named | {key(w.translate(str.maketrans("", "", "{}"))) for w in named})
