"""What an answer says about names before it uses them: implicit definitions, speeds, and values of parameters.

``2*zeta*wn = c/m`` says what zeta is, ``[theta'; omega'] = [omega; …]`` what omega is, and ``J = m*R^2/2`` what a
parameter of the system is taken to be: the answer is then judged under that assumption, and the verdict says so.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set
from dataclasses import replace
from itertools import permutations
from math import isclose
from typing import Any, cast

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.names.spelling import may_be_right
from lagrangian.check.names.values_at_rest import constants_subtracted, equations_at_rest, with_work_at_rest
from lagrangian.check.reference import Reference
from lagrangian.check.rounded import is_rounded
from lagrangian.check.verdict import AnsweredLine
from lagrangian.derive.sampling import CompiledExpressions
from lagrangian.model import time
from lagrangian.page.formula import Text, text
from lagrangian.page.plain import plain
from lagrangian.records import dataclass

MAX_LINES = 12
"""The largest number of implicit definitions in one answer."""

LONGEST = 80
"""The largest number of operations of an implicit definition."""

MAX_SPEEDS = 4
"""The largest number of speeds for which meanings are sought."""


@dataclass(frozen=True)
class Declared:
    """The lines with names written out, and the parameters that the answer expresses in others."""

    lines: tuple[AnsweredLine, ...]
    values: dict[sp.Symbol, sp.Expr]

    def told(self, truth: Reference) -> Text | None:
        """The assumptions, in words: J = ½ m R², L = 1; None if they are the system's own values."""
        own = truth.model.values
        assumed = {p: v for p, v in self.values.items() if p not in own or not _are_equal(v, float(own[p]))}
        parts: list[Any] = []
        for parameter, value in assumed.items():
            number = f"{float(value):.15g}" if isinstance(value, sp.Rational) else value
            parts += [parameter, " = ", number, ", "]
        return text(*parts[:-1]) if parts else None

    def unrounded(self, truth: Reference) -> Declared:
        """The same without values that are those of the system but for their last digit: A = 0.139626, which is 8°."""
        own = truth.model.values
        kept = {p: v for p, v in self.values.items() if p not in own or not is_rounded(v, float(own[p]))}
        return self if len(kept) == len(self.values) else replace(self, values=kept)


def declared(truth: Reference, lines: Sequence[AnsweredLine]) -> Declared:
    """Return the lines with implicit definitions and speeds written out, and what is assumed about parameters."""
    found, table = _implicit(truth, lines)
    found = tuple(_put(line, table) for line in found)
    at_rest = {x: cast("sp.Expr", v.xreplace(table)) for x, v in constants_subtracted(truth.model, lines).items()}
    if at_rest:
        found = with_work_at_rest(truth, found, at_rest, lambda some: may_be_right(truth, some))
    speeds = _stated_speeds(truth, found)
    if speeds:
        found = tuple(_put(_without(line, speeds), speeds) for line in found)
    return Declared(*_assumed(truth, found))


def _are_equal(value: sp.Expr, number: float) -> bool:
    """Whether a value is a number but for the rounding of π in it."""
    return bool(value.is_number) and isclose(float(value), number, rel_tol=1e-12)


def _put(line: AnsweredLine, table: dict[sp.Basic, sp.Expr]) -> AnsweredLine:
    return replace(line, expr=cast("sp.Expr", line.expr.xreplace(table))) if table else line


# -- implicit definitions ---------------------------------------------------------------------------------------------


def _implicit(
    truth: Reference, lines: Sequence[AnsweredLine]
) -> tuple[tuple[AnsweredLine, ...], dict[sp.Basic, sp.Expr]]:
    """The lines, those that define names marked as definitions, and the value of each name."""
    model = truth.model
    known = {p.symbol for p in model.parameters} | {cast("sp.Symbol", d.symbol) for d in model.definitions}
    lines = _in_new_names(truth, lines, known)
    waiting = {k: line.expr for k, line in enumerate(lines) if line.kind == "equation" and _constant(line.expr, known)}
    at_rest = (x for x in equations_at_rest(truth, lines) if _constant(x, known))
    waiting |= {len(lines) + k: x for k, x in enumerate(at_rest)}
    if not waiting or len(waiting) > MAX_LINES:
        return tuple(lines), {}
    used = [bounded.symbols(line.expr) for k, line in enumerate(lines) if k not in waiting]
    table: dict[sp.Basic, sp.Expr] = {}
    done: set[int] = set()
    while waiting:
        ranked = sorted(waiting, key=lambda k: (len(waiting[k].free_symbols - known), k))
        solved = next(((k, x) for k in ranked if (x := _first(waiting[k], known, used)) is not None), None)
        if solved is None:
            break
        k, (name, value) = solved
        done.add(k)
        del waiting[k]
        table = {n: cast("sp.Expr", v.xreplace({name: value})) for n, v in table.items()} | {name: value}
        waiting = {j: cast("sp.Expr", e.xreplace({name: value})) for j, e in waiting.items()}
        waiting = {j: e for j, e in waiting.items() if e.free_symbols - known}
    return tuple(replace(line, kind="definition") if k in done else line for k, line in enumerate(lines)), table


