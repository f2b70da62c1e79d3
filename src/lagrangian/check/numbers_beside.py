"""Answers in letters with equations in numbers behind them: the lines in numbers are judged with values."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any, cast

import numpy as np
import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.names.spelling import in_numbers, names_of, substituted, values_of
from lagrangian.check.reference import Reference
from lagrangian.check.rounded import unrounded
from lagrangian.check.verdict import AnsweredLine, Finding, Status, Verdict
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.model import time
from lagrangian.page.formula import Text, text
from lagrangian.read.letters import key
from lagrangian.records import dataclass

ROUNDED = 0.005
"""The relative difference of a value that is rounded."""
EXACT = 1e-9
_JUDGED = frozenset(["T", "V", "L", "D", "Xi"])

Judge = Callable[[Reference, Sequence[AnsweredLine]], Verdict]


def with_numbers_beside(truth: Reference, lines: Sequence[AnsweredLine], judge: Judge) -> Verdict | None:
    """The verdict on the lines in letters, and on those in numbers with the values of the system; None if there are no
    lines in numbers, or if neither these nor the others hold an equation for every coordinate."""
    accelerations = [c.acceleration for c in truth.model.coordinates]
    said = [line.kind in _JUDGED or (line.kind == "equation" and line.expr.has(*accelerations)) for line in lines]
    numeric = [k for k, line in enumerate(lines) if said[k] and in_numbers(truth, [line])]
    known = names_of(truth)
    if sum(lines[k].kind == "equation" for k in numeric) >= truth.n:  # V = 3/2 s² beside equations in numbers
        judged = [k for k in range(len(lines)) if said[k]]
        numeric = numeric if any(lines[k].expr.free_symbols & known for k in judged) else judged
    valued = [k for k, line in enumerate(lines) if k not in numeric and _gives_value(truth, line)]
    lettered = [k for k in range(len(lines)) if k not in numeric and k not in valued]
    whole, moved = (sum(lines[k].kind == "equation" and said[k] for k in x) >= truth.n for x in (lettered, numeric))
    numbers = [lines[k] for k in numeric]
    values = values_of(truth, numbers)
    numbers = [lines[k] if k in numeric else _with_values(lines[k], values) for k in sorted([*numeric, *valued])]
    if (
        not numeric
        or not (lettered or valued)
        or not (whole or moved)
        or not values
        or any(bounded.symbols(x.expr) - {time} - truth.prescribed - truth.angles for x in numbers)
    ):
        return None
    if not lettered:
        return _in_values(truth, numbers, values, judge)
    first = judge(truth, [lines[k] for k in lettered])
    if first.status is Status.INCOMPLETE and whole:
        return None
    second = _in_values(truth, numbers, values, judge)
    if second.status is Status.OTHER_COORDINATES:
        return None
    others = whole and first.right and len(numeric) > 1 and not truth.values
    others = others and any(line.kind == "equation" for line in numbers)  # 2 m L^2 is no energy in numbers
    if others and all(f.status is Status.WRONG for f in second.findings):
        note = text("The lines in numbers were not judged: they are for other values than those of the system.")
        return replace(first, notes=(*first.notes, note))
    wrong = first if first.status is Status.WRONG else second
    status = first.status if whole or first.status is Status.WRONG else second.status
    order: dict[int, list[Finding]] = {}
    for finding in (*first.findings, *second.findings):
        order.setdefault(finding.line.number, []).append(finding)
    told = text("The lines in numbers are judged with the values of the system.")
    notes = [x for v in (first, second) if v.status is not Status.INCOMPLETE for x in v.notes]
    return Verdict(
        status if second.status is not Status.WRONG else Status.WRONG,
        tuple(x for number in sorted(order) for x in order[number]),
        wrong.mistakes,
        wrong.alternatives,
        first.combination,
        change=first.change,
        notes=tuple(dict.fromkeys((*notes, told))),
        hint=first.hint,
        sure=wrong.sure,
    )


def with_definitions_in_values(truth: Reference, lines: Sequence[AnsweredLine]) -> tuple[AnsweredLine, ...]:
    """The lines in which the system's own ``l``, defined by a coordinate and letters, is in numbers where the line is.

    A line that has numbers for all parameters, and l, names no letter: l² = 11.68 − 7.68 cos θ, 3.84 sin θ/l. One that
    gives it in rounded numbers, l = 0.5 + 0.94 s, is left.
    """
    defined = truth.placed
    values = values_of(truth, ()) if defined else {}

    def put(expr: sp.Expr) -> sp.Expr:
        return cast("sp.Expr", truth.model.expand(expr).xreplace(values))

    made: list[AnsweredLine] = []
    for line in lines:
        holds = bool(values) and line.expr.has(*defined) and not any(line.expr.coeff(d) in (-1, 1) for d in defined)
        if not holds or not in_numbers(truth, [line]):
            made.append(line)
            continue
        sides = None if line.sides is None else tuple(map(put, line.sides))
        made.append(replace(line, expr=put(line.expr), sides=cast("Any", sides)))
    return tuple(made)


def _gives_value(truth: Reference, line: AnsweredLine) -> bool:
    """Whether a line gives a quantity of the system, which is defined in letters, in numbers: rho = 0.5 + 0.94 s."""
    constants = {key(p.name) for p in truth.model.parameters}
    decimals = any(x.q != 1 for x in bounded.atoms(line.expr, sp.Rational))
    known = any(d.name == line.name for d in truth.model.definitions)
    return line.kind == "identity" and known and decimals and constants.isdisjoint(line.names)


def _with_values(line: AnsweredLine, values: Mapping[sp.Symbol, sp.Expr]) -> AnsweredLine:
    return replace(line, expr=cast("sp.Expr", line.expr.xreplace(values)))


def _in_values(
    truth: Reference, numbers: Sequence[AnsweredLine], values: Mapping[sp.Symbol, sp.Expr], judge: Judge
) -> Verdict:
    """The verdict on lines in numbers; where they have numbers and names of a prescribed motion, s and its rate 0.4,
    with values for these names too."""
    found = judge(truth.with_values(values), numbers)
    every = values_of(truth, ())
    named = truth.prescribed & every.keys()
    if found.status is not Status.WRONG or not any(bounded.symbols(x.expr) & named for x in numbers):
        return found
    put = [replace(x, expr=x.expr.xreplace(every)) for x in numbers]
    again = judge(truth.with_values(every), put)
    return again if again.right else found


@dataclass(frozen=True)
class NumbersAlone:
    """The lines of an answer in numbers, without those that only give parameters the values of the system."""

    lines: tuple[AnsweredLine, ...]
    values: dict[sp.Symbol, sp.Expr]
    notes: tuple[Text, ...]

    def judged(self, valued: Reference, judge: Callable[[Sequence[AnsweredLine], bool], Verdict]) -> Verdict:
        """The verdict on these lines, whose numbers may be rounded; ``judge`` may explain what is wrong, or not."""
        read, told = unrounded(valued, self.lines)
        verdict = judge(read, True)
        if told and not verdict.right and (exact := judge(self.lines, False)).right:
            verdict, told = exact, ()
        return replace(verdict, notes=(*told, *verdict.notes, *self.notes))


def numbers_alone(truth: Reference, lines: Sequence[AnsweredLine]) -> NumbersAlone | None:
    """Return the lines of an answer that is in numbers but for values of the system and what follows from these, J/R² =
    0.05; None for another."""
    values, kept = values_of(truth, ()), list[AnsweredLine]()
    for line in lines:
        gives = any(line.expr in (p - v, v - p) for p, v in values.items())
        line = replace(line, expr=sp.S.Zero) if not gives and _is_worked_out(truth, line, values) else line
        line = replace(line, expr=line.expr.xreplace(values)) if _relates(truth, line) else line
        kept += [] if gives or line.kind in ("definition", "statement") else [line]
    lettered = [x for x in kept if not _is_constant(x, values)]
    if not lettered or not in_numbers(truth, lettered):
        return None
    return NumbersAlone(tuple(kept), values, (substituted(values),))


def _relates(truth: Reference, line: AnsweredLine) -> bool:
    """Whether a line only relates coordinates, x = R φ, or their rates, as a constraint does."""
    moving = {x for c in truth.model.coordinates for x in (c.symbol, c.rate)}
    accelerations = [c.acceleration for c in truth.model.coordinates]
    related = [x for x in moving if line.expr.has(x)]
    return line.kind == "equation" and len(related) > 1 and not line.expr.has(*accelerations)


def _is_constant(line: AnsweredLine, values: Mapping[sp.Symbol, sp.Expr]) -> bool:
    """Whether a line equates letters of which all values are known with a number."""
    return (
        line.kind == "equation"
        and bounded.symbols(line.expr) <= values.keys()
        and not bounded.atoms(line.expr, AppliedUndef)
    )


def _is_worked_out(truth: Reference, line: AnsweredLine, values: Mapping[sp.Symbol, sp.Expr]) -> bool:
    """Whether such a line is true, but for rounding where several letters are in it: p = 9.8 may be another value."""
    if not _is_constant(line, values):
        return False
    put: dict[sp.Basic, Array] = {p: np.full(truth.states.size, float(v)) for p, v in values.items()}
    terms = CompiledExpressions(sp.Add.make_args(line.expr)).at(truth.states, put)[:, 0]
    near = ROUNDED if len(bounded.symbols(line.expr)) > 1 else EXACT
    return bool(abs(terms.sum()) <= near * np.abs(terms).max())
