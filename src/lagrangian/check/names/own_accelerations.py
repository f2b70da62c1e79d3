"""Names that an answer gives to what has accelerations in it: a_u = x'' - e phi'' sin(phi), H = tau/R - J x''/R^2."""

from __future__ import annotations

from collections.abc import Sequence

from lagrangian.check.verdict import AnsweredLine
from lagrangian.model import Model
from lagrangian.read.letters import key


def own_accelerations(model: Model, lines: Sequence[AnsweredLine]) -> frozenset[str]:
    """The keys of the names that definitions give to expressions with accelerations."""
    moving = [c.acceleration for c in model.coordinates]
    return frozenset(key(str(x.name)) for x in lines if x.kind == "definition" and x.name and x.expr.has(*moving))
