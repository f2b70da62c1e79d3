"""Compares the terms of two sums in which functions have several forms: k h² tan θ/cos² θ is k h² (tan θ + tan³ θ).

Terms with the same letters, coordinates and rates are one entry, whatever functions of the coordinates multiply them;
two entries are equal if they have the same values.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Any, cast

import numpy as np
import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.reference import Reference
from lagrangian.derive.sampling import CompiledExpressions

SMALL = 1e-9
"""The relative size of a difference that is rounding."""
LARGEST_DENOMINATOR = 12


def entries(truth: Reference, right: sp.Expr, written: sp.Expr) -> Iterator[tuple[str, sp.Expr, sp.Expr, sp.Expr]]:
    """How each entry of what was written differs: the kind of the difference, what belongs there and what is
    written; and the first as it stands in the right sum.

    Entries without a value at the states of the reference are compared as they are.
    """
    ours, theirs = _by_letters(right), _by_letters(written)
    keys = list(dict.fromkeys((*theirs, *ours)))
    pairs = [(ours.get(k, sp.S.Zero), theirs.get(k, sp.S.Zero)) for k in keys]
    values = CompiledExpressions([x for pair in pairs for x in pair]).at(truth.states)
    for k, (a, b) in enumerate(pairs):
        one, two = values[2 * k], values[2 * k + 1]
        good = np.isfinite(one) & np.isfinite(two)
        one, two = one[good], two[good]
        size = max(np.abs(one).max(initial=0.0), np.abs(two).max(initial=0.0))
        if np.abs(one - two).max(initial=0.0) <= SMALL * size:
            continue
        if b == 0:
            yield "missing", put_together(a), b, a
        elif a == 0:
            yield "extra", b, b, a
        elif (number := _ratio(one, two)) is not None:
            yield "sign" if number == -1 else "coefficient", cast("sp.Expr", b / number), b, a
        else:
            yield "coefficient", put_together(a), b, a


def _by_letters(expr: sp.Expr) -> dict[sp.Expr, sp.Expr]:
    """The terms of a sum, added up by their letters: parameters, inputs, coordinates and rates."""
    found: dict[sp.Expr, list[sp.Expr]] = {}
    for term in sp.Add.make_args(bounded.expand(expr)):
        letters = [f for f in sp.Mul.make_args(term) if _is_letter(f.as_base_exp()[0])]
        if term != 0:
            found.setdefault(sp.Mul(*letters), []).append(cast("sp.Expr", term))
    return {k: sp.Add(*x) for k, x in found.items()}


def _is_letter(base: sp.Basic) -> bool:
    return isinstance(base, (sp.Symbol, AppliedUndef, sp.Derivative))


def _ratio(right: Any, written: Any) -> sp.Rational | None:
    """The number by which what is written is a multiple of what belongs there; None if it is none."""
    times = float(written @ right) / float(right @ right)
    number = Fraction(times).limit_denominator(LARGEST_DENOMINATOR)
    if number == 0 or np.abs(written - float(number) * right).max() > SMALL * np.abs(written).max():
        return None
    return cast("sp.Rational", sp.Rational(number.numerator, number.denominator))


def put_together(expr: sp.Expr) -> sp.Expr:
    """A sum of terms with the same letters, with its functions of coordinates put together if this is shorter."""
    together = bounded.trigsimp(sp.factor_terms(expr))
    return together if bounded.operations(together) < bounded.operations(expr) else expr
