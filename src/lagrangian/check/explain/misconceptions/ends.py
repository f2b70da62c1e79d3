"""The two ends of a pair of forces, as in the box rule."""

from __future__ import annotations

from collections.abc import Iterator

from lagrangian.check.explain.misconceptions.base import Ingredients
from lagrangian.derive.ends import find_ends
from lagrangian.model import DEFLECTION, Action, Element


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
    is no reaction."""
    acts_on = {end.on for end in s.kept(("ends", element), lambda: find_ends(s.model, element)) if end.rate != 0}
    return len(acts_on) == 1 and acts_on.isdisjoint({DEFLECTION})
