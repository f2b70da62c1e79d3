"""Reads the decimals of an answer in numbers as rounded: 1.8126156 for m cos(25°) = 1.81261557…

A number is read as a coefficient of the right equations if it is this coefficient, rounded to its last digit. The
answer is then compared exactly, so that a coefficient in a wrong place stays wrong. With three digits many numbers are
near some coefficient: such a line is read as rounded only if it is a right one, term by term.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import lru_cache, partial
from itertools import combinations
from typing import Any, cast

import numpy as np
import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.cleared import cleared
from lagrangian.check.decimals import HALF, digits, most_off, places
from lagrangian.check.reference import Reference, truth_of
from lagrangian.check.rounded_terms import in_exact_terms, typed_in_names, within_rounding
from lagrangian.check.verdict import AnsweredLine
from lagrangian.derive.sampling import CompiledExpressions
from lagrangian.model import time
from lagrangian.model.rows import rows_of
from lagrangian.page.formula import Text, text

FEWEST_DIGITS = 4
"""The fewest significant digits of a number that may be rounded."""

FEWEST_IN_RIGHT_LINE = 3
"""The fewest significant digits in a line in which every number is a right one or rounded from the right one."""

LONGEST = 1_000
"""The largest number of operations of an equation whose coefficients are sought."""

MAX_COEFFICIENTS = 30
"""The largest number of coefficients of an equation whose ratios are formed."""

LONGEST_NUMBER = 20
"""The most operations of a number, made of sines and cosines of angles, of which ratios are formed."""

FAR = 1e-8
"""How far, in parts of their size, numbers may be off that are found at states."""

Sizes = dict[float, float | None]
"""Numbers that are read as rounded, with what those are read as of which the last digit is off."""

MAX_SOLVED, MAX_ELIMINATED = 4, 3
"""The most coordinates of a system whose equations are solved for the accelerations, or freed from some."""


def unrounded(truth: Reference, lines: Sequence[AnsweredLine]) -> tuple[tuple[AnsweredLine, ...], tuple[Text, ...]]:
    """The lines with rounded numbers replaced by the coefficients that they stand for, and a note about them."""
    if not truth.values:
        return tuple(lines), ()
    angles, rounded_angles = _rounded_angles(truth, lines)
    lines = [replace(line, expr=cast("sp.Expr", line.expr.xreplace(angles))) for line in lines] if angles else lines
    numbers = {abs(x) for line in lines for x in bounded.atoms(line.expr, sp.Rational)}
    rounded = {x: unit for x in numbers if (unit := last_digit(x, FEWEST_DIGITS)) is not None}
    table: dict[sp.Basic, sp.Expr] = {}
    known = coefficients(truth) if rounded else ()
    for x, unit in rounded.items():
        near = [(abs(value - float(x)), exact) for value, exact in known if abs(value - float(x)) <= HALF * unit]
        if near and all(exact != x for _, exact in near):
            meant = min(near, key=lambda pair: pair[0])[1]
            table |= {x: meant, -x: -meant}
    sizes: Sizes = dict.fromkeys(rounded_angles | {float(abs(cast("Any", x))) for x in table})
    put: list[AnsweredLine] = []
    typed = tuple(typed_in_names(lines))
    for line in lines:
        expr, few = _right_line(truth, cast("sp.Expr", line.expr.xreplace(table)), typed)
        read, more = in_exact_terms(truth, replace(line, expr=expr), typed)
        put.append(read)
        sizes |= few | dict.fromkeys(more)
    return (tuple(put), tuple(_told(sizes))) if sizes else (tuple(lines), ())


def _told(sizes: Sizes) -> Iterator[Text]:
    """What is said of numbers that were read as rounded, and of those whose last digit is off."""
    if told := sorted(x for x, meant in sizes.items() if meant is None):
        yield text(f"{', '.join(f'{x:.12g}' for x in told)} {'were' if len(told) > 1 else 'was'} read as rounded.")
    for x, meant in sorted((f"{x:.12g}", meant) for x, meant in sizes.items() if meant is not None):
        yield text(f"{x} was read as {meant:.{len(x.partition('.')[2])}f}: its last digit is off.")


def _rounded_angles(truth: Reference, lines: Sequence[AnsweredLine]) -> tuple[dict[sp.Basic, sp.Expr], set[float]]:
    """What sines and cosines are that have the rounded value of an angle of the system, sin(φ − 0.0698), and the sizes
    of these values."""
    found, sizes = dict[sp.Basic, sp.Expr](), set[float]()
    exact = [v for v in truth.values.values() if v.is_number and not v.is_Rational]
    for f in set().union(*(bounded.atoms(line.expr, sp.sin, sp.cos, sp.tan) for line in lines)) if exact else ():
        number, rest = cast("Any", f.args[0]).as_coeff_Add()
        for value in exact:
            meant = next((x for x in (value, -value) if number != 0 and _is_rounded_from(number, x)), None)
            if meant is not None:
                found[f] = f.func(rest + meant)
                sizes.add(abs(float(number)))
    return found, sizes


def with_prescribed_unrounded(
    truth: Reference, lines: Sequence[AnsweredLine]
) -> tuple[tuple[AnsweredLine, ...], tuple[Text, ...]]:
    """The same for lines in which prescribed motions still have their names: 454.429 φ̈ becomes, when it is written out
    with φ = 0.14 sin 0.9 t, a number whose digits tell nothing."""
    moving = [d.symbol for d in truth.model.definitions if d.moving]
    return unrounded(truth, lines) if any(line.expr.has(*moving) for line in lines if moving) else (tuple(lines), ())


def is_rounded(number: sp.Expr, value: float) -> bool:
    """Whether a decimal number is a value rounded to its last digit, and not the value itself."""
    exact = sp.Rational(str(value))
    return number != exact and _is_rounded_from(number, exact)


def is_true_number(line: AnsweredLine) -> bool:
    """Whether a line only says the value of a number, rounded: sin 20° = 0.3420, (0.4/3 + 0.3)*0.01 = 0.004333. It is
    no equation of motion."""
    if line.kind == "equation" and line.sides is not None and all(x.is_Rational for x in line.sides):
        value, number = line.sides
        return number not in (0, value) and _is_rounded_from(number, value)
    if line.kind != "equation" or not line.expr.is_Add or not line.expr.is_number:
        return False
    number, rest = line.expr.as_coeff_Add()
    return (
        _is_finite(rest) and number != 0 and any(_is_rounded_from(x, y) for x, y in ((-number, rest), (number, -rest)))
    )


def is_right_rounded(expr: sp.Expr, right: sp.Expr) -> bool:
    """Whether a sum is the right one, with numbers that may be rounded."""
    meant = {k: x for k, x in _sums(bounded.expand(right)).items() if x}
    own = {k: x for k, x in _sums(bounded.expand(expr)).items() if x}
    if own.keys() == meant.keys() and all(_is_finite(x) for x in (*own.values(), *meant.values())):
        return all(_same(own[k], x) or _is_rounded_from(own[k], x) for k, x in meant.items())
    return False


@lru_cache(maxsize=500)
def _right_line(truth: Reference, expr: sp.Expr, typed: tuple[sp.Rational, ...]) -> tuple[sp.Expr, Sizes]:
    """The one of the right lines that a line is, but for forces of constraints, if every number that differs is rounded
    from what stands there, and the sizes of these numbers; otherwise the line itself and none. Kept: an answer is
    judged several times."""
    if not bounded.atoms(expr, sp.Rational) or bounded.operations(expr) > LONGEST:
        return expr, {}
    for form, divided in _own_forms(truth, expr):
        own = {k: x for k, x in _sums(form).items() if x}
        forces = {k: x for k, x in own.items() if _is_force(truth, k)}
        own = {k: x for k, x in own.items() if k not in forces}
        if not all(map(_is_finite, own.values())):
            continue
        found, sizes = _right_sums(own, partial(_right_lines, truth))
        found, sizes = _divided(own, _right_lines(truth)) if divided and not sizes else (found, sizes)
        surds = any(not isinstance(x, sp.Rational) for x in own.values())  # of cos(θ/2 + π/4), multiplied out
        if not sizes and (typed or surds) and not forces:
            whole = form if divided else _with_sums_apart(expr)
            found, read = within_rounding(whole, typed, _right_lines(truth)) or (found, sizes)
            sizes = dict.fromkeys(read)
        if sizes:
            return sp.Add(*(k * x for k, x in (found | forces).items())), sizes
    return _right_row_at_states(truth, expr) or (expr, {})


def _right_row_at_states(truth: Reference, expr: sp.Expr) -> tuple[sp.Expr, Sizes] | None:
    """The right equation that a line is whose roots or divisors are written otherwise, √(0.365 − 0.275 cos θ) for a
    distance, if there is only one number for each of its terms with which it is this equation at all states, and those
    of the line are these, exact or rounded; None for another line."""
    own = {k: x for k, x in _sums(bounded.expand(expr)).items() if x}
    divided = any(p.is_Pow and p.args[0].is_Add and not p.args[1].is_Integer for k in own for p in bounded.each(k))
    if not divided or not 1 < len(own) <= truth.states.size - 2 or not all(x.is_Rational for x in own.values()):
        return None
    values = CompiledExpressions(list(own)).at(truth.states).T
    sizes = np.abs(values).max(axis=0)
    if not np.isfinite(values).all() or not np.isfinite(truth.W).all() or not sizes.all():
        return None
    for row, right in zip(truth.W, truth.rows, strict=True):
        numbers, _, rank, _ = np.linalg.lstsq(values / sizes, row, rcond=None)
        left = np.abs(values / sizes @ numbers - row).max()
        if rank < len(own) or left > FAR * np.abs(row).max():
            continue
        for sign in (1, -1):
            pairs = [(x, sign * float(c)) for x, c in zip(own.values(), numbers / sizes, strict=True)]
            off = [(x, c) for x, c in pairs if abs(_size(x) - c) > FAR * abs(c)]
            if off and all(_is_rounded_from(x, sp.Float(c)) for x, c in off):
                return sign * right, dict.fromkeys(abs(_size(x)) for x, _ in off)
    return None


def _own_forms(truth: Reference, expr: sp.Expr) -> Iterator[tuple[sp.Expr, bool]]:
    """A line expanded, with the sines and cosines of sums expanded, and times the sum by which it is ``divided``."""
    yield from ((x, False) for x in _forms(expr))
    if truth.values and (whole := cleared(expr)) is not expr:
        yield from ((x, True) for x in _forms(whole))


def _is_force(truth: Reference, moving: sp.Expr) -> bool:
    """Whether what moves holds a multiplier, whose scale is the answer's own."""
    return bool(truth.derivation.multipliers) and not bounded.letters(moving) <= truth.names


