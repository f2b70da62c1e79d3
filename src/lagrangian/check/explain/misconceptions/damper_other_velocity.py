"""A damper is given the velocity of another point, or that against the fixed axes, in place of its own rate."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import cast

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.misconceptions.base import Ingredients, Variant, put
from lagrangian.check.terms.signs import turned
from lagrangian.derive.algebra import OutOfReach
from lagrangian.derive.sampling import CompiledExpressions, States
from lagrangian.model import Body, Damper
from lagrangian.page.formula import text

STEP = 6
WHY = text("A damper feels how fast its own two ends move apart, not how fast the body that it is fixed to moves.")
WHY_LENGTH = text(
    "A damper feels how fast its own two ends move apart: differentiate their distance, with the inner derivative."
)
MOST_RATES = 12
"""The largest number of velocities that are tried for every damper."""
SHORT = 16
"""The largest number of operations of a rate that a sentence holds."""
LONGEST = 30
"""The largest number of operations of a velocity that somebody may write down."""


def wrong(s: Ingredients) -> Iterator[Variant]:
    """For every linear damper: ω or a component of the velocity of a body, its whole velocity, or ∂T*/∂ξ̇ divided by
    its inertia.

    Dampers with the same letter are changed together as well, each with its own ∂T*/∂ξ̇.
    """
    together: dict[sp.Expr, list[tuple[Damper, dict[int, sp.Expr], sp.Expr]]] = {}
    for element in s.acting:
        if not isinstance(element, Damper) or element.b is None:
            continue
        rate, b = bounded.expand(s.expand(element.rate(s.model))), s.expand(element.b)
        for other in _rates(s, rate):
            change = _changed(s, element, b * other**2 / 2)
            said = _in_sense(s, rate, other)
            right = ("; it is ", rate) if bounded.size(rate) <= SHORT else ()
            what = text(f"The rate of {element.title} is taken as ", said, *right, ".")
            if change:
                same = [v for v in s.v if rate.has(v)] == [v for v in s.v if other.has(v)]
                why = WHY_LENGTH if same and any(s.moves(bounded.diff(rate, v)) for v in s.v) else None
                yield Variant(what=what, Xi=change, element=element, why=why)
                if rate in s.v and other == _absolute(s, s.v.index(rate)):
                    together.setdefault(b, []).append((element, change, other))
        for body in s.bodies:
            square = _squared(s, body)
            change = _changed(s, element, b * square / 2) if square is not None else {}
            if change:
                what = text(f"The velocity of {element.title} is taken as the whole velocity of {body.title}.")
                yield Variant(what=what, Xi=change, element=element, doubt=1)
    for alike in together.values():
        if len(alike) > 1:
            yield _of_several(alike)


def _in_sense(s: Ingredients, rate: sp.Expr, other: sp.Expr) -> sp.Expr:
    """Another rate in the sense of the right one, for its square says nothing of it: ẏ for y ẏ/l, and not −ẏ."""
    slopes = [[bounded.diff(x, v) for v in s.v] for x in (rate, other)]
    product = sp.Add(*[a * b for a, b in zip(*slopes, strict=True)])
    values = CompiledExpressions([product]).at(States(s.model, 1))[0]
    return turned(other) if np.isfinite(values).all() and values.max() < 0 else other


def _of_several(alike: list[tuple[Damper, dict[int, sp.Expr], sp.Expr]]) -> Variant:
    """The same mistake in all dampers with one letter."""
    whole: dict[int, sp.Expr] = {}
    for _, change, _ in alike:
        for i, x in change.items():
            whole[i] = whole.get(i, sp.S.Zero) + x
    names = " and ".join(e.title for e, _, _ in alike)
    told = [x for k, (_, _, other) in enumerate(alike) for x in ((", ", other) if k else (other,))]
    what = text(f"The velocities of {names} are taken against the fixed axes: ", *told, ".")
    return Variant(what=what, Xi=whole)


def _rates(s: Ingredients, rate: sp.Expr) -> list[sp.Expr]:
    """The velocities that are taken for a rate."""
    found = [x for body in s.bodies for x in (*s.omega(body), *s.velocity(body))]
    if rate in s.v:
        i = s.v.index(rate)
        along = (x for body in s.bodies for x in s.kept(("along", body, i), partial(_along, s, body, i)))
        found = [*along, *found, _absolute(s, i)]
    usable = [x for x in dict.fromkeys(found) if x not in (0, rate, -rate) and bounded.size(x) <= LONGEST]
    return [x for x in usable if any(x.has(v) for v in s.v)][:MOST_RATES]


def _along(s: Ingredients, body: Body, i: int) -> list[sp.Expr]:
    """The component of a body's velocity in the direction in which a coordinate moves it: ṡ + ẋ cos α on a slope.

    Nothing unless it moves it equally far everywhere.
    """
    velocity = s.velocity(body)
    slopes = [[bounded.diff(x, v) for x in velocity] for v in s.v]

    def product(k: int) -> sp.Expr:
        return sp.Add(*[a * b for a, b in zip(slopes[k], slopes[i], strict=True)])

    def with_own(k: int) -> sp.Expr:
        return _without_turning(s, product(k))

    if not _may_be_a_number(s, product(i)):
        return []
    square = with_own(i)
    if square == 0 or not square.is_number:
        return []
    return [cast("sp.Expr", sp.Add(*[with_own(k) * v for k, v in enumerate(s.v)]) / sp.sqrt(square))]


def _without_turning(s: Ingredients, expr: sp.Expr) -> sp.Expr:
    """An expression with fewer sines and cosines: where none is left, the normal form says so at once."""
    try:
        form = s.algebra.form(expr)
    except (OutOfReach, OverflowError, ValueError):
        return bounded.trigsimp(expr)
    return bounded.trigsimp(expr) if form.turns or form.opaque() else form.expr()


def _may_be_a_number(s: Ingredients, expr: sp.Expr) -> bool:
    """Whether an expression has the same value at a few random states; most have not, and need not be simplified."""
    values = CompiledExpressions([expr]).at(States(s.model, 1))[0]
    return not np.isfinite(values).all() or bool(np.ptp(values) <= 1e-9 * np.abs(values).max())


def _absolute(s: Ingredients, i: int) -> sp.Expr:
    """∂T*/∂ξ̇ divided by ∂²T*/∂ξ̇²: in rotating axes the component of the absolute velocity."""

    def made() -> sp.Expr:
        p = s.momenta[i]
        inertia = bounded.diff(p, s.v[i])
        if inertia != 0 and not inertia.has(s.v[i]) and put(p, {s.v[i]: sp.S.Zero}) == 0:
            return s.v[i]
        if isinstance(inertia, sp.Symbol):
            return bounded.expand(p / inertia)
        return bounded.expand(bounded.cancel(p / inertia)) if inertia != 0 else sp.S.Zero

    return s.kept(("absolute", i), made)


def _squared(s: Ingredients, body: Body) -> sp.Expr | None:
    """The square of a body's whole velocity, found once for all dampers; None if it rests, or nobody writes it down."""

    def made() -> sp.Expr | None:
        squares = sp.Add(*[x**2 for x in s.velocity(body)])
        return squares if squares.has(*s.v) and bounded.size(squares) <= LONGEST else None

    return s.kept(("squared", body), made)


def _changed(s: Ingredients, element: Damper, dissipation: sp.Expr) -> dict[int, sp.Expr]:
    """What −∂D/∂ξ̇ differs from the contributions of a damper."""
    shares = s.shares(element)
    change = {i: bounded.expand(-bounded.diff(dissipation, v) - shares.get(i, 0)) for i, v in enumerate(s.v)}
    return {i: x for i, x in change.items() if x != 0}
