"""What a prime of an answer's own function of one coordinate is, where nothing says it: its rate or its slope.

A = J + m r² cos²θ;  dT/dt = A θ' θ'' + ½ A' θ'³      A' = dA/dθ: with the rate, the terms have unlike numbers of dots
dT/dt = A θ' θ'' + A' θ'³ = A θ' θ'' − 2 m r² …       and the side behind it shows the same
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import sympy as sp
from lark import Tree
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.reading.chained_names import define_chained
from lagrangian.check.reading.meaning import Meaning
from lagrangian.check.reading.names import Value
from lagrangian.check.reading.nodes import names_in
from lagrangian.check.reading.slopes_by_dots import has_prime, tell_slopes, with_slopes
from lagrangian.model.names import time
from lagrangian.read.letters import key

LONGEST = 200
"""The most terms of a side, multiplied out, whose dots are counted."""


def values_beside_rates(sides: Sequence[Tree], reader: Meaning) -> list[Value]:
    """The values of the sides of a statement, in which primes are slopes where it only holds together so.

    That is where the terms of a side with accelerations have equally many dots only with the slopes, or where more
    sides are equal to the one behind them.
    """
    define_chained(sides, reader)
    if with_slopes(reader):
        return [reader.value(side) for side in sides]
    values = [reader.value(side) for side in sides]
    if not (primed := _own_functions(sides, reader)):
        return values
    other = Meaning(reader.source, reader.names, reader.budget)
    other.slopes = primed
    slopes = [other.value(side) for side in sides]
    pairs = [(x, y) for x, y in zip(values, slopes, strict=True) if isinstance(x, sp.Expr) and x != y]
    dotted = any(_dots(x, alike=False) and _dots(y, alike=True) for x, y in pairs)
    if not pairs or not (dotted or _equal(slopes) > _equal(values)):
        return values
    tell_slopes(primed, reader.names)
    return slopes


def _own_functions(sides: Sequence[Tree], reader: Meaning) -> dict[str, str]:
    """The answer's own names that stand with a prime, and are functions of one coordinate alone, as written; those that
    have a dot, or dI/dt, anywhere in the statement are rates."""
    found: dict[str, str] = {}
    changing = [token for side in sides for token, changes in names_in(side) if changes]
    dotted = {key(str(x)) for x in changing if not has_prime(x, reader.source.text)}
    for token in (x for x in changing if key(str(x)) not in dotted):
        name = str(token)
        _, value = reader.names.own.get(key(name), ("", None))
        if isinstance(value, sp.Expr) and _is_of_one(value, reader):
            found[key(name)] = name
    return found


def _is_of_one(value: sp.Expr, reader: Meaning) -> bool:
    """Whether a value is a function of one coordinate, and of nothing else that changes with time."""
    expr = reader.names.model.expand(value)
    moving = bounded.atoms(expr, AppliedUndef)
    if len(moving) != 1 or not moving <= reader.names.moving_symbols or bounded.atoms(expr, sp.Derivative):
        return False
    return time not in expr.xreplace(dict.fromkeys(moving, sp.S.One)).free_symbols


def _dots(expr: sp.Expr, *, alike: bool) -> bool:
    """Whether the terms of a side with accelerations have equally many dots, or do not."""
    if not any(x.derivative_count > 1 for x in bounded.atoms(expr, sp.Derivative)):
        return False
    terms = sp.Add.make_args(bounded.expand(expr))
    counts = {_count(x) for x in terms[:LONGEST]}
    return None not in counts and len(terms) <= LONGEST and (len(counts) == 1) is alike


def _count(term: sp.Expr) -> int | None:
    """The number of dots in a product; None if that is no number."""
    found = 0
    for base, power in (f.as_base_exp() for f in sp.Mul.make_args(term)):
        if not bounded.atoms(base, sp.Derivative):
            continue
        if not isinstance(base, sp.Derivative) or not power.is_Integer:
            return None
        found += int(base.derivative_count) * int(power)  # type: ignore[arg-type]
    return found


def _equal(values: Sequence[Value]) -> int:
    """How many sides are equal to the one behind them."""
    pairs = pairwise(values)
    return sum(isinstance(a, sp.Expr) and isinstance(b, sp.Expr) and bool(bounded.expand(a - b) == 0) for a, b in pairs)