def _right_sums(
    own: dict[sp.Expr, sp.Expr], rights: Callable[[], Sequence[dict[sp.Expr, sp.Expr]]]
) -> tuple[dict[sp.Expr, sp.Expr], Sizes]:
    """The one of ``rights`` that sums are but for numbers that are rounded, and the sizes of these."""
    if any(last_digit(abs(x), 1) is None for x in own.values() if isinstance(x, sp.Rational)):
        return _divided(own, rights())
    numbers = {abs(x) for x in own.values() if isinstance(x, sp.Rational)}
    units: dict[Any, float] = {x: u for x in numbers if (u := last_digit(x, FEWEST_IN_RIGHT_LINE))}
    for right in rights() if units else ():
        if right.keys() != own.keys():
            continue
        exact = (own[k] / right[k] for k in own if abs(own[k]) not in units and right[k])
        for scale in dict.fromkeys((sp.S.One, sp.S.NegativeOne, *exact)):
            meant = {k: scale * x for k, x in right.items()}
            off = {abs(x): abs(_size(x) - _size(meant[k])) for k, x in own.items() if not _same(x, meant[k])}
            if not off or any(x not in units for x in off):
                continue
            sizes = {abs(own[k]): abs(_size(x)) for k, x in meant.items()}
            if all(far <= most_off(float(x), units[x], sizes[x]) for x, far in off.items()):
                return meant, {float(x): None if far <= HALF * units[x] else sizes[x] for x, far in off.items()}
    return own, {}


