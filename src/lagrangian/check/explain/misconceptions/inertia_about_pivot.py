"""J about the pivot is used in addition to ½mv² of the centre of mass: the same motion is counted twice."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients, Variant, put
from lagrangian.derive.sampling import CompiledExpressions, States
from lagrangian.model import time
from lagrangian.page.formula import text

STEP = 2
WHY = text(
    "About which point is J given? If it is the centre of mass, the kinetic energy of its motion counts as well; J "
    "about a fixed axis already contains that."
)


def wrong(s: Ingredients) -> Iterator[Variant]:
    """For every rigid body, J + m d² about its pivot in addition to its ½mv²."""
    for body in s.bodies:
        omega = s.omega(body)
        if not omega:
            continue
        squared = sp.Add(*[w**2 for w in omega])
        for distance in arms(s, body):
            yield Variant(
                what=text(f"{body.title[:1].upper() + body.title[1:]} has J about its pivot and ½mv² as well."),
                T=s.expand(body.mass) * distance * squared / 2,
                element=body,
            )


def arms(s: Ingredients, body: object) -> list[sp.Expr]:
    """The squared distances of the centre of mass from points of attachment that are constant."""
    away = sp.Add(*[(a - b) ** 2 for a, b in zip(s.position(body), s.parent(body), strict=True)])
    slopes = [sp.Add(*[bounded.diff(x, q) ** 2 for x in s.position(body)]) for q in s.q]
    found: list[Any] = [_constant(s, d) for d in (away, *slopes)]
    return [d for d in dict.fromkeys(found) if d not in (0, 1, None)]


def _constant(s: Ingredients, expr: sp.Expr) -> sp.Expr | None:
    """The constant value of an expression; None if it is not constant."""
    slope = CompiledExpressions([bounded.diff(expr, time)]).at(States(s.model, 2))
    return put(expr, dict.fromkeys(s.q, sp.S.Zero)) if np.abs(slope).max() < 1e-9 else None
