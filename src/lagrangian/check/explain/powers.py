"""Finds the root, or the other power, of a sum by which a term should be divided: l = √(a² + d² − 2 a d cos θ)."""

from __future__ import annotations

from random import Random
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded

POWERS = (sp.Rational(1, 2), sp.Integer(1), sp.Rational(3, 2), sp.Integer(2))
MOST_BASES, LONGEST, POINTS = 4, 400, 3
"""The most sums that are tried, the most operations of a term, and at how many points it is compared."""
NEAR = 1e-9
"""The relative difference of values that is rounding."""


def power_between(term: sp.Expr, right: sp.Expr) -> sp.Expr | None:
    """The power of a sum by which a term is larger than the right one, or its negative; None if there is none."""
    if bounded.operations(term) + bounded.operations(right) > LONGEST:
        return None
    bases = {f.base for x in (term, right) for f in x.atoms(sp.Pow) if isinstance(f.base, sp.Add)}
    tried = [b**e for b in sorted(bases, key=sp.default_sort_key)[:MOST_BASES] for e in POWERS]
    letters = sorted(bounded.letters(sp.Add(term, right)), key=str)
    rates = sorted((term + right).atoms(sp.Derivative), key=str)
    random, values = Random(7), list[tuple[complex, ...]]()
    for _ in range(POINTS if tried else 0):
        table: dict[Any, Any] = {x: sp.Float(random.uniform(0.4, 1.3)) for x in (*rates, *letters)}
        values.append(tuple(_value(x, table) for x in (term, right, *tried)))
    for k, power in enumerate(tried):
        if all(abs(v[0] - v[1] * v[2 + k]) <= NEAR * abs(v[0]) for v in values):
            return power
    return None


def _value(expr: sp.Expr, table: dict[Any, Any]) -> complex:
    """The value of an expression with numbers for its rates, coordinates and letters."""
    rates = {x: y for x, y in table.items() if isinstance(x, sp.Derivative)}
    others = {x: y for x, y in table.items() if isinstance(x, (sp.Symbol, AppliedUndef))}
    value: Any = expr.xreplace(rates).xreplace(others)
    return complex(value.evalf())
