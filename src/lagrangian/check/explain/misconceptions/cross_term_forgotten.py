"""The cross term of a square is forgotten: a² + b² for (a + b)²."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import sympy as sp

from lagrangian.check.explain.misconceptions.base import Ingredients, Variant
from lagrangian.page.formula import Name, text

STEP = 2
WHY = text("A sum is squared as a whole, not part by part, and velocities add before they are squared.")


def wrong(s: Ingredients) -> Iterator[Variant]:
    """Drop the products of different rates for every body, and for all; with and without the rotation."""
    every = sp.S.Zero
    for body in s.bodies:
        translation, rotation = _cross(s, body)
        what = text(
            f"The velocities of {body.title} were squared one by one: the cross term is missing in ", Name("T*"), "."
        )
        for cross in dict.fromkeys((translation + rotation, translation, rotation)):
            if cross != 0:
                yield Variant(what=what, T=-cross, element=body)
        every += translation + rotation
    if every != 0 and len(s.bodies) > 1:
        yield Variant(what=text("The cross terms of the velocities are missing in ", Name("T*"), "."), T=-every)


def _cross(s: Ingredients, body: Any) -> tuple[sp.Expr, sp.Expr]:
    """The terms of ½mv² and ½Jω² with products of different rates: Σ_{j<k} ∂²T/∂ξ̇_j∂ξ̇_k ξ̇_j ξ̇_k."""
    translation: list[sp.Expr] = []
    rotation: list[sp.Expr] = []
    for j in range(s.n):
        for k in range(j + 1, s.n):
            moved, turned = s.coupling(body, j, k)
            translation.append(moved * s.v[j] * s.v[k])
            rotation.append(turned * s.v[j] * s.v[k])
    return sp.Add(*translation), sp.Add(*rotation)
