"""The height has the wrong sign: V = −m g h."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian.check.explain.misconceptions.base import Ingredients, Variant
from lagrangian.page.formula import Name, text

STEP = 3
WHY = text("The potential energy of a weight grows with its height, measured upwards from any fixed level.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Reverse all weights, then that of every single body."""
    weights = list(s.weights())
    if len(weights) > 1:
        total = sp.Add(*[V for _, _, V in weights])
        yield Variant(
            what=text("Gravity has the wrong sign in ", Name("V"), ": lower is less, not more."),
            V=-2 * total,
            element=weights[0][0],
        )
    for gravity, body, V in weights:
        what = text(f"The weight of {body.title} has the wrong sign in ", Name("V"), ": lower is less, not more.")
        yield Variant(what=what, V=-2 * V, element=gravity, body=body.title)