def _in_new_names(truth: Reference, lines: Sequence[AnsweredLine], known: set[sp.Symbol]) -> tuple[AnsweredLine, ...]:
    """The lines, those that give parameters in names of the answer as equations: of m = ε m0 and M = (1 − ε) m0, which
    say together what ε and m0 are."""
    symbols = {p.name: p.symbol for p in truth.model.parameters}
    return tuple(
        replace(line, kind="equation", expr=symbols[str(line.name)] - line.expr)
        if line.kind == "given" and _constant(line.expr, known)
        else line
        for line in lines
    )


def _constant(expr: sp.Expr, known: set[sp.Symbol]) -> bool:
    """Whether an expression contains unknown names, and nothing that changes with time."""
    moving = bool(bounded.atoms(expr, AppliedUndef)) or time in expr.free_symbols
    return not moving and bool(expr.free_symbols - known) and bounded.operations(expr) <= LONGEST


def _first(expr: sp.Expr, known: set[sp.Symbol], used: Sequence[Set[Any]]) -> tuple[sp.Basic, sp.Expr] | None:
    """An unknown name and its value; the name that the fewest other lines use, as zeta of 2 zeta wn, and of these one
    whose value is no root: a of k (a - l) = m a w^2, which is real whatever the others are."""
    unknown = sorted(expr.free_symbols - known, key=str)
    found = [(s, v) for s in unknown if (v := _value(expr, s)) is not None]
    return min(found, key=lambda x: (sum(x[0] in u for u in used), not x[1].is_Add and x[1].is_Pow), default=None)


def _value(expr: sp.Expr, name: sp.Basic) -> sp.Expr | None:
    """The positive solution for a name that occurs in one power only; None if there is none."""
    above: Any = bounded.together(expr).as_numer_denom()[0]
    rest, factor, power = sp.S.Zero, sp.S.Zero, None
    for term in sp.Add.make_args(bounded.expand(above)):
        c, own = term.as_independent(name, as_Add=False)
        base, exponent = own.as_base_exp()
        if own == 1:
            rest += c
        elif base == name and exponent.is_Rational and power in (None, exponent):
            factor, power = factor + c, exponent
        else:
            return None
    if power is None or factor == 0 or rest == 0:
        return None
    return cast("sp.Expr", bounded.cancel(-rest / factor) ** (1 / power))


# -- speeds -----------------------------------------------------------------------------------------------------------


def _stated_speeds(truth: Reference, lines: Sequence[AnsweredLine]) -> dict[sp.Basic, sp.Expr]:
    """Names that an equation q' = u makes the rate of a coordinate, with their own rates."""
    rates: dict[sp.Basic, sp.Expr] = {c.rate: c.acceleration for c in truth.model.coordinates}
    names = {c.symbol for c in truth.model.coordinates} | {u.symbol for u in truth.model.inputs}
    table: dict[sp.Basic, sp.Expr] = {}
    for line in lines:
        terms = sp.Add.make_args(line.expr)
        if line.kind != "equation" or len(terms) != 2:
            continue
        rate = next((x for t in terms for x in (t, -t) if x in rates), None)
        name = next((x for t in terms for x in (t, -t) if isinstance(x, AppliedUndef) and x not in names), None)
        if rate is not None and name is not None and sum(terms) in (rate - name, name - rate):
            table |= {name: rate, sp.Derivative(name, time): rates[rate]}
    return table


def _without(line: AnsweredLine, speeds: dict[sp.Basic, sp.Expr]) -> AnsweredLine:
    """The line, or a definition if it only says what a speed is."""
    says = line.kind == "equation" and line.expr.xreplace(speeds) == 0
    return replace(line, kind="definition") if says else line


