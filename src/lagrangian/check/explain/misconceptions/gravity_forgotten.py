"""Gravity is left out of V."""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from lagrangian.check.explain.misconceptions.base import Ingredients, Variant
from lagrangian.page.formula import Name, text

STEP = 3
WHY = text("V includes the potential energy of every weight: does its height change?")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Drop all weights, then that of every single body."""
    weights = list(s.weights())
    if len(weights) > 1:
        total = sp.Add(*[V for _, _, V in weights])
        yield Variant(what=text("Gravity is missing in ", Name("V"), "."), V=-total, element=weights[0][0])
    for gravity, body, V in weights:
        yield Variant(
            what=text(f"The weight of {body.title} is missing in ", Name("V"), "."),
            V=-V,
            element=gravity,
            body=body.title,
        )
