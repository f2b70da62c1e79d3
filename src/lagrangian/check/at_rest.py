"""Whether a line about positions holds at rest: s = m g/k, x2 − x1 = F/k2, k1 x = k2 z, m1 R = m2 r.

The rows of the system with all rates 0, and with each input constant or 0, are A q = c for those that are linear in the
coordinates q. A line a q = b holds if it is a combination of them; it does not if a is one of the rows of A, and b is
not that of c. Where rows of A depend on each other, there is only rest for certain parameters, which are then chosen.

What holds a position, F = m g sin α, is told by the same rows at any q, where they are linear in the inputs.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from itertools import combinations
from typing import Any, TypeAlias, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian.check.reference import Reference
from lagrangian.model import time

DIGITS = 30
_SMALL = sp.Float(10) ** (10 - DIGITS)
MOST_INPUTS = 3
"""The most inputs of which each may be 0."""

_Row: TypeAlias = list[sp.Expr]
"""The numbers that multiply the coordinates, and what is left."""


def at_rest(truth: Reference, expr: sp.Expr, given: Sequence[sp.Expr] = ()) -> bool | None:
    """Whether an expression is 0 at rest where those that are ``given`` are 0; None if that cannot be said."""
    if expr.has(sp.Derivative) or truth.derivation.multipliers:
        return None
    put = _given(truth, given)
    found = {_holds(truth, expr, put | inputs) for inputs in _inputs(truth, put, expr)}
    return True if True in found else False if False in found and None not in found else None


def balances(truth: Reference, expr: sp.Expr) -> bool:
    """Whether an expression with inputs is 0 at any position that these hold at rest: F = m g sin θ, F2 = c F1/l."""
    inputs = [u.symbol for u in truth.model.inputs]
    if expr.has(sp.Derivative) or truth.derivation.multipliers or not expr.has(*inputs):
        return False
    listed = [cast("sp.Expr", x.xreplace(still_of(truth))) for x in (*truth.rows, expr)]
    letters = set[Any]().union(*(x.free_symbols for x in listed)) - {time}
    numbers = numbers_for([*sorted(letters, key=str), *(c.symbol for c in truth.model.coordinates)])
    for put in _inputs(truth, {}, expr):
        zero = {x: value for x, value in put.items() if value == 0}
        *found, own = (_linear(cast("sp.Expr", x.xreplace(zero)), inputs, numbers) for x in listed)
        rows = [row for row in found if row is not None and any(abs(x) > _SMALL for x in row[:-1])]
        if own is None or not rows:
            continue
        for group in (*([row] for row in rows), rows):
            if not _contradictions(group) and all(abs(x) <= _SMALL for x in _reduced(group, own)):
                return True
    return False


def still_of(truth: Reference) -> dict[Any, Any]:
    """Every rate and acceleration as 0."""
    return {x: sp.S.Zero for c in truth.model.coordinates for x in (c.rate, c.acceleration)}


def letters_of_inputs(truth: Reference) -> dict[Any, Any]:
    """Every input as a constant."""
    return {u.symbol: sp.Symbol(u.name) for u in truth.model.inputs}


def numbers_for(names: Sequence[Any]) -> dict[Any, Any]:
    """A different number for every name."""
    return {x: sp.Rational(3 * k + 4, 2 * k + 3) for k, x in enumerate(names)}


def _given(truth: Reference, given: Sequence[sp.Expr]) -> dict[Any, Any]:
    """The values of inputs, coordinates and parameters that lines state, F = m g, θ = 0."""
    symbols = [*(u.symbol for u in truth.model.inputs), *(c.symbol for c in truth.model.coordinates)]
    found: dict[Any, Any] = {}
    for expr in given:
        name = next((x for x in symbols if expr.diff(x).is_number and expr.diff(x) != 0 and x not in found), None)
        if name is not None and not expr.has(sp.Derivative):
            found[name] = name - expr / expr.diff(name)
    return found


def _inputs(truth: Reference, put: Mapping[Any, Any], expr: sp.Expr) -> Iterator[dict[Any, Any]]:
    """The values of the inputs that nothing gives: constant, in turn all or some of those 0 that the line lacks."""
    free = [u for u in truth.model.inputs if u.symbol not in put]
    gone = [u for u in free if not expr.has(u.symbol)]
    for count in range(min(len(gone), MOST_INPUTS) + 1):
        for zero in combinations(gone, count):
            yield {u.symbol: sp.S.Zero if u in zero else sp.Symbol(u.name) for u in free}


def _holds(truth: Reference, expr: sp.Expr, put: Mapping[Any, Any]) -> bool | None:
    coordinates = [c.symbol for c in truth.model.coordinates]
    still, letters = still_of(truth), letters_of_inputs(truth)
    listed = [cast("sp.Expr", x.xreplace(still).xreplace(dict(put)).xreplace(letters)) for x in (*truth.rows, expr)]
    names = sorted(set().union(*(x.free_symbols for x in listed)) - {time}, key=str)
    names.sort(key=lambda x: x not in letters.values())  # an input is rather chosen than a parameter
    numbers, chosen = _numbers(listed[:-1], coordinates, names)
    if numbers is None or (not chosen and not listed[-1].has(*coordinates)):
        return None  # there is no rest, or any parameters are possible
    *rows, own = (_linear(x, coordinates, numbers) for x in listed)
    if own is None:
        return None
    left = _reduced([row for row in rows if row is not None], own)
    if any(abs(x) > _SMALL for x in left[:-1]):
        return None
    return bool(abs(left[-1]) <= _SMALL)


def _numbers(
    rows: Sequence[sp.Expr], coordinates: Sequence[AppliedUndef], names: Sequence[Any]
) -> tuple[dict[Any, Any] | None, bool]:
    """Values of the letters with which there is rest, None if there are none, and whether one had to be chosen."""
    table = numbers_for(names)

    def gaps(values: Mapping[Any, Any]) -> _Row:
        found = (_linear(x, coordinates, values) for x in rows)
        return _contradictions([row for row in found if row is not None])

    if not (first := gaps(table)):
        return table, False
    for name in names:
        second = gaps(table | {name: table[name] + 1})
        if len(second) != len(first) or abs(second[0] - first[0]) <= _SMALL:
            continue
        value = table[name] - first[0] / (second[0] - first[0])
        if abs(value) > _SMALL and not gaps(chosen := table | {name: value}):
            return chosen, True
    return None, True


def _linear(expr: sp.Expr, coordinates: Sequence[AppliedUndef], values: Mapping[Any, Any]) -> _Row | None:
    """The factors of the coordinates in an expression, and what is left, with values for its letters; None if it is not
    linear."""
    parts = [x.xreplace(dict(values)) for x in _apart(expr, tuple(coordinates))]
    return [sp.N(x, DIGITS) for x in parts] if all(x.is_number and x.is_finite for x in parts) else None


@lru_cache(maxsize=500)
def _apart(expr: sp.Expr, coordinates: tuple[AppliedUndef, ...]) -> tuple[sp.Expr, ...]:
    """The slopes of an expression, and its value where the coordinates are 0, kept for all values of its letters."""
    return *(expr.diff(q) for q in coordinates), cast("sp.Expr", expr.xreplace(dict.fromkeys(coordinates, sp.S.Zero)))


def _reduced(rows: list[_Row], own: _Row) -> _Row:
    """A row of numbers without the multiples of others that take coordinates off it."""
    return _eliminated([*rows, own], len(rows))[-1]


def _contradictions(rows: list[_Row]) -> _Row:
    """The numbers that rows without any coordinate, combined from others, say to be 0."""
    left = _eliminated(rows, len(rows)) if rows else []
    return [row[-1] for row in left if all(abs(x) <= _SMALL for x in row[:-1]) and abs(row[-1]) > _SMALL]


def _eliminated(rows: list[_Row], pivots: int) -> list[_Row]:
    """The rows that are left when coordinates are eliminated; only the first ``pivots`` are added to others."""
    first, others = rows[:pivots], rows[pivots:]
    done: list[_Row] = []
    for k in range(len(rows[0]) - 1):
        pivot = max(first, key=lambda row: abs(row[k]), default=None)
        if pivot is None or abs(pivot[k]) <= _SMALL:
            continue
        first = [row for row in first if row is not pivot]
        first, others = (
            [[a - b * row[k] / pivot[k] for a, b in zip(row, pivot, strict=True)] for row in x] for x in (first, others)
        )
        done.append(pivot)
    return [*done, *first, *others]