@dataclass(frozen=True)
class ReadAsSpeeds:
    """The lines with some names read as rates of coordinates, and what to say of these."""

    lines: tuple[AnsweredLine, ...]
    notes: tuple[Text, ...]


def speeds(truth: Reference, lines: Sequence[AnsweredLine]) -> tuple[tuple[AnsweredLine, ...], tuple[Text, ...]]:
    """Read names that occur with their first rate at most as rates of coordinates, if the answer is right then."""
    for reading in _read_as_speeds(truth, lines):
        if may_be_right(truth, reading.lines):
            return reading.lines, reading.notes
    return tuple(lines), ()


def likeliest_speeds(truth: Reference, lines: Sequence[AnsweredLine], least: int) -> ReadAsSpeeds | None:
    """The reading of such names in which most equations of a wrong answer are true; None if it is not one alone, or if
    fewer than ``least`` are."""
    counted = [(sum(may_be_right(truth, [x]) for x in _equations(r.lines)), r) for r in _read_as_speeds(truth, lines)]
    most = max((count for count, _ in counted), default=0)
    best = [reading for count, reading in counted if count == most]
    return best[0] if len(best) == 1 and most >= max(least, 1) else None


def _equations(lines: Sequence[AnsweredLine]) -> list[AnsweredLine]:
    return [line for line in lines if line.kind == "equation" and line.expr != 0]


def _read_as_speeds(truth: Reference, lines: Sequence[AnsweredLine]) -> Iterator[ReadAsSpeeds]:
    own = {c.symbol for c in truth.model.coordinates} | {u.symbol for u in truth.model.inputs}
    own |= {d.symbol for d in truth.model.definitions}
    told = [line for line in lines if line.kind != "statement"]
    new = {f for line in told for f in bounded.atoms(line.expr, AppliedUndef) if f.args == (time,)} - own
    moving = {d.args[0]: d.derivative_count for line in told for d in bounded.atoms(line.expr, sp.Derivative)}
    high = {d.args[0] for line in told for d in bounded.atoms(line.expr, sp.Derivative) if d.derivative_count > 1}
    if not new or len(new) > MAX_SPEEDS or new & high or not new <= moving.keys():
        return
    names = sorted(new, key=str)
    for picked in permutations(truth.model.coordinates, len(names)):
        table: dict[sp.Basic, sp.Expr] = {}
        for name, c in zip(names, picked, strict=True):
            table |= {name: c.rate, sp.Derivative(name, time): c.acceleration}
        notes = [text(f"'{plain(n)}' was read as ", c.rate, ".") for n, c in zip(names, picked, strict=True)]
        yield ReadAsSpeeds(tuple(_put(line, table) for line in lines), tuple(notes))


# -- parameters -------------------------------------------------------------------------------------------------------


def _assumed(
    truth: Reference, lines: Sequence[AnsweredLine]
) -> tuple[tuple[AnsweredLine, ...], dict[sp.Symbol, sp.Expr]]:
    """The lines that remain, and the parameters that the others express in positive values of other parameters."""
    symbols = {p.name: p.symbol for p in truth.model.parameters}
    values: dict[sp.Symbol, sp.Expr] = {}
    kept: list[AnsweredLine] = []
    given = {(x.number, x.text): x.expr for x in lines if x.kind == "given" and x.expr.is_number}
    for line in lines:
        if line.kind != "given":
            kept.append(line)
            continue
        if (shared := given.get((line.number, line.text))) is not None:
            line = replace(line, expr=shared)  # m of m = J = 0
        symbol = symbols[str(line.name)]
        value = truth.expand(cast("sp.Expr", line.expr.xreplace(values)))
        known = value.free_symbols <= set(symbols.values())
        if truth.derivation.multipliers or symbol in values or not known or not _positive(truth, value):
            kept.append(replace(line, kind="equation", expr=symbol - line.expr))
        elif value != symbol:
            if value.has(symbol):
                kept.append(replace(line, kind="equation", expr=symbol - line.expr))
                continue
            values = {s: cast("sp.Expr", v.xreplace({symbol: value})) for s, v in values.items()} | {symbol: value}
    return tuple(kept), values


def _positive(truth: Reference, value: sp.Expr) -> bool:
    """Whether a value is positive for positive parameters."""
    return bool((CompiledExpressions([value]).at(truth.states) > 0).all())
