"""Lines in numbers, term by term beside a right one: 1.3883 + 2.744 sin²θ where 4.1323… − 2.744 cos²θ is right.

What a line is made of, θ̇² and θ̇² sin²θ, is what the right one is written in too: its numbers are found exactly, in
the normal form. A number of the line that is one of these within the rounding of the digits that are written is read as
it, and so are those of a line in which another term is wrong.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import islice
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.decimals import digits, places
from lagrangian.check.reference import Reference
from lagrangian.check.stated import right_value
from lagrangian.check.verdict import AnsweredLine
from lagrangian.records import dataclass

FEWEST_DIGITS = 3
"""The fewest significant digits of a number that may be rounded."""
MOST_NUMBERS = 24
"""The most numbers of a line that is read so."""
MOST_TERMS = 40
"""The most terms of such a line when it is multiplied out."""
FEWEST_RIGHT = 2
"""The fewest terms by which an equation is one of the right ones."""
LONGEST_TYPED = 4
"""The most digits of a decimal that is taken as typed, and not as a product of one that is typed elsewhere."""
MOST_POWER = 3
LONGEST = 400
"""The most operations of a line whose numbers are sought so."""
EXACT = 1e-12
MOST_PLACES = 60
MOST_ROUNDED = 30
SLACK = 1 + 1e-9
_DECIMAL = re.compile(r"(?<![\w.])\d{1,9}\.\d{2,12}(?![\w.])|(?<![\w.])\d{1,9}\.\d{2,12}(?=[^\W\d])")

Vector = dict[Any, Fraction]


@dataclass(frozen=True)
class NumberWritten:
    """A decimal of a line, the letter that is put for it, and half the unit of its last digit."""

    value: sp.Rational
    letter: sp.Symbol
    half: float


@dataclass(frozen=True)
class TermWritten:
    """The number of a term, in the letters put for decimals, its value, and how far this may be off by rounding."""

    number: sp.Expr
    value: Fraction
    off: float

    def meant(self, right: Fraction) -> Fraction:
        """What the number is meant to be where ``right`` belongs: this, or its opposite, if that is all that is wrong;
        otherwise what was written."""
        signed = right if (right < 0) == (self.value < 0) else -right
        return signed if abs(float(self.value - signed)) <= self.off * SLACK else self.value


def in_exact_terms(
    truth: Reference, line: AnsweredLine, typed: Sequence[sp.Rational] = ()
) -> tuple[AnsweredLine, set[float]]:
    """A line with its rounded numbers replaced by what they are rounded from, and the sizes of these numbers; ``typed``
    are the decimals of names that it may use."""
    opened, numbers = _opened(line.expr, typed)
    written = _terms(opened, numbers) if 0 < len(numbers) <= MOST_NUMBERS else None
    if not written or len(written) > MOST_TERMS or all(x.off == 0 for x in written.values()):
        return line, set()
    vectors = {k: v for k in written if (v := _vector(truth, k)) is not None}
    if len(vectors) < len(written):
        return line, set()
    best: tuple[int, dict[sp.Expr, Fraction]] | None = None
    for right in _rights(truth, line):
        found = _meant(written, vectors, right)
        if found is not None and (best is None or found[0] > best[0]):
            best = found
    changed = {k for k, x in best[1].items() if x != written[k].value} if best else set[sp.Expr]()
    if best is None or not changed or (line.kind == "equation" and best[0] < min(FEWEST_RIGHT, len(written))):
        return line, set()
    letters = set[sp.Basic]().union(*(written[k].number.free_symbols for k in changed))
    sizes = {abs(float(n.value)) for n in numbers if n.letter in letters}
    return replace(line, expr=_as_written(opened, numbers, written, best[1])), sizes


def within_rounding(
    expr: sp.Expr, typed: Sequence[sp.Rational], rights: Sequence[Mapping[sp.Expr, sp.Expr]]
) -> tuple[dict[sp.Expr, sp.Expr], set[float]] | None:
    """The one of ``rights``, or its opposite, of which every number is what stands there within the rounding of the
    decimals from which it is multiplied out, and the sizes of these decimals; None if there is none."""
    opened, numbers = _opened(expr, typed)
    if not 0 < len(numbers) <= MOST_NUMBERS or bounded.operations(opened) > LONGEST:
        return None
    written = _sums_written(opened, numbers)
    for right in rights:
        if written is None or right.keys() != written.keys():
            continue
        for sign in (1, -1):
            far = {k: abs(value - sign * float(right[k])) for k, (value, _, _) in written.items()}
            if all(far[k] <= off * SLACK for k, (_, off, _) in written.items()):
                rounded = set[Any]().union(*(x for k, (v, _, x) in written.items() if far[k] > EXACT * abs(v)))
                read = [n.value for n in numbers if n.letter in rounded]
                decimals = [x for x in read if x.q != 1] or read
                return {k: sign * x for k, x in right.items()}, {abs(float(x)) for x in decimals}
    return None


def _sums_written(
    opened: sp.Expr, numbers: Sequence[NumberWritten]
) -> dict[sp.Expr, tuple[float, float, set[Any]]] | None:
    """What moves in the terms of a line, with its number, how far this may be off and the letters of its decimals; None
    if one has no size."""
    letters = {n.letter: n for n in numbers}
    table = {n.letter: n.value for n in numbers}
    sums: dict[sp.Expr, sp.Expr] = {}
    for term in sp.Add.make_args(bounded.expand(opened)):
        still, moving = _parts(term, letters)
        sums[moving] = sums.get(moving, sp.S.Zero) + still
    found: dict[sp.Expr, tuple[float, float, set[Any]]] = {}
    for moving, number in sums.items():
        value = cast("Any", number.xreplace(table))
        if not value.is_number or not value.is_finite or not value.is_real:
            return None
        slopes: dict[Any, Any] = {x: sp.diff(number, x).xreplace(table) for x in number.free_symbols & letters.keys()}
        off = sum(abs(float(slope)) * letters[x].half for x, slope in slopes.items())
        if abs(float(value)) > 0:
            found[moving] = float(value), off + EXACT * abs(float(value)), set(slopes)
    return found


def _rights(truth: Reference, line: AnsweredLine) -> Iterator[Vector]:
    """What a line may have to be, in normal form; V without its constant."""
    if line.kind == "equation":
        exprs = list(truth.rows)
    else:
        i = next((k for k, c in enumerate(truth.model.coordinates) if c.name == line.name), None)
        own = right_value(truth, line, i) if line.kind not in ("identity", "statement", "definition") else None
        exprs = [own] if own is not None and own != 0 else []
    for expr in exprs:
        if (found := _vector(truth, expr)) is not None:
            yield {k: x for k, x in found.items() if line.kind not in ("V", "L") or k != ((0, 0), 0)}


def _vector(truth: Reference, expr: sp.Expr) -> Vector | None:
    """The numbers of the terms of a normal form; None if it has none, or has functions that it does not know."""
    form = truth.form(expr)
    if form is None or form.opaque():
        return None
    return {(h, m): Fraction(c, form.den) for h, p in form.parts.items() for m, c in p.items()}


# -- the numbers of a line --------------------------------------------------------------------------------------------


def typed_in_names(lines: Sequence[AnsweredLine]) -> list[sp.Rational]:
    """The decimals that definitions of an answer have: 0.93969 of rho = 0.5 + 0.93969 s."""
    texts = [line.text for line in lines if line.kind in ("definition", "identity")]
    found = dict.fromkeys(m.group() for x in texts for m in islice(_DECIMAL.finditer(x), MOST_NUMBERS))
    rational = [cast("sp.Rational", sp.Rational(x)) for x in islice(found, MOST_NUMBERS)]
    return [x for x in rational if x.q != 1 and _unit(x)]


def _parted(number: sp.Rational, typed: Sequence[sp.Rational]) -> tuple[sp.Rational, sp.Rational, int]:
    """A decimal as a shorter one times a power of a decimal that was typed, which is 0 where it is not made so: 75.175
    times 0.93969."""
    long = _digits(number)
    ways = [(number / x**p, x, p) for x in typed for p in range(1, MOST_POWER + 1)] if long > LONGEST_TYPED else []
    short = [(way, _digits(way[0])) for way in ways]
    fitting = [(count, way) for way, count in short if 0 < count <= long - 2 * way[2]]
    best = min(fitting, key=lambda x: (x[0], x[1][2]), default=(0, (number, sp.S.One, 0)))
    return cast("tuple[sp.Rational, sp.Rational, int]", best[1])


def _digits(x: sp.Rational) -> int:
    """How many digits a decimal has; 0 for a number that is none."""
    decimals = places(x)
    return digits(x, decimals) if decimals is not None and decimals < MOST_PLACES else 0


def _opened(expr: sp.Expr, typed: Sequence[sp.Rational] = ()) -> tuple[sp.Expr, list[NumberWritten]]:
    """An expression with a letter for every decimal in its sums and products, and these decimals."""
    numbers: list[NumberWritten] = []

    def lettered(x: sp.Rational) -> sp.Expr:
        if not (half := _half_unit(cast("sp.Rational", abs(x)))):
            return x
        numbers.append(NumberWritten(x, sp.Dummy(), half))
        return numbers[-1].letter

    def walk(x: Any) -> Any:
        if isinstance(x, sp.Rational):
            first, other, power = _parted(x, typed) if typed else (x, x, 0)
            return lettered(first) * lettered(other) ** power if power else lettered(x)
        if isinstance(x, sp.Add | sp.Mul):
            return x.func(*[walk(y) for y in x.args])
        if isinstance(x, sp.Pow):
            return x.func(walk(x.args[0]), x.args[1])
        return x

    return cast("sp.Expr", walk(expr)), numbers


def _half_unit(x: Any) -> float:
    """Half the unit of the last digit of a decimal with enough digits; 0 for another number. One that ends in 5 may be
    half a rounded one: 0.69415 for ½ · 1.3883."""
    return max((f * u for f, y in ((0.5, x), (0.25, 2 * x)) if (u := _unit(y))), default=0.0)


def _unit(x: Any) -> float:
    decimals = places(x)
    if decimals is None or decimals >= MOST_ROUNDED or digits(x, decimals) < FEWEST_DIGITS:
        return 0.0
    return 10.0**-decimals


def _parts(term: sp.Expr, letters: Mapping[sp.Symbol, NumberWritten]) -> tuple[sp.Expr, sp.Expr]:
    """The number of a term, in the letters put for decimals, and what moves in it."""
    factors = sp.Mul.make_args(term)
    still = [f for f in factors if f.free_symbols <= letters.keys() and not f.has(AppliedUndef, sp.Derivative)]
    return cast("sp.Expr", sp.Mul(*still)), cast("sp.Expr", sp.Mul(*[f for f in factors if f not in still]))


def _terms(opened: sp.Expr, numbers: Sequence[NumberWritten]) -> dict[sp.Expr, TermWritten] | None:
    """What moves in the terms of a line, with its numbers; None if some are no rational numbers."""
    letters = {n.letter: n for n in numbers}
    sums: dict[sp.Expr, sp.Expr] = {}
    for term in sp.Add.make_args(bounded.expand(opened)):
        still, moving = _parts(term, letters)
        sums[moving] = sums.get(moving, sp.S.Zero) + still
    table = {n.letter: n.value for n in numbers}
    found: dict[sp.Expr, TermWritten] = {}
    for moving, number in sums.items():
        value = number.xreplace(table)
        if not isinstance(value, sp.Rational):
            return None
        slopes: dict[Any, Any] = {x: sp.diff(number, x).xreplace(table) for x in number.free_symbols}
        off = sum(abs(float(slope)) * letters[x].half for x, slope in slopes.items())
        if value != 0:
            found[moving] = TermWritten(number, Fraction(int(value.p), int(value.q)), float(off))
    return found


# -- beside the right numbers -----------------------------------------------------------------------------------------


def _meant(
    written: Mapping[sp.Expr, TermWritten], vectors: Mapping[sp.Expr, Vector], right: Vector
) -> tuple[int, dict[sp.Expr, Fraction]] | None:
    """How many numbers of a line are right ones, in the better of both signs, and what all are meant to be."""
    solved = [(group, _solved([vectors[k] for k in group], right)) for group in _groups(vectors)]
    exact = {k: x for group, found in solved if found for k, x in zip(group, found, strict=True)}
    if not exact:
        return None
    best: tuple[int, dict[sp.Expr, Fraction]] | None = None
    for sign in (1, -1):
        meant = {k: x.value for k, x in written.items()}
        meant |= {k: written[k].meant(sign * x) for k, x in exact.items()}
        count = sum(meant[k] == sign * x for k, x in exact.items())
        best = (count, meant) if best is None or count > best[0] else best
    return best


def _groups(vectors: Mapping[sp.Expr, Vector]) -> list[list[sp.Expr]]:
    """The terms, those together that have something in common in normal form."""
    groups: list[tuple[set[Any], list[sp.Expr]]] = []
    for k, vector in vectors.items():
        own, members = set(vector), [k]
        for at, others in [g for g in groups if not g[0].isdisjoint(own)]:
            groups = [g for g in groups if g[1] is not others]
            own, members = own | at, [*others, *members]
        groups.append((own, members))
    return [members for _, members in groups]


def _solved(columns: Sequence[Vector], right: Vector) -> list[Fraction] | None:
    """The only numbers with which the columns add up to what the right side has of their keys; None if there are none,
    or others too."""
    keys = dict.fromkeys(k for x in columns for k in x)
    rows = [[*(x.get(k, Fraction(0)) for x in columns), right.get(k, Fraction(0))] for k in keys]
    n = len(columns)
    for j in range(n):
        pivot = next((i for i in range(j, len(rows)) if rows[i][j]), None)
        if pivot is None:
            return None
        rows[j], rows[pivot] = rows[pivot], rows[j]
        rows[j] = [x / rows[j][j] for x in rows[j]]
        for i in range(len(rows)):
            if i != j and (times := rows[i][j]):
                rows[i] = [x - times * y for x, y in zip(rows[i], rows[j], strict=True)]
    return None if any(r[n] for r in rows[n:]) else [rows[j][n] for j in range(n)]


def _as_written(
    opened: sp.Expr,
    numbers: Sequence[NumberWritten],
    written: Mapping[sp.Expr, TermWritten],
    meant: Mapping[sp.Expr, Fraction],
) -> sp.Expr:
    """The line with what its numbers are meant to be: in its own form where each has one value, or multiplied out."""
    values = {n.letter: cast("sp.Expr", n.value) for n in numbers}
    exact = {k: sp.Rational(x.numerator, x.denominator) for k, x in meant.items()}
    for k, x in written.items():
        letters = x.number.free_symbols
        if meant[k] != x.value and len(letters) == 1:
            letter = cast("sp.Symbol", next(iter(letters)))
            slope = sp.diff(x.number, letter)
            if slope.is_Rational and slope != 0:
                values[letter] += (exact[k] - x.number.xreplace(values)) / slope
    if all(x.number.xreplace(values) == exact[k] for k, x in written.items()):
        return cast("sp.Expr", opened.xreplace(values))
    return cast("sp.Expr", sp.Add(*(k * x for k, x in exact.items())))