def _divided(
    own: dict[sp.Expr, sp.Expr], rights: Sequence[dict[sp.Expr, sp.Expr]]
) -> tuple[dict[sp.Expr, sp.Expr], Sizes]:
    """The same for a line that was divided by a number, as (454.43 φ̈ − 60 s)/269.80: what it was divided by is sought,
    so that all its numbers become decimals that are right ones or rounded from these."""
    for right in rights:
        if right.keys() != own.keys():
            continue
        for scale in dict.fromkeys(own[k] / x for k, x in right.items()):
            typed = {k: x / scale for k, x in own.items()}
            off = {k: x for k, x in typed.items() if not _same(x, right[k])}
            if off and scale.is_Rational and all(_is_rounded_from(x, right[k]) for k, x in off.items()):
                return {k: scale * x for k, x in right.items()}, dict.fromkeys(abs(float(x)) for x in off.values())
    return own, {}


def _is_rounded_from(number: sp.Expr, value: sp.Expr) -> bool:
    unit = last_digit(abs(number), FEWEST_IN_RIGHT_LINE) if isinstance(number, sp.Rational) else None
    return unit is not None and abs(_size(number) - _size(value)) <= HALF * unit


def _same(a: sp.Expr, b: sp.Expr) -> bool:
    return abs(_size(a) - _size(b)) <= 1e-12 * abs(_size(b))


