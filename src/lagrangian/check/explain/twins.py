"""Pairs of equal bodies, such as two panels: whatever is said of "a panel" is said of both."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

from lagrangian.check.explain.misconceptions import Ingredients
from lagrangian.model import RigidBody

_DIGITS = re.compile(r"\d+|\b[A-Z]\b")
"""The numbers or letters by which the names of equal bodies differ."""


def twins(s: Ingredients) -> Iterator[tuple[Any, Any]]:
    """The pairs of bodies with the same mass and moments of inertia whose names differ by a number or a letter, bucket
    A and bucket B, or by the word before what they are: port oar and starboard oar."""
    seen: dict[tuple[Any, ...], Any] = {}
    for b in s.bodies:
        inertia = tuple(map(s.expand, b.inertia.flat())) if isinstance(b, RigidBody) else ()
        words = b.name.split()
        if _DIGITS.search(b.name) is not None or len(words) > 1:
            called = _DIGITS.sub("#", b.name) if _DIGITS.search(b.name) is not None else words[-1]
            key = (called, s.expand(b.mass), inertia)
            if (first := seen.get(key)) is not None:
                yield first, b
            seen.setdefault(key, b)
