"""In which sense a quantity is counted in an answer, and what its name should then be."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import cast

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.quantities import SIGNED, Sayable, quantities_of
from lagrangian.check.reference import Reference
from lagrangian.derive.sampling import CompiledExpressions


def value_of(q: Sayable, said: sp.Expr, written: sp.Expr, sign: int) -> sp.Expr | None:
    """The right value of a name of which what it says is ``written`` as a quantity; None if that is its rate."""
    if q.kind == "speed":
        return q.right if written is said else cast("sp.Expr", sp.sqrt(q.right))
    return sign * q.right if written is said else None


def senses(truth: Reference, q: Sayable, said: sp.Expr) -> Iterator[tuple[sp.Expr, int]]:
    """What is written, and the sense in which it is counted; the sense that leaves fewer motions different first."""
    s = quantities_of(truth).of
    if q.kind == "speed":
        degree = _degree(said, s.v)
        if degree != 2:
            yield said**2, 1
        if degree != 1:
            yield said, 1
        return
    said = s.rate(said) if q.kind == "rate" and not said.has(*s.v) else said
    if q.kind not in SIGNED:
        yield said, 1
        return
    outwards = -1 if q.right.could_extract_minus_sign() else 1
    first = outwards if q.kind == "apart" else turned_to(truth, q.right, said) if q.axis is None else 1
    yield said, first
    yield said, -first


def _degree(said: sp.Expr, rates: Sequence[sp.Expr]) -> int | None:
    """Whether the rates multiply what is said once, as a speed, or twice, as its square; None for neither."""
    doubled = cast("sp.Expr", said.xreplace({v: 2 * v for v in rates}))
    return next((n for n in (1, 2) if bounded.expand(doubled - 2**n * said) == 0), None)


def turned_to(truth: Reference, right: sp.Expr, said: sp.Expr) -> int:
    """The sense in which what is written is counted: that which leaves fewer motions different, or less of them."""
    moving = [x for c in truth.model.coordinates for x in (c.rate, c.symbol) if right.has(x) or said.has(x)]
    whole, own = bounded.expand(said), bounded.expand(right)  # of many quantities, and of many names: each once
    rests = [cast("sp.Expr", whole - sign * own) for sign in (-1, 1)]
    back, forth = (sum(rest.has(x) for x in moving) for rest in rests)
    if back != forth:
        return -1 if back < forth else 1
    back, forth = (any(_is_bare(rest, x) for x in moving) for rest in rests)
    several = sum(right.has(c.symbol) or said.has(c.symbol) for c in truth.model.coordinates) > 1
    if several and back != forth:  # of ṡ − r θ̇ for ṡ + r θ̇ the sense of ṡ is that in which it is counted
        return 1 if back else -1
    values, theirs = (CompiledExpressions([truth.put(x)]).at(truth.states)[0] for x in (said, right))
    back, forth = (float(np.abs(values - sign * theirs).sum()) for sign in (-1, 1))
    return -1 if back < forth else 1


def _is_bare(rest: sp.Expr, x: sp.Expr) -> bool:
    """Whether a rate or a coordinate stands in a sum with nothing but a number."""
    factor = cast("sp.Expr", rest.coeff(x))
    return bool(factor.is_number and factor != 0)
