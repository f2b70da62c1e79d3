"""Finds names that an answer gives two different values of which one is used and the other is not.

A name may be used again, v = x1' for one body and v = x2' for the next. But where one of two values is used nowhere,
they contradict each other, and an answer must not be right by the one that happens to fit.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.matrices.matrixbase import MatrixBase

from lagrangian import bounded
from lagrangian.check.decimals import digits, places
from lagrangian.check.reading.answer import AnswerLine, Kind
from lagrangian.check.reading.components import component_of
from lagrangian.check.reading.line_forms import accelerates
from lagrangian.check.reading.names import Names
from lagrangian.check.reading.placeholders import is_placeholder, is_vector
from lagrangian.errors import Place
from lagrangian.model import time
from lagrangian.quantities.source import Source
from lagrangian.read.letters import key

DIGITS = 30
"""The digits to which two values of a name are compared, at random places."""

FEWEST_DIGITS, HALF = 2, sp.Rational(5_000_001, 10_000_000)
"""The fewest significant digits of a rounded number, and by what part of its last digit it may be off."""

PLACES = 2
"""The random places at which they are compared; what differs there is judged exactly."""


def contradicting(
    names: Names, sources: Sequence[Source], made: Mapping[int, Sequence[AnswerLine]]
) -> Iterator[tuple[int, AnswerLine]]:
    """A line for each two values of a name of which one is used and the other is not, with the number of its statement;
    its place is that of the last of the lines ``made`` of this.

    So is one for the rate of a point's component that is not the derivative of the point, xS' beside S = (…, …).
    Values that cannot be judged, a number beside a formula or a force beside another, are told in a note.
    """

    def place_of(i: int) -> Place:
        return made[i][-1].place if made.get(i) else sources[i].at(0)

    for _, i, above, value in names.redefined.unused():
        told = " ".join(sources[i].text.split())
        for a, b in _pairs(above, value):
            if not _differ(a, b) or _is_rounded(a, b) or _is_rounded(b, a):
                continue
            if not _comparable(a, b) or any(map(names.is_unknown, bounded.letters(a) | bounded.letters(b))):
                names.notes.setdefault(f"'{told}' was not judged: the value that is used is another one.")
                continue
            kind: Kind = "equation" if accelerates(a) or accelerates(b) else "identity"
            yield i, AnswerLine(kind, a, b, None, place_of(i), told)
    for name, order, value, i in names.redefined.rates:
        place = component_of(name, lambda of: names.own.get(key(of), ("", None))[1])
        if place is None or key(name) in names.own or not isinstance(value, sp.Expr):
            continue
        rate = bounded.diff(place, *[time] * order)
        if _differ(rate, value) and not any(map(names.is_unknown, bounded.letters(rate) | bounded.letters(value))):
            yield i, AnswerLine("identity", value, rate, None, place_of(i), " ".join(sources[i].text.split()))


def _is_rounded(number: sp.Expr, exact: sp.Expr) -> bool:
    """Whether a number is another one that has more decimals, rounded to its last digit: 14.7 and sqrt(8000/37)."""
    if not isinstance(number, sp.Rational) or not exact.is_number or not exact.is_finite:
        return False
    after, more = places(number), places(exact) if isinstance(exact, sp.Rational) else None
    if after is None or (more is not None and more <= after) or digits(number, after) < FEWEST_DIGITS:
        return False
    return bool(abs(sp.N(exact - number, DIGITS)) <= sp.Rational(10) ** -after * HALF)


def _pairs(above: Any, value: Any) -> Iterator[tuple[sp.Expr, sp.Expr]]:
    """The entries of two values beside each other; v² beside v = (…, …) is the square of its length."""
    lists = [isinstance(x, MatrixBase) for x in (above, value)]
    if all(lists):
        if above.shape == value.shape:
            yield from zip(above.flat(), value.flat(), strict=True)
    elif any(lists):
        column, length = (above, value) if lists[0] else (value, above)
        yield sp.Add(*[x**2 for x in column.flat()]), length**2
    elif isinstance(above, sp.Expr) and isinstance(value, sp.Expr):
        yield above, value


def _comparable(above: sp.Expr, value: sp.Expr) -> bool:
    """Whether two values are expressions that can be judged: not a formula beside the number that follows from it. The
    cosine of a given angle is not 1."""
    if any(is_vector(x) or any(map(is_placeholder, bounded.letters(x))) for x in (above, value)):
        return False
    if bool(above.is_number) == bool(value.is_number) or 0 in (above, value):
        return True
    number, formula = (above, value) if above.is_number else (value, above)
    return number in (1, -1) and formula.has(sp.sin, sp.cos) and not formula.atoms(AppliedUndef)


def _differ(above: sp.Expr, value: sp.Expr) -> bool:
    """Whether two expressions differ somewhere; where this cannot be computed, they may."""
    if above == value:
        return False
    rest, whole = above - value, sp.Tuple(above, value)
    rates = sorted(whole.atoms(sp.Derivative), key=lambda d: (-d.derivative_count, str(d)))
    names = [*rates, *sorted(whole.atoms(AppliedUndef), key=str), *sorted(whole.free_symbols, key=str)]
    for place in range(PLACES):
        table = {x: sp.Rational(2 * k + 7 * place + 3, 2 * k + 5 + place) for k, x in enumerate(names)}
        sizes = [sp.N(x.xreplace(table), DIGITS) for x in (rest, above)]
        if not all(x.is_number and x.is_finite for x in sizes):
            return True
        if abs(sizes[0]) > sp.Float(10) ** (10 - DIGITS) * (1 + abs(sizes[1])):
            return True
    return False
