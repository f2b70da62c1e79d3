"""What right equations have beside them that is not about every motion: a single position, or the small motions."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import cast

import numpy as np
import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.check.difference import differences, likeness
from lagrangian.check.explain.misconceptions.small_angle import first_order, small
from lagrangian.check.names.own_accelerations import own_accelerations
from lagrangian.check.places import (
    AT_REST,
    ENDS_IN_ZERO,
    amplitudes,
    gives_one_value,
    is_rate,
    only_places,
    place_or_approximation,
    prescribed_angles,
    relates_freedoms,
    rests,
    rests_without_rates,
    stands_still,
)
from lagrangian.check.reading.prose.values_said import AT, START, STEADY, STILL
from lagrangian.check.reference import Reference
from lagrangian.check.rows import Kind, RowComparison, factors_of, zero_everywhere
from lagrangian.check.said_cases import values_near, where_it_holds
from lagrangian.check.special_cases import INFINITE
from lagrangian.check.verdict import AnsweredLine
from lagrangian.derive.sampling import Array, CompiledExpressions
from lagrangian.model import time
from lagrangian.page.formula import Text, text

_D = r"(?:\\partial(?![a-z])|∂|\\(?:mathrm|text)\{d\}|d)"
_SLOPE = re.compile(rf"[ \t$&]*+(?:\\[dt]?frac[ \t]?\{{)?{_D}[^=\n/]{{1,40}}?(?:/|\}}[ \t]?\{{){_D}")
"""A derivative on the left: dI/dθ = …, which is said of all positions unless it is zero."""
UNITS = frozenset("mNJ")
"""Units in which an answer gives a value, and letters of systems."""
ROUNDED = 0.005
"""By which part of its largest term a sum in rounded numbers may miss zero."""
SPECIAL_MOTIONS = frozenset(["rest", "check", "case", "special", STILL, STEADY, START])
"""What words say beside a line that is about some motions alone."""
BELOW = "its sentence is about a special motion"


def beside(
    truth: Reference, lines: Sequence[AnsweredLine], comparison: RowComparison
) -> tuple[Sequence[AnsweredLine], tuple[Text, ...]]:
    """The lines, with those that are not judged as statements, and notes that say so.

    Only if the equations of all motions are there: θ = 0 where the answer goes on to equilibria, and the equations for
    small angles that follow from them. Equations for small angles alone are a mistake. Wrong equations of all motions
    are as many as there are coordinates, and one of the wrong lines is left.
    """
    equations = [line for line in lines if line.kind == "equation"]
    wrong = [line for line, row in zip(equations, comparison.rows, strict=True) if row.kind is Kind.WRONG]
    values = {id(x): why for x in lines if x.kind == "identity" and (why := _value(truth, x))}
    complete = comparison.rank >= truth.n
    if not (wrong or values) or not (complete or len(_of_motion(truth, equations)) >= truth.n):
        return lines, ()
    moving = own_accelerations(truth.model, lines)
    placed = [line for line in wrong if not line.names & moving]  # m x″ = N with N = m x″ + m g is about every motion
    aside = {id(line): why for line in placed if (why := _place(truth, line, wrong))}
    still = [x for x in wrong if complete and stands_still(truth, x.expr, x.text)]
    aside |= dict.fromkeys(map(id, still), "it is about one motion")
    aside |= {id(x): why for x in wrong if complete and (why := _value_alone(truth, x))}
    aside |= values
    places = {line.number for line in wrong if id(line) in aside}  # for θ = π/2 and θ′ = 0
    aside |= {
        id(line): "it is about one motion" for line in wrong if line.number in places and is_rate(truth, line.expr)
    }
    true = {id(x): where for x in wrong if complete and id(x) not in aside and (where := where_it_holds(truth, x))}
    aside |= true
    others = [line for line in wrong if id(line) not in aside and (complete or line.beside)]
    held = _small_ones(truth, [line.expr for line in others]) if others else []
    aside |= {id(line): "it is about small motions" for line, holds in zip(others, held, strict=True) if holds}
    aside |= {id(line): why for line in wrong if id(line) not in aside and (why := _remark(truth, line))}
    aside |= {id(line): BELOW for line in _below(truth, placed, equations, comparison) if id(line) not in aside}
    special = [line for line in placed if "aside" in line.beside and relates_freedoms(truth, line.expr)]
    if complete and all(id(line) in aside or line in special for line in wrong):
        aside |= {id(line): "it holds in special motions alone" for line in special}
    left = _of_motion(truth, [line for line in equations if id(line) not in aside])
    if not complete and (len(left) < truth.n or all(id(line) in aside for line in wrong)):
        return lines, ()
    kept = [replace(line, kind="statement") if id(line) in aside else line for line in lines]
    told = [f"'{x.text}' is right {true[id(x)]}." for x in lines if id(x) in true]
    told += [f"'{x.text}' was not judged: {aside[id(x)]}." for x in lines if id(x) in aside and id(x) not in true]
    untrue = [line for line in placed if id(line) not in aside and only_places(truth, line.expr)]
    told += [f"'{_once(line.text)}' is not true: neither of every motion nor of a position at rest." for line in untrue]
    return kept, tuple(text(note) for note in dict.fromkeys(told))


def _below(
    truth: Reference, wrong: Sequence[AnsweredLine], equations: Sequence[AnsweredLine], comparison: RowComparison
) -> list[AnsweredLine]:
    """The wrong lines of a sentence about special motions, below all right equations of motion, that hold no
    acceleration. What is said of rest, and is not true there, is left."""
    if comparison.rank < truth.n:
        return []
    accelerations = [c.acceleration for c in truth.model.coordinates]
    pairs = zip(equations, comparison.rows, strict=True)
    right = [x.number for x, row in pairs if row.kind is not Kind.WRONG and x.expr.has(*accelerations)]
    below = [x for x in wrong if x.number > max(right, default=0) and "special" in x.beside]
    found = [x for x in below if not x.expr.has(*accelerations)]
    return [x for x in found if rests(truth, x.expr, said="rest" in x.beside) is not False]


def _value(truth: Reference, line: AnsweredLine) -> str | None:
    """Why a statement is not about every motion: it is right at rest, or at the place that its words say."""
    if _is_of_rest(truth, line):
        return AT_REST
    return "it holds under its condition" if _is_of_place(truth, line) else None


def _value_alone(truth: Reference, line: AnsweredLine) -> str | None:
    """Why a line is not judged that only gives a time or a constant a value, or an acceleration in a special case."""
    kind = gives_one_value(truth, line.expr, line.text)
    if kind == "motion":
        none = line.expr.xreplace(dict.fromkeys(line.expr.atoms(sp.Derivative), sp.S.Zero)) == 0  # x'' = 0
        several = sum(x.startswith(AT) for x in line.near) > 1
        return "it is about one motion" if several or (none and (line.beside | line.near) & SPECIAL_MOTIONS) else None
    return None if kind is None else f"it is about one {kind}"


def _is_of_rest(truth: Reference, line: AnsweredLine) -> bool:
    """Whether a statement on a force or a position is right at rest, S = m g; with rates, where S was k δ + b δ′ above,
    only if words say that it is about rest."""
    said = "rest" in line.beside
    if line.expr.has(sp.Derivative):
        return said and rests_without_rates(truth, line.expr, [])
    return rests(truth, line.expr, said=said) is True


def _is_of_place(truth: Reference, line: AnsweredLine) -> bool:
    """Whether a statement holds at the position, or for the constant, that words in front of it say: at θ = 90°:
    ℓ = √(a² + b²); for n = 1: J = J1 + J2."""
    own = {x.symbol for x in (*truth.model.coordinates, *truth.model.parameters)}
    said = (pair for case in values_near(truth, line.near) for pair in case.given.items())
    places = {x: value for x, value in said if x in own and value.is_number and abs(value) != INFINITE}
    if not places or line.expr.has(sp.Derivative) or not line.expr.has(*places):
        return False
    there = cast("sp.Expr", line.expr.xreplace(places))
    return zero_everywhere(truth, there) or _is_rounded_zero(truth, there)


def _is_rounded_zero(truth: Reference, expr: sp.Expr) -> bool:
    """Whether an expression with decimal numbers vanishes with the values of the system, as far as these are given;
    0.36 m may be metres where m is a mass."""
    values = {p.symbol: sp.Float(p.value) for p in truth.model.parameters if p.value is not None}
    parts = [x.as_coeff_Mul() for x in sp.Add.make_args(expr)]
    listed = [c if str(x) in UNITS and not c.is_Integer else c * x for c, x in parts]
    terms = [sp.N(x.xreplace(values)) for x in listed]
    if not expr.free_symbols or not all(x.is_Float or x.is_Rational for x in terms):
        return False
    return bool(abs(sum(terms)) <= ROUNDED * max(abs(x) for x in terms))


def _once(written: str) -> str:
    """A line without a side that stands there twice in a row, as where a name was read as what it is said to be."""
    sides = [x.strip() for x in written.split("=")]
    return " = ".join(x for k, x in enumerate(sides) if k == 0 or x != sides[k - 1]) if len(sides) > 2 else written


def _of_motion(truth: Reference, lines: Sequence[AnsweredLine]) -> list[AnsweredLine]:
    """The equations of motion among some lines, without those that words call a remark."""
    accelerations = [c.acceleration for c in truth.model.coordinates]
    return [line for line in lines if not line.beside and line.expr.has(*accelerations)]


def _place(truth: Reference, line: AnsweredLine, wrong: Sequence[AnsweredLine]) -> str | None:
    """Why a line about positions is not about every motion, with what else its line says: τ = 0, F = m g."""
    if _SLOPE.match(line.text) and not ENDS_IN_ZERO.search(line.text):
        return None
    given = [x.expr for x in wrong if x.number == line.number and x is not line]
    return place_or_approximation(truth, line.expr, line.text, given, said="rest" in line.beside)


def _remark(truth: Reference, line: AnsweredLine) -> str | None:
    """Why a line of a remark is not judged: all but a position at rest, and an equation in a check that is wrong in
    every special case."""
    known = {x.symbol for x in (*truth.model.parameters, *truth.model.inputs, *truth.model.coordinates)} | {time}
    foreign = bounded.letters(line.expr) - known
    accelerates = line.expr.has(*(c.acceleration for c in truth.model.coordinates))
    if not line.beside & {"check", "case"}:
        return None
    if "rest" in line.beside and rests(truth, line.expr, said=True) is False:
        return None
    if "case" in line.beside or foreign or not accelerates:
        return "it is a remark beside the equations"
    return _special_case(truth, line.expr, lacks="lacks" in line.beside)


def _special_case(truth: Reference, expr: sp.Expr, *, lacks: bool) -> str | None:
    """Why an equation may be right in a special case: it lacks terms of a right one and has all others as they are,
    or a coordinate is held at 0, whose own equation says how it is held.

    Where words say that it ``lacks`` a force, the motions may be small, and no inertia is missing.
    """
    if (form := truth.form(expr)) is None:
        return "it is a remark beside the equations"
    small_ones = ([truth.form(row) for row in rows] for rows in _rows_for_small(truth) if rows and lacks)
    moving = [c.acceleration for c in truth.model.coordinates]
    for forms in (truth.forms, *small_ones):
        for like, right in zip(likeness(form, forms), forms, strict=True):
            known = right if like.score > 0 else None
            told = () if known is None else differences(truth, form, known, like.factor, like.index)
            inert = lacks and any(x.term.has(*moving) for x in told)
            if told and not inert and all(x.kind == "missing" and x.written == 0 for x in told):
                return "it lacks terms of a right equation, which may be 0 in a special case"
    P = CompiledExpressions([expr]).at(truth.states)
    for i, c in enumerate(truth.model.coordinates):
        table = dict.fromkeys((c.symbol, c.rate, c.acceleration), sp.S.Zero)
        rows = [cast("sp.Expr", row.xreplace(table)) for j, row in enumerate(truth.rows) if j != i]
        if rows and factors_of(truth, P, CompiledExpressions(rows).at(truth.states))[1][0]:
            return f"it holds for {c.name} = 0 alone"
    return None


def _small_ones(truth: Reference, exprs: Sequence[sp.Expr]) -> list[bool]:
    """Which equations are the right ones for small motions, and their sums."""
    P = CompiledExpressions(exprs).at(truth.states)
    holds = np.zeros(len(exprs), bool)
    for rows in filter(None, _rows_for_small(truth)):
        W: Array = CompiledExpressions(rows).at(truth.states)
        holds |= factors_of(truth, P, W)[1]
    return [bool(x) for x in holds]


def _rows_for_small(truth: Reference) -> Iterator[Sequence[sp.Expr]]:
    """The equations of motion with sin θ = θ, or of first order in θ, in the amplitude A of a prescribed angle
    A sin Ωt, or in both."""
    moving = {f for row in truth.rows for f in row.atoms(sp.sin, sp.cos) if f.atoms(AppliedUndef)}
    prescribed = prescribed_angles(truth)
    names = [x for c in truth.model.coordinates for x in (c.symbol, c.rate, c.acceleration)]
    for replaced in filter(None, (moving, prescribed, moving | prescribed if moving and prescribed else None)):
        table = {f: small(f) for f in replaced}
        changed = [cast("sp.Expr", row.xreplace(table)) for row in truth.rows]
        yield changed
        if moving:
            yield first_order(changed, names) or ()
    yield first_order(truth.rows, names) or ()
    if sizes := amplitudes(truth):
        yield first_order(truth.rows, sizes) or ()
        yield first_order(truth.rows, [*names, *sizes]) or ()
