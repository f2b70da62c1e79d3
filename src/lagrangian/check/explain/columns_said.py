"""What an answer says of the positions and the velocities of bodies as columns, r_S = (x + l sin φ, −l cos φ)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any, TypeAlias, cast

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.apart import folded, told_apart
from lagrangian.check.explain.meant import owner_of
from lagrangian.check.explain.misconceptions import Ingredients
from lagrangian.check.explain.other_points import is_of_another_point
from lagrangian.check.explain.quantities import Effect, Sayable, quantities_of, weight_along
from lagrangian.check.explain.said_wrongly import NEAR, InWords, SaidWrongly, in_names_of, put, told
from lagrangian.check.explain.sense_counted import turned_to
from lagrangian.check.explain.turned_axes import velocities_along_axes
from lagrangian.check.reference import Reference
from lagrangian.check.rows import zero_everywhere
from lagrangian.check.verdict import AnsweredLine
from lagrangian.derive.sampling import CompiledExpressions
from lagrangian.page.formula import Left

Column: TypeAlias = tuple[AnsweredLine, ...]
Senses: TypeAlias = Mapping[int, int]
"""The sense, 1 or −1, in which an answer counts places along an axis, by the number of the axis."""


def columns(lines: Sequence[AnsweredLine]) -> list[Column]:
    """The definitions of columns, each with the lines of its entries."""
    found: list[list[AnsweredLine]] = []
    for line in lines:
        base, _, index = (line.name or "").rpartition("_")
        if line.kind != "definition" or not base or index not in ("1", "2", "3"):
            continue
        last = found[-1] if found else []
        same = bool(last) and (last[0].number, last[0].text) == (line.number, line.text)
        if index == "1":
            found.append([line])
        elif same and index == str(len(last) + 1) and last[0].name == f"{base}_1":
            last.append(line)
    return [tuple(column) for column in found if len(column) > 1]


def senses_of(truth: Reference, held: Sequence[Column]) -> Senses:
    """In which sense the positions of an answer count along each axis: as the first right one in which the place of a
    body moves along it does, to the right or to the left, upwards or downwards."""
    found: dict[int, int] = {}
    for column in held:
        said = _said(truth, column)
        for q, _, own in () if said is None else _meanings(truth, column, said, found):
            if q.kind != "place" or said is None or not _is(truth, q, (), own):
                continue
            for axis, (x, y) in enumerate(zip(said, own, strict=True)):
                if x != 0:
                    found.setdefault(axis, 1 if x == y else -1)
            break
    return found


def right_columns(truth: Reference, column: Column, senses: Senses) -> list[Sayable]:
    """The positions and velocities that a column has rightly, along fixed axes or, of velocities, along any."""
    said = _said(truth, column)
    every = () if said is None else _meanings(truth, column, said, senses)
    return [q for q, right, own in every if _is(truth, q, right, own)]


def said_of_column(truth: Reference, column: Column, senses: Senses) -> Iterator[SaidWrongly]:
    """What a column may say wrongly of the position or the velocity of each body."""
    said = _said(truth, column)
    if said is None:
        return
    every = [(q, right, own) for q, right, own in _meanings(truth, column, said, senses)]
    elsewhere = any(_is(truth, q, right, own) for q, right, own in every)
    elsewhere = elsewhere or is_of_another_point(truth, column[0], said)
    s = quantities_of(truth).of
    for q, right, own in _nearest(truth, said, every):
        effect = put(truth, _effect(s, q.owner, q.kind, own))
        if effect.T == 0 and effect.V == 0:
            continue
        yield SaidWrongly(column[0], effect, partial(_in_words, s, q, right, said), elsewhere)


def _nearest(
    truth: Reference, said: Sequence[sp.Expr], every: Sequence[tuple[Sayable, list[sp.Expr], list[sp.Expr]]]
) -> Iterator[tuple[Sayable, list[sp.Expr], list[sp.Expr]]]:
    """What a column may mean, a velocity of every body along the axes along which the fewest of its terms are wrong."""
    s = quantities_of(truth).of
    for q, right, own in every:
        if q.kind == "velocity":
            turned = [
                (replace(q, words=(*q.words, " along the axes", *words)), found, list(said))
                for words, found in velocities_along_axes(s, q.owner)
            ]
            yield min([(q, right, own), *turned], key=lambda x: _differing(x[1], said))
        else:
            yield q, right, own


def _differing(right: Sequence[sp.Expr], said: Sequence[sp.Expr]) -> int:
    """How many terms are in one column and not in the other."""
    pairs = [[Counter(sp.Add.make_args(bounded.expand(x))) for x in pair] for pair in zip(right, said, strict=True)]
    return sum(((own - other) + (other - own)).total() for own, other in pairs)


def _in_words(s: Ingredients, q: Sayable, right: Sequence[sp.Expr], said: Sequence[sp.Expr]) -> InWords:
    """What is wrong in a column."""
    shown, written = (_shown([folded(s, x) for x in xs]) for xs in (right, said))
    differ = [(x, y) for x, y in zip(right, said, strict=True) if bounded.expand(x - y) != 0]
    apart = told_apart(s, *differ[0]) if len(differ) == 1 else ()
    return replace(told(q, right, said, shown, written), apart=apart)


def _said(truth: Reference, column: Column) -> list[sp.Expr] | None:
    found = [in_names_of(truth, line) for line in column]
    return None if any(x is None for x in found) or len(column) != truth.model.dimension else cast("Any", found)


def _meanings(
    truth: Reference, column: Column, said: Sequence[sp.Expr], senses: Senses
) -> Iterator[tuple[Sayable, list[sp.Expr], list[sp.Expr]]]:
    """What a column may mean: the quantity, what is right in the senses of the answer, and what it says in ours; where
    its positions have ``senses`` already, a place has the same."""
    s = quantities_of(truth).of
    owner = owner_of((column[0].name or "")[:-2], truth.model)
    moving = any(x.has(*s.v) for x in said)
    for b in s.bodies:
        if owner is not None and b is not owner:
            continue
        values = s.velocity(b) if moving else s.position(b)
        if not any(s.moves(x) or x.has(*s.v) for x in values):
            continue
        signs = [turned_to(truth, x, y) for x, y in zip(values, said, strict=True)]
        signs = [_shared(truth, *x) for x in zip(signs, values, said, strict=True)] if moving else signs
        signs = signs if moving else [senses.get(axis, sign) for axis, sign in enumerate(signs)]
        kind, words = ("velocity", "velocity") if moving else ("place", "position")
        right = [sign * x for sign, x in zip(signs, values, strict=True)]
        own = [sign * x for sign, x in zip(signs, said, strict=True)]
        yield Sayable(kind, b, (f"{words} of {b.title}",), sp.S.Zero, lambda _: Effect()), right, own


def _shared(truth: Reference, sign: int, right: sp.Expr, said: sp.Expr) -> int:
    """The sense in which a component is counted: the opposite one only if a term of it is written so."""
    own, other = (set(sp.Add.make_args(bounded.expand(truth.put(x)))) for x in (-right, said))
    return sign if sign > 0 or own & other else 1


def _effect(s: Ingredients, b: Any, kind: str, own: Sequence[sp.Expr]) -> Effect:
    """What the position or the velocity adds to T* and V."""
    m, v, r = s.expand(b.mass), s.velocity(b), s.position(b)
    rates = [s.rate(x) for x in own] if kind == "place" else own
    T = m * (sp.Add(*[x**2 for x in rates]) - sp.Add(*[x**2 for x in v])) / 2
    lifted = [weight_along(s, b, c) * (x - y) for c, (x, y) in enumerate(zip(own, r, strict=True))]
    return Effect(T=T, V=-sp.Add(*lifted) if kind == "place" else sp.S.Zero)


def _is(truth: Reference, q: Sayable, right: Sequence[sp.Expr], own: Sequence[sp.Expr]) -> bool:
    """Whether all entries are right, but for a constant place; of a velocity, its square is enough."""
    s = quantities_of(truth).of
    of = [truth.put(s.velocity(q.owner)[c] if q.kind == "velocity" else x) for c, x in enumerate(s.position(q.owner))]
    if q.kind == "velocity":
        return zero_everywhere(truth, truth.put(sp.Add(*[x**2 for x in own])) - sp.Add(*[x**2 for x in of]))
    rests = CompiledExpressions([x - y for x, y in zip(own, of, strict=True)]).at(truth.states)
    level = rests - rests[:, :1]
    return bool(np.isfinite(rests).all() and np.abs(level).max() <= NEAR * (1 + np.abs(rests).max()))


def _shown(exprs: Sequence[sp.Expr]) -> tuple[str | Left, ...]:
    """A column in a sentence: (x + l sin φ, −l cos φ)."""
    parts: list[str | Left] = []
    for x in exprs:
        parts += [", " if parts else "(", x]
    return (*parts, ")")
