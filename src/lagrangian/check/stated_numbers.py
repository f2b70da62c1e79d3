"""Reads numbers that were computed with a rounded value which the answer states: 10.065 with sin 20° = 0.3420.

29.43 sin 20° is 10.0657…, and 29.43 · 0.3420 is 10.065: who states 0.3420 has made no mistake in 10.065.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.decimals import HALF
from lagrangian.check.names.spelling import values_of
from lagrangian.check.reference import Reference
from lagrangian.check.rounded import FEWEST_DIGITS, coefficients, is_true_number, last_digit
from lagrangian.check.verdict import AnsweredLine

NEAR = 1e-3
"""How near a value that an answer states is to that of the system."""


def with_stated_numbers(truth: Reference, lines: Sequence[AnsweredLine]) -> list[AnsweredLine]:
    """The lines without those that only say the value of a number, and with the exact value of what was computed with
    these."""
    lines = [x for x in lines if not _is_value(truth, x)]
    said = [x for x in lines if is_true_number(x)]
    others = [x for x in lines if not is_true_number(x)]
    stated = dict(_stated(said))
    values = {p: v for p, v in values_of(truth, ()).items() if v != 1} if stated else {}
    if not values:
        return others
    known = [
        (float(cast("sp.Expr", exact.xreplace(stated))), exact) for exact in _exact(truth.with_values(values), stated)
    ]
    table: dict[sp.Basic, sp.Expr] = {}
    for number in {abs(x) for line in others for x in bounded.atoms(line.expr, sp.Rational)}:
        unit = last_digit(number, FEWEST_DIGITS)
        near = [(abs(own - float(number)), exact) for own, exact in known]
        meant = [pair for pair in near if unit and pair[0] <= HALF * unit]
        if meant:
            exact = min(meant, key=lambda pair: pair[0])[1]
            table |= {number: exact, -number: -exact}
    return [replace(x, expr=cast("sp.Expr", x.expr.xreplace(table))) for x in others] if table else others


def _is_value(truth: Reference, line: AnsweredLine) -> bool:
    """Whether a line without anything that moves holds with the values of the system, and names what it defines: n = 2
    where n is l/r."""
    model = truth.model
    defined = {d.symbol for d in model.definitions if not d.moving}
    named = line.expr.free_symbols
    if line.kind != "equation" or not named & defined or line.expr.has(AppliedUndef, sp.Derivative):
        return False
    values: Any = {p: sp.Float(v) for p, v in model.values.items()}  # a name alone is replaced by what stands here
    sizes = [truth.expand(x).xreplace(values) for x in (line.sides or (line.expr, sp.S.Zero))]
    if not all(x.is_number and x.is_finite for x in sizes):
        return False
    left, right = (float(cast("sp.Expr", x)) for x in sizes)
    return abs(left - right) <= NEAR * max(abs(left), abs(right))


def _stated(lines: Sequence[AnsweredLine]) -> Iterator[tuple[sp.Expr, sp.Expr]]:
    """The sines and cosines with the values that lines state for them."""
    for line in lines:
        number, rest = line.expr.as_coeff_Add()
        sign, function = rest.as_coeff_Mul()
        if isinstance(function, (sp.sin, sp.cos, sp.tan)) and abs(sign) == 1:
            yield function, -sign * number


def _exact(truth: Reference, stated: dict[sp.Expr, sp.Expr]) -> Iterator[sp.Expr]:
    """The coefficients of the right lines in which such functions stand."""
    for _, exact in coefficients(truth):
        if exact.has(*stated):
            yield exact