@lru_cache(maxsize=5_000)
def _size(x: sp.Expr) -> float:
    """The value of a number; kept, as that of cosines of angles is long to find."""
    return float(x)


@lru_cache(maxsize=32)
def _right_lines(truth: Reference) -> tuple[dict[sp.Expr, sp.Expr], ...]:
    """The numbers by which what moves is multiplied in each of the right equations and energies."""
    found = [
        {k: x for k, x in _sums(form).items() if x and not _is_force(truth, k)}
        for expr in _right_expressions(truth)
        for form in _forms(expr)
    ]
    return tuple(own for own in found if own and all(_is_finite(x) for x in own.values()))


def last_digit(x: Any, fewest: int) -> float | None:
    """The unit of the last decimal of a number with enough digits; None for another one."""
    decimals = places(x)
    if decimals is None or decimals > 30 or digits(x, decimals) < fewest:
        return None
    return 10.0**-decimals


@lru_cache(maxsize=32)
def coefficients(truth: Reference) -> tuple[tuple[float, sp.Expr], ...]:
    """The sizes of all numbers by which motions are multiplied in the right equations and energies, and their ratios in
    each of them."""
    found: dict[sp.Expr, float] = {}
    for expr in _right_expressions(truth, eliminated=False):
        for form in _forms(expr):
            own = _coefficients(form)
            found.update(own)
            found.update(_amplitudes(form))
            few = [(a, x) for a, x in own.items() if bounded.operations(a) <= LONGEST_NUMBER][:MAX_COEFFICIENTS]
            found.update({a / b: x / y for a, x in few for b, y in few if y and a != b})
    found.update({value: float(value) for value in truth.values.values() if value.is_number})
    if truth.prescribed & truth.values.keys():  # where A and Ω stay letters, the factor of φ̈ is a number of its own
        left = {p: v for p, v in truth.values.items() if p not in truth.prescribed}
        found |= {exact: value for value, exact in coefficients(truth_of(truth.derivation).with_values(left))}
    return tuple((abs(value), exact if value > 0 else -exact) for exact, value in found.items() if value)


def _right_expressions(truth: Reference, *, eliminated: bool = True) -> Iterator[sp.Expr]:
    """The right equations, energies, forces and constraints; √a = b also as a = b². ``eliminated``: also equations from
    which accelerations were eliminated."""
    yield from (*truth.rows, *_solved(truth), *(_eliminated(truth) if eliminated else ()), truth.T, truth.V, *truth.Xi)
    for row in rows_of(truth.model):
        yield truth.expand(row.rate)
        if row.position is None:
            continue
        position = truth.expand(row.position)
        yield position
        for root in sp.Add.make_args(position):
            if root.is_Pow and root.args[1] == sp.S.Half:
                yield cast("sp.Expr", root.args[0]) - (position - root) ** 2


