"""Along which axes the wrong components of a velocity are: those along which the fewest terms of them are wrong.

ṙ + R Ω cos ψ and r (ψ̇ + Ω) + R Ω sin ψ are along and across an arm, with one wrong term each: along fixed axes, with
sin(Ω t + ψ), no term of them would be right.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.said_wrongly import SaidWrongly, in_names_of
from lagrangian.check.reference import Reference

OF_AXES = ("component", "along")
"""The kinds of components of a velocity."""
MOST = 24
"""The most choices of axes that are compared."""


def nearest(truth: Reference, chosen: Sequence[tuple[SaidWrongly, ...]]) -> tuple[SaidWrongly, ...]:
    """Of choices of wrong definitions that explain the same, the first, or the one with other axes for the components
    in it along which fewer terms of them are wrong."""
    first = chosen[0]
    if not any(p.words.of.kind in OF_AXES for p in first):
        return first
    same = [c for c in chosen[:MOST] if _lines(c) == _lines(first) and _bodies(c) == _bodies(first)]
    return min(same, key=lambda c: sum(_differing(truth, p) for p in c)) if len(same) > 1 else first


def _lines(said: Sequence[SaidWrongly]) -> list[int]:
    return [id(p.line) for p in said]


def _bodies(said: Sequence[SaidWrongly]) -> list[object]:
    """The bodies of which definitions are components of velocities; of others, the definition itself."""
    return [p.words.of.owner if p.words.of.kind in OF_AXES else p for p in said]


def _differing(truth: Reference, said: SaidWrongly) -> int:
    """How many terms are in what is written or in what is right, and not in both."""
    written = in_names_of(truth, said.line)
    if written is None or said.right is None:
        return 0
    own, right = (Counter(sp.Add.make_args(bounded.expand(x))) for x in (written, said.right))
    return sum(((own - right) + (right - own)).values())
