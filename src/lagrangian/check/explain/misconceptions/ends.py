"""The two ends of a pair of forces, as in the box rule."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients
from lagrangian.derive.ends import find_ends
from lagrangian.model import DEFLECTION, Action, Body, Element


def both_ends(s: Ingredients, element: Element) -> Iterator[tuple[Action, Action]]:
    """Yield (one end, the other) and the reverse, if an element acts on two things that move."""
    ends = [a for a in s.kept(("ends", element), lambda: find_ends(s.model, element)) if a.rate != 0]
    groups: dict[object, list[Action]] = {}
    for end in ends:
        groups.setdefault(end.on, []).append(end)
    if len(groups) == 2 and all(len(g) == 1 for g in groups.values()):
        (a,), (b,) = groups.values()
        yield a, b
        yield b, a


def is_outer(s: Ingredients, element: Element) -> bool:
    """Whether an element acts on one thing alone, from outside: what it does to other coordinates that move this thing
    is no reaction. One that is given by its deflection does if this is the way of a body, x − s."""
    ends = [end for end in s.kept(("ends", element), lambda: find_ends(s.model, element)) if end.rate != 0]
    if len({end.on for end in ends}) != 1:
        return False
    return ends[0].on != DEFLECTION or any(_is_way_of(s, b, ends) for b in s.model.bodies)


def _is_way_of(s: Ingredients, body: Body, ends: Sequence[Action]) -> bool:
    """Whether a deflection changes as fast as a body moves."""
    square = sum((s.expand(v) ** 2 for v in s.velocity(body)), sp.S.Zero)
    return len(ends) == 1 and bounded.trigsimp(bounded.expand(square - s.expand(ends[0].rate) ** 2)) == 0