def _forms(expr: sp.Expr) -> Iterator[sp.Expr]:
    """An expression expanded, and with the sines and cosines of sums expanded."""
    if bounded.operations(expr) > LONGEST:
        return
    yield bounded.expand(expr)
    if (apart := _with_sums_apart(expr)) is not expr:
        yield bounded.expand(apart)


def _with_sums_apart(expr: sp.Expr) -> sp.Expr:
    """An expression with the sines and cosines of sums expanded; itself if it has none."""
    sums = {f: sp.expand_trig(f) for f in expr.atoms(sp.sin, sp.cos) if f.args[0].is_Add}
    return cast("sp.Expr", expr.xreplace(sums)) if sums else expr


def _sums(expr: sp.Expr) -> dict[sp.Expr, sp.Expr]:
    """The factors of what moves in an expanded expression."""
    sums: dict[sp.Expr, sp.Expr] = {}
    for term in sp.Add.make_args(expr):
        number, moving = _parted(term)
        sums[moving] = sums.get(moving, sp.S.Zero) + number
    return sums


@lru_cache(maxsize=5_000)
def _parted(term: sp.Expr) -> tuple[sp.Expr, sp.Expr]:
    """The number of a term and what moves, kept: lines have many terms in common."""
    return term.as_independent(AppliedUndef, sp.Derivative, time, sp.Symbol, as_Add=False)


def _is_finite(x: sp.Expr) -> bool:
    return bool(x.is_number and x.is_finite and x.is_real)


def _coefficients(expr: sp.Expr) -> dict[sp.Expr, float]:
    """The numbers by which what moves is multiplied in an expanded expression."""
    return {x: _size(x) for x in _sums(expr).values() if _is_finite(x)}


def _amplitudes(expr: sp.Expr) -> dict[sp.Expr, float]:
    """The numbers c of c cos(α + φ) that stand expanded as a cos α + b sin α, with a and b that are no fractions."""
    sums = {k: x for k, x in _sums(expr).items() if _is_finite(x) and not isinstance(x, sp.Rational)}
    found: dict[sp.Expr, float] = {}
    for moving, a in list(sums.items())[:MAX_COEFFICIENTS]:
        for f in sp.Mul.make_args(moving):
            b = sums.get(moving / f * sp.sin(f.args[0])) if isinstance(f, sp.cos) else None
            if b is not None and bounded.operations(a) + bounded.operations(b) <= LONGEST_NUMBER:
                c = cast("sp.Expr", sp.sqrt(bounded.expand(a**2 + b**2)))
                found[c] = _size(c)
    return found


@lru_cache(maxsize=32)
def _solved(truth: Reference) -> tuple[sp.Expr, ...]:
    """The right equations solved for the accelerations, if their mass matrix consists of numbers."""
    M = truth.mass_matrix
    if truth.n > MAX_SOLVED or not all(x.is_number for x in M.flat()) or M.det() == 0:
        return ()
    return tuple((M.inv() * sp.Matrix(truth.rows)).flat())


def _eliminated(truth: Reference) -> list[sp.Expr]:
    """The right equations from which the accelerations of other coordinates are eliminated, if these are multiplied by
    numbers there, in a small system with values."""
    if not truth.values or not 1 < truth.n <= MAX_ELIMINATED:
        return []
    M = truth.mass_matrix
    found: list[sp.Expr] = []
    for i in range(truth.n):
        others = [j for j in range(truth.n) if j != i]
        for size in range(1, truth.n):
            for out in combinations(others, size):
                inner = M.extract(list(out), list(out))
                if not all(x.is_number for x in inner.flat()) or inner.det() == 0:
                    continue
                factors = M.extract([i], list(out)) * inner.inv()
                row = truth.rows[i] - sum(f * truth.rows[j] for f, j in zip(factors.flat(), out, strict=True))
                form = truth.form(row)  # sin² + cos² is 1
                found.append(row if form is None else form.expr())
    return found
