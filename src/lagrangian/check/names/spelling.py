"""Interprets unknown names, and numbers in place of names, and reports the interpretation."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import islice, permutations
from math import isclose, pi
from typing import Any, cast

import numpy as np
import sympy as sp

from lagrangian import bounded
from lagrangian.check.align import agreement, fit
from lagrangian.check.names.values_at_rest import values_at_rest
from lagrangian.check.reference import Reference
from lagrangian.check.rows import DOUBLE_TOLERANCE
from lagrangian.check.verdict import AnsweredLine
from lagrangian.derive.sampling import CompiledExpressions
from lagrangian.errors import did_you_mean
from lagrangian.model import Model, time
from lagrangian.page.formula import Text, text
from lagrangian.page.plain import plain
from lagrangian.quantities.quantity import unit_dimension
from lagrangian.records import dataclass

MAX_READINGS = 120
"""The largest number of interpretations of unknown names that are tried."""
MAX_WRONG_READINGS = 24
"""The same for an answer that is wrong with all of them."""
COMMON = frozenset([sp.S.Zero, sp.S.Half, sp.S.One])
"""Numbers that stand in almost every equation in letters."""
_ACCELERATION = unit_dimension("m/s^2")
PLAIN = frozenset(sp.Rational(a, b) for a in range(5) for b in range(1, 5))
"""Numbers that stand in many equations without being the value of a parameter."""


@dataclass(frozen=True)
class Spelling:
    """The lines after names were interpreted, and the interpretations."""

    lines: tuple[AnsweredLine, ...]
    notes: tuple[Text, ...] = ()


def spelled(truth: Reference, lines: Sequence[AnsweredLine], *, numbers: bool = True) -> Spelling:
    """Read unknown constants as parameters that the answer lacks, and numbers as the parameters with these values.

    Without ``numbers``, numbers are not interpreted.
    """
    lines, notes = _numbers(truth, tuple(lines)) if numbers else (tuple(lines), ())
    known = {p.symbol for p in truth.model.parameters} | {time}
    used = _constants(lines)
    unknown = sorted(used - known - set(values_at_rest(truth.model, lines).values()), key=str)
    if not unknown:
        return Spelling(lines, notes)
    free = sorted(known - used - {time} - truth.values.keys(), key=str)
    inputs = [u.symbol for u in truth.model.inputs if not any(line.expr.has(u.symbol) for line in lines)]
    for reading in _readings(unknown, [*free, *inputs]):
        put = tuple(replace(line, expr=cast("sp.Expr", line.expr.xreplace(reading))) for line in lines)
        if may_be_right(truth, put):
            return Spelling(put, (*notes, *(_read(a, b) for a, b in reading.items())))
    close = _likeliest(truth, lines, unknown, [*free, *inputs]) or _closest(unknown, [*free, *inputs])
    put = tuple(replace(line, expr=cast("sp.Expr", line.expr.xreplace(close))) for line in lines)
    stated = [
        line.expr for line in put if line.kind != "definition"
    ]  # what definitions have, these have if they use it
    left = [s for s in unknown if s not in close and any(x.has(s) for x in stated)]
    told = [_read(a, b) for a, b in close.items()]
    told += [not_there(truth.model, s) for s in left]
    return Spelling(put, (*notes, *told))


def not_there(model: Model, symbol: sp.Basic) -> Text:
    """Report that the system has no such symbol, and which of its names is nearest."""
    hint = did_you_mean(plain(symbol), model.symbols)
    return text(f"The system has no '{plain(symbol)}'.{f' {hint}' if hint else ''}")


def in_numbers(truth: Reference, lines: Sequence[AnsweredLine]) -> bool:
    """Whether an answer names no parameter but contains numbers that can only be values of parameters.

    It may name angles, as 39.24 sin α does, and those of prescribed motions, as 454.43 φ̈ does when φ = A sin Ωt is
    written out.
    """
    known = names_of(truth)
    numbers = {abs(x) for line in lines for x in bounded.atoms(line.expr, sp.Rational, sp.Float)}
    return not any(bounded.symbols(line.expr) & known for line in lines) and bool(numbers - PLAIN)


def names_of(truth: Reference) -> set[sp.Basic]:
    """The parameters that an answer in numbers does not name: all but angles and those of prescribed motions."""
    return {p.symbol for p in truth.model.parameters if p.symbol not in truth.prescribed | truth.angles}


def _read(written: sp.Basic, meant: sp.Basic) -> Text:
    return text(f"'{plain(written)}' was read as ", cast("sp.Expr", meant), ".")


def _readings(unknown: Sequence[sp.Basic], free: Sequence[sp.Expr]) -> list[dict[sp.Basic, sp.Expr]]:
    if len(unknown) > 3 or len(free) < len(unknown):
        return []
    picked = islice(permutations(free, len(unknown)), MAX_READINGS)
    return [dict(zip(unknown, p, strict=True)) for p in picked]


def _likeliest(
    truth: Reference, lines: Sequence[AnsweredLine], unknown: Sequence[sp.Basic], free: Sequence[sp.Expr]
) -> dict[sp.Basic, sp.Expr]:
    """The reading of a wrong answer in which most of its terms agree with right ones; empty if none stands out."""
    near = _closest(unknown, free)
    first = sorted(free, key=lambda p: p not in near.values())
    scored = [
        (agreement(truth, [replace(x, expr=cast("sp.Expr", x.expr.xreplace(table))) for x in lines]), table)
        for table in _readings(unknown, first)[:MAX_WRONG_READINGS]
    ]
    scored.sort(key=lambda x: -x[0])
    if not scored or scored[0][0] <= agreement(truth, lines):
        return {}
    return scored[0][1] if len(scored) == 1 or scored[0][0] > scored[1][0] + 0.5 else {}


def _closest(unknown: Sequence[sp.Basic], free: Sequence[sp.Expr]) -> dict[sp.Basic, sp.Expr]:
    """Every unknown name as the nearest name that the answer lacks; if there is one of each, they are matched."""
    if len(unknown) == 1 and len(free) == 1:
        return {unknown[0]: free[0]}
    found: dict[sp.Basic, sp.Expr] = {}
    names = {plain(s): s for s in free}
    for s in unknown:
        for name in names:
            if name.lower() == plain(s).lower() or did_you_mean(plain(s), [name]):
                found[s] = names.pop(name)
                break
    return found


def may_be_right(truth: Reference, lines: Sequence[AnsweredLine]) -> bool:
    """Whether the equations vanish along the true motion, or the energies are right, in doubles."""
    for line in lines:
        if line.kind == "equation":
            compiled = CompiledExpressions([line.expr])
            truly = compiled.at(truth.states, truth.accelerations)
            scale = np.abs(compiled.at(truth.states)).max()
            if not np.isfinite(truly).all() or np.abs(truly).max() > DOUBLE_TOLERANCE * scale:
                return False
        elif line.kind in ("T", "V", "L"):
            right = truth.energies[line.kind]
            rest = CompiledExpressions([line.expr - right]).at(truth.states)[0].reshape(2, -1)
            if not np.isfinite(rest).all() or np.abs(rest - rest[:, :1]).max() > 1e-6:
                return False
    return True


def _numbers(truth: Reference, lines: tuple[AnsweredLine, ...]) -> tuple[tuple[AnsweredLine, ...], tuple[Text, ...]]:
    """Numbers that can only be the value of a parameter that the answer lacks, such as 9.81 for g."""
    used = {s for line in lines for s in bounded.letters(line.expr)}
    table: dict[sp.Basic, sp.Expr] = {}
    notes: list[Text] = []
    for p in truth.model.parameters:
        if p.value is None or p.symbol in used or p.symbol in truth.values or float(p.value).is_integer():
            continue
        number: Any = sp.Rational(str(p.value))
        held = [line for line in lines if line.expr.has(number)] if number.q > 2 and number not in table else []
        if held and (number not in PLAIN or any(_writes(line.text, p.value) for line in held)):
            table[number] = p.symbol
            notes.append(text(f"{p.value:g} was read as ", p.symbol, "."))
    if not table:
        return lines, ()
    return tuple(replace(line, expr=cast("sp.Expr", line.expr.xreplace(table))) for line in lines), tuple(notes)


def _writes(written: str, value: object) -> bool:
    """Whether a text has a value as a decimal, 0.25 or 0,25, and not as the ¼ of an energy."""
    return f"{value:g}" in written.replace(",", ".")


def values_of(truth: Reference, lines: Sequence[AnsweredLine]) -> dict[sp.Symbol, sp.Expr]:
    """The values of the parameters that an answer does not name; angles in degrees are parts of π, as in cos 25°,
    unless the answer has their value in radians."""
    used = _constants(lines)
    numbers = {x for line in lines for x in bounded.atoms(line.expr, sp.Rational)}
    put = truth.values.keys()
    left = ((p, v) for p, v in truth.model.values.items() if p not in used and p not in put)
    exact = ((p, v, sp.Rational(str(v))) for p, v in left)
    return {p: value if value in numbers else _part_of_pi(v) or value for p, v, value in exact}


def _part_of_pi(value: float) -> sp.Expr | None:
    """An angle of some degrees, which no decimal number is, as a part of π: the cosine of 30° is √3/2.

    None if the degrees have more than four decimals.
    """
    degrees = round(value * 180 / pi, 4)
    same = value != 0 and isclose(degrees * pi / 180, value, rel_tol=1e-14)
    return cast("sp.Expr", sp.Rational(str(degrees)) * sp.pi / 180) if same else None


def names_values(truth: Reference, lines: Sequence[AnsweredLine]) -> bool:
    """Whether an answer names a parameter that has a value: one whose value is 1 may then just have been forgotten."""
    return not _constants(lines).isdisjoint(truth.model.values)


def values_meant(truth: Reference, lines: Sequence[AnsweredLine]) -> dict[sp.Symbol, sp.Expr]:
    """The values that a wrong answer has in place of letters, some of which it may keep, as k in 3 x″ + k x = F; none
    unless most of what it says fits with them, and less without, or if it is `in_numbers` anyway.

    A letter whose value is 0 is never among them: it may have been forgotten. One whose value is 1 is among them only
    if it can not just have been forgotten: the answer then names none of its dimension, and has values of others in
    numbers, beside those of g and of angles.
    """
    judged = [x for x in lines if x.kind in ("T", "V", "L", "Xi", "equation")]
    numbers = {abs(x) for line in judged for x in bounded.atoms(line.expr, sp.Rational)}
    every = {p: v for p, v in values_of(truth, judged).items() if v != 0}
    ones = {p: v for p, v in every.items() if v == 1}
    values = {p: v for p, v in every.items() if v != 1}
    if not values or numbers <= COMMON.difference(values.values()) or in_numbers(truth, lines):
        return {}
    before = fit(truth, judged)[0]
    named = _dimensions(truth, _constants(judged))
    if ones and (not named or (None not in named and named.isdisjoint(_dimensions(truth, ones) | {None}))):
        apart = {p: v for p, v in every.items() if v == 1 or _dimensions(truth, [p]) <= {_ACCELERATION}}
        values = every if _fit(truth, judged, every) > _fit(truth, judged, apart) else values
    found, count = fit(truth.with_values(values), judged)
    return values if found > before and 2 * found > count else {}


def substituted(values: Iterable[sp.Symbol], exprs: Sequence[sp.Expr] = ()) -> Text:
    """Say of which parameters the values are put in, where some have a place in expressions, of these alone."""
    used = set[sp.Basic]().union(*(expr.free_symbols for expr in exprs))
    every = sorted(values, key=str)
    symbols = [p for p in every if p in used] or every
    named = [x for p in symbols for x in (p, ", ")][:-1]
    return (
        text("The value of ", *named, " is substituted.")
        if len(symbols) == 1
        else text("The values of ", *named, " are substituted.")
    )


def _fit(truth: Reference, lines: Sequence[AnsweredLine], values: Mapping[sp.Symbol, sp.Expr]) -> float:
    return fit(truth.with_values(values), lines)[0]


def _dimensions(truth: Reference, named: Collection[sp.Basic]) -> set[object]:
    """The dimensions of parameters that are no angles; None, if one has no unit."""
    own = {p.symbol: p.unit for p in truth.model.parameters if p.symbol not in truth.angles}
    units = [unit for p, unit in own.items() if p in named]
    return {None if unit is None else unit_dimension(unit) for unit in units}


def _constants(lines: Sequence[AnsweredLine]) -> set[sp.Basic]:
    """The constants, and the time, that an answer names."""
    return {x for line in lines for x in bounded.symbols(line.expr)}
