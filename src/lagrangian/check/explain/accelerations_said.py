"""The accelerations that an answer may say: of bodies along fixed axes and along those that turn, and angular ones."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions import Ingredients
from lagrangian.check.explain.sayable import Effect, Sayable, pushing
from lagrangian.check.explain.turned_axes import turned_accelerations
from lagrangian.model import RigidBody
from lagrangian.page.formula import Left

LONGEST_VELOCITY = 120
"""The largest number of operations of a velocity whose acceleration is held against what an answer says."""


def sayable_accelerations(s: Ingredients) -> Iterator[Sayable]:
    """The components of accelerations, and angular accelerations: another one adds m (a − a₀) ∂r/∂ξ_i to each row."""
    for b in s.bodies:
        if bounded.operations(*s.velocity(b)) > LONGEST_VELOCITY:
            continue
        slopes = [[s.expand(b.mass) * bounded.diff(x, q) for q in s.q] for x in s.position(b)]
        every: list[tuple[tuple[str | Left, ...], sp.Expr, list[sp.Expr]]] = [
            ((f"{'xyz'[c]} component of the acceleration of {b.title}",), s.rate(v), slopes[c])
            for c, v in enumerate(s.velocity(b))
        ]
        for axes, x, axis in turned_accelerations(s, b):
            along = [sp.Add(*[a * y for a, y in zip(axis, of, strict=True)]) for of in zip(*slopes, strict=True)]
            every.append(((f"component of the acceleration of {b.title}", *axes), x, along))
        for words, right, along in every:
            yield Sayable("acceleration", b, words, right, partial(_accelerated, right, along))
        omega = s.omega(b) if isinstance(b, RigidBody) else ()
        for w in omega if len(omega) == 1 else ():
            right, slopes = s.rate(w), [s.expand(b.inertia[0]) * bounded.diff(w, v) for v in s.v]
            words = (f"angular acceleration of {b.title}",)
            yield Sayable("acceleration", b, words, right, partial(_accelerated, right, slopes))


def _accelerated(right: sp.Expr, slopes: Sequence[sp.Expr], said: sp.Expr) -> Effect:
    return pushing(sp.Add(said, -right), slopes)
