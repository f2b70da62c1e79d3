"""What a wrong energy takes a velocity, an angular velocity or a deflection as: ½ J (φ̇ − β̇)² where the body turns
with φ̇, ½ m ṡ² where it moves with ½ ṡ."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from math import isqrt
from typing import Any, cast

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.quantities import Sayable, quantities_of
from lagrangian.check.explain.said_wrongly import SaidWrongly, in_words, put
from lagrangian.check.explain.search import SMALL, Explanation, simple_number
from lagrangian.check.explain.sense_counted import turned_to
from lagrangian.check.reference import Reference
from lagrangian.check.stated import right_value
from lagrangian.check.verdict import AnsweredLine, Mistake
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.model import Damper

KINDS = ("turning", "deflection", "rate", "along", "component")
"""The kinds of quantities that are squared in an energy, those of which it is said first."""
BARE = ("term_replaced", "factor_of_a_term")
"""The names of mistakes that only show a formula."""
MOST = 32
"""The most expressions that are tried in place of the quantities."""


def taken_as(
    truth: Reference, line: AnsweredLine, found: list[Explanation], own: list[Mistake]
) -> tuple[list[Explanation], list[Mistake]]:
    """The explanations of a line; in their place the quantity that a wrong T*, V, L or D takes as another one, where
    else nothing is known, or no more than a term or a number that is a square, ¼ or 4."""
    right = right_value(truth, line, None) if line.kind in ("T", "V", "L", "D") and not truth.values else None
    bare = not own or any(m.name in BARE for m in own)
    bare = _is_square_of_part(found[0]) or _is_in_pieces(found[0]) if found else bare
    for q, sign, written in _found(truth, line, line.expr - right) if right is not None and bare else ():
        effect = put(truth, q.adds(sign * written))
        said = SaidWrongly(line, effect, partial(in_words, quantities_of(truth).of, q, written, sign))
        return [], [said.mistake]
    return found, own


def taken_in(truth: Reference, said: SaidWrongly) -> SaidWrongly | None:
    """What a definition of a potential energy takes the deflection of its spring as: 2 x of ½ k (2 x)²."""
    line = replace(said.line, kind="V", expr=truth.expand(said.line.expr))
    for q, sign, written in _found(truth, line, said.V):
        if q.owner is said.words.of.owner:
            effect = put(truth, q.adds(sign * written))
            return SaidWrongly(said.line, effect, partial(in_words, quantities_of(truth).of, q, written, sign))
    return None


def _is_square_of_part(found: Explanation) -> bool:
    """Whether an explanation is that a part counts ¼, 4 or 9 times."""
    if len(found.told) != 1:
        return False
    told = found.told[0]
    change, number = told.mistake.change, 1 + told.times
    square = number > 0 and all(isqrt(x) ** 2 == x for x in (number.numerator, number.denominator))
    return change is not None and change.kind == "part" and square and number != 1


def _is_in_pieces(found: Explanation) -> bool:
    """Whether an explanation is that several things are wrong in what one element adds."""
    return len(found.told) > 1 and len({t.mistake.element for t in found.told} - {None}) == 1


def _found(truth: Reference, line: AnsweredLine, rest: sp.Expr) -> Iterator[tuple[Sayable, int, sp.Expr]]:
    """The quantities, each with the sense in which it is counted and what stands in its place: the energy with this is
    the one that is written."""
    s = quantities_of(truth).of
    every = sorted((q for q in quantities_of(truth).all if q.kind in KINDS), key=lambda q: KINDS.index(q.kind))
    every = [q for q in every if isinstance(q.owner, Damper)] if line.kind == "D" else every
    bases = _bases(truth, line.expr)
    for q in every:
        nothing = SaidWrongly(line, put(truth, q.adds(sp.S.Zero)), partial(in_words, s, q, sp.S.Zero, 1))
        share = nothing.adds(truth, line.kind, None)
        if share == 0:
            continue
        listed = list(dict.fromkeys((q.right, *bases)))[:MOST]
        values = CompiledExpressions([truth.put(x) for x in (rest, share, q.right, *listed)]).at(truth.states)
        with np.errstate(all="ignore"):
            square: Array = values[2] ** 2 * (share_left := values[1] - values[0]) / values[1]
            ratios = square / values[3:] ** 2
        if np.abs(share_left).max() <= SMALL * np.abs(values[1]).max():
            continue
        for x, ratio in zip(listed, ratios, strict=True):
            if (times := _root(ratio)) is not None and _is_alike(truth, q, written := times * x):
                yield q, *_outwards(q, written, _sense(truth, q, written))


def _sense(truth: Reference, q: Sayable, written: sp.Expr) -> int:
    """The sense in which what is written is counted; as it is written if no rate in it is that of the quantity."""
    own, other = q.right.atoms(sp.Derivative), written.atoms(sp.Derivative)
    return turned_to(truth, q.right, written) if own & other or not own else 1


def _outwards(q: Sayable, written: sp.Expr, sign: int) -> tuple[int, sp.Expr]:
    """The sense in which a quantity is told, without a minus in front of what is right, and what is written in it."""
    right = sign * q.right
    turned = not isinstance(right, sp.Add) and right.could_extract_minus_sign()
    return (-sign, -written) if turned else (sign, written)


def _root(ratio: Array) -> sp.Rational | None:
    """The number of which all values are the square; None if there is none."""
    if not np.isfinite(ratio).all() or ratio[0] <= 0 or np.abs(ratio - ratio[0]).max() > SMALL * ratio[0]:
        return None
    number = simple_number(float(np.sqrt(ratio[0])))
    return None if number is None else cast("sp.Rational", sp.Rational(number.numerator, number.denominator))


def _bases(truth: Reference, expr: sp.Expr) -> list[sp.Expr]:
    """What is squared in an energy as it is written, alone and with what is squared beside it: (ẋ − u̇)/r of
    J (ẋ − u̇)²/(2 r²), r φ̇ of ½ d r² φ̇²."""
    s = quantities_of(truth).of
    found: list[sp.Expr] = []
    for product in sorted((expr, *expr.atoms(sp.Mul, sp.Pow)), key=sp.default_sort_key):
        factors: tuple[Any, ...] = sp.Mul.make_args(product)
        held = [x for x in factors if x.is_Pow and x.exp.is_Integer and x.exp % 2 == 0]
        moving = [x.base for x in held if x.exp == 2 and (s.moves(x.base) or x.base.has(*s.v))]
        beside = sp.Mul(*[x.base ** (x.exp / 2) for x in held if x.base.is_Symbol])
        found += [x for w in moving for x in (w, w * beside)]
        found += [sp.Mul(*[x.base ** (x.exp / 2) for x in held])] if len(moving) > 1 else []
    return list(dict.fromkeys(found))


def _is_alike(truth: Reference, q: Sayable, written: sp.Expr) -> bool:
    """Whether what is written may be meant as a quantity, and is not it."""
    s = quantities_of(truth).of
    same = bool(written.has(*s.v)) == bool(q.right.has(*s.v))
    return same and all(bounded.expand(written - x) != 0 for x in (q.right, -q.right))
